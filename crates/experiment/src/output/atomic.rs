//! Files that appear under their name only when they are complete.

use std::fs;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use tempfile::NamedTempFile;

use super::temporary::temporary;
use crate::ExperimentError;
use crate::diagnostics::InputError;

/// A file that is written beside its place and moved there by [`AtomicFile::commit`]. Dropped before
/// that, it leaves what was there untouched.
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    file: BufWriter<NamedTempFile>,
}

impl AtomicFile {
    /// Starts a file that will lie at `path`; its folder must exist.
    ///
    /// # Errors
    /// [`ExperimentError::Output`] if the folder cannot be written to; [`InputError`] if what lies at
    /// `path` is a folder, a device or a pipe, which must not be replaced by a file.
    pub fn create(path: &Path) -> Result<Self, ExperimentError> {
        refuse_other_than_file(path)?;
        let file = temporary(folder_of(path)).map_err(ExperimentError::output(path))?;
        Ok(Self {
            path: path.to_owned(),
            file: BufWriter::new(file),
        })
    }

    /// A file with this content that will lie at `path`.
    ///
    /// # Errors
    /// As [`AtomicFile::create`].
    pub fn with_content(path: &Path, content: &[u8]) -> Result<Self, ExperimentError> {
        let mut file = Self::create(path)?;
        file.write_all(content)
            .map_err(|error| file.failed(error))?;
        Ok(file)
    }

    /// Adds text.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn add(&mut self, text: &str) -> Result<(), ExperimentError> {
        self.write_all(text.as_bytes())
            .map_err(|error| self.failed(error))
    }

    /// Adds `value` as JSON on one line.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn add_json_line(&mut self, value: &impl Serialize) -> Result<(), ExperimentError> {
        serde_json::to_writer(&mut *self, value).map_err(|error| self.failed(error))?;
        self.add("\n")
    }

    /// Adds `value` as JSON that people can read.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn add_json(&mut self, value: &impl Serialize) -> Result<(), ExperimentError> {
        serde_json::to_writer_pretty(&mut *self, value).map_err(|error| self.failed(error))?;
        self.add("\n")
    }

    /// Where the file will lie.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The error of a write to this file that failed.
    fn failed(&self, error: impl Into<io::Error>) -> ExperimentError {
        ExperimentError::Output {
            path: self.path.clone(),
            cause: error.into(),
        }
    }

    /// Puts the file in its place, replacing what was there.
    ///
    /// # Errors
    /// [`ExperimentError::Output`]; what was there is then unchanged.
    pub fn commit(self) -> Result<(), ExperimentError> {
        Self::commit_all(vec![self])
    }

    /// Puts files that belong together in their places: none before all are complete on the disk.
    ///
    /// # Errors
    /// [`ExperimentError::Output`]; unless a file cannot be renamed, nothing has changed then.
    pub fn commit_all(files: Vec<Self>) -> Result<(), ExperimentError> {
        let complete = files
            .into_iter()
            .map(|Self { path, file }| match on_disk(file) {
                Ok(file) => Ok((path, file)),
                Err(error) => Err(ExperimentError::output(&path)(error)),
            })
            .collect::<Result<Vec<_>, _>>()?;
        let mut folders = Vec::new();
        for (path, file) in complete {
            file.persist(&path)
                .map_err(|error| ExperimentError::output(&path)(error.error))?;
            let folder = folder_of(&path).to_owned();
            if !folders.contains(&folder) {
                folders.push(folder);
            }
        }
        for folder in folders {
            make_names_durable(&folder);
        }
        Ok(())
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Makes the names of the files in a folder survive a loss of power, as their content does, where the system
/// can: some file systems cannot, and do not need it.
fn make_names_durable(folder: &Path) {
    #[cfg(unix)]
    if let Ok(folder) = fs::File::open(folder) {
        let _ = folder.sync_all();
    }
    #[cfg(not(unix))]
    let _ = folder;
}

fn on_disk(file: BufWriter<NamedTempFile>) -> io::Result<NamedTempFile> {
    let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.as_file().sync_all()?;
    Ok(file)
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for AtomicFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

/// Renaming onto `/dev/null` would replace it, and onto a folder would fail when all is computed.
fn refuse_other_than_file(path: &Path) -> Result<(), InputError> {
    let kind = match fs::metadata(path) {
        Ok(there) if there.is_dir() => "a folder",
        Ok(there) if !there.is_file() => "a device or a pipe",
        _ => return Ok(()),
    };
    let message = format!("{} is {kind}, and a file goes there", path.display());
    Err(InputError::about_file(path, message)
        .with_help("give another path, or remove what is there"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(path: &Path, text: &str) -> Result<(), ExperimentError> {
        AtomicFile::with_content(path, text.as_bytes())?.commit()
    }

    #[test]
    fn nothing_appears_before_commit_and_nothing_is_lost_without_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("result.txt");
        write(&path, "first").unwrap();
        let mut second = AtomicFile::create(&path).unwrap();
        second.write_all(b"half").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"first");
        drop(second);
        assert_eq!(fs::read(&path).unwrap(), b"first");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no litter");
        write(&path, "third").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"third");
        let missing = AtomicFile::create(&folder.path().join("absent/file")).unwrap_err();
        assert!(matches!(missing, ExperimentError::Output { .. }));
    }

    #[test]
    fn only_files_are_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let error = AtomicFile::create(folder.path()).unwrap_err();
        assert!(error.is_bad_input() && error.to_string().contains("is a folder"));
        #[cfg(unix)]
        {
            let error = AtomicFile::create(Path::new("/dev/null")).unwrap_err();
            assert!(error.to_string().contains("a device"), "{error}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn results_may_be_read_as_the_umask_says() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (ours, usual) = (folder.path().join("ours"), folder.path().join("usual"));
        write(&ours, "").unwrap();
        fs::write(&usual, "").unwrap();
        let mode = |path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(ours), mode(usual));
    }
}
