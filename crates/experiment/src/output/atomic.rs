//! Files that appear under their name only when they are complete.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use tempfile::NamedTempFile;

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
    /// [`ExperimentError::Output`] if the folder cannot be written to.
    pub fn create(path: &Path) -> Result<Self, ExperimentError> {
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let file = NamedTempFile::new_in(folder).map_err(ExperimentError::output(path))?;
        Ok(Self {
            path: path.to_owned(),
            file: BufWriter::new(file),
        })
    }

    /// Writes `content` to `path`, whole or not at all.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn write_all_to(path: &Path, content: &[u8]) -> Result<(), ExperimentError> {
        let mut file = Self::create(path)?;
        file.write_all(content)
            .map_err(ExperimentError::output(path))?;
        file.commit()
    }

    /// Writes `value` to `path` as readable JSON, whole or not at all.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn write_json(path: &Path, value: &impl Serialize) -> Result<(), ExperimentError> {
        let mut json = serde_json::to_vec_pretty(value).map_err(ExperimentError::output(path))?;
        json.push(b'\n');
        Self::write_all_to(path, &json)
    }

    /// Where the file will lie.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The error of a write to this file that failed.
    pub(crate) fn failed(&self, error: impl Into<io::Error>) -> ExperimentError {
        ExperimentError::Output {
            path: self.path.clone(),
            source: error.into(),
        }
    }

    /// Puts the file in its place, replacing what was there.
    ///
    /// # Errors
    /// [`ExperimentError::Output`]; what was there is then unchanged.
    pub fn commit(self) -> Result<(), ExperimentError> {
        let Self { path, file } = self;
        let finish = || -> io::Result<()> {
            let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
            make_readable(file.as_file())?;
            file.as_file().sync_all()?;
            file.persist(&path).map_err(|error| error.error)?;
            Ok(())
        };
        finish().map_err(ExperimentError::output(&path))
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Temporary files are private to their owner; results are not.
#[cfg(unix)]
fn make_readable(file: &fs::File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &fs::File) -> io::Result<()> {
    Ok(())
}

/// Makes sure that `folder` exists and can be written to, before any long work begins.
///
/// # Errors
/// [`InputError`] if it is a file, cannot be made or cannot be written to.
pub fn prepare_folder(folder: &Path) -> Result<(), InputError> {
    let about = |message: String| InputError::about_file(folder, message);
    let shown = folder.display();
    if folder.exists() && !folder.is_dir() {
        return Err(
            about(format!("{shown} is a file, and results go into a folder"))
                .with_help("give the path of a folder, or of one that does not exist yet"),
        );
    }
    fs::create_dir_all(folder)
        .and_then(|()| NamedTempFile::new_in(folder).map(drop))
        .map_err(|error| {
            about(format!("the folder {shown} cannot be written to: {error}"))
                .with_help("give a folder that can be written to with --out")
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_appears_before_commit_and_nothing_is_lost_without_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("result.txt");
        AtomicFile::write_all_to(&path, b"first").unwrap();
        let mut second = AtomicFile::create(&path).unwrap();
        second.write_all(b"half").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"first");
        drop(second);
        assert_eq!(fs::read(&path).unwrap(), b"first");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no litter");
        AtomicFile::write_all_to(&path, b"third").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"third");
    }

    #[test]
    fn folders_that_cannot_serve_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        let error = prepare_folder(&file).unwrap_err();
        assert!(error.message().contains("is a file"), "{error}");
        let below = prepare_folder(&file.join("below")).unwrap_err();
        assert!(below.message().contains("cannot be written to"), "{below}");
        prepare_folder(&folder.path().join("new/deep")).unwrap();
        let missing = AtomicFile::create(&folder.path().join("absent/file")).unwrap_err();
        assert!(matches!(missing, ExperimentError::Output { .. }));
    }
}
