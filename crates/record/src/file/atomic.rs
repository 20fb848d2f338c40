//! Files that appear under their name only when they are complete.

use std::fs;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, InputError};
use serde::Serialize;
use tempfile::NamedTempFile;

use super::temporary::temporary;

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
    /// [`Failure::Output`] if the folder cannot be written to; [`InputError`] if what lies at
    /// `path` is a folder, a device or a pipe, which must not be replaced by a file.
    pub fn create(path: &Path) -> Result<Self, Failure> {
        refuse_other_than_file(path)?;
        let file = temporary(folder_of(path)).map_err(Failure::output(path))?;
        Ok(Self {
            path: path.to_owned(),
            file: BufWriter::new(file),
        })
    }

    /// A file with this content that will lie at `path`.
    ///
    /// # Errors
    /// As [`AtomicFile::create`].
    pub fn with_content(path: &Path, content: &[u8]) -> Result<Self, Failure> {
        let mut file = Self::create(path)?;
        file.write_all(content)
            .map_err(|error| file.failed(error))?;
        Ok(file)
    }

    /// Adds text.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn add(&mut self, text: &str) -> Result<(), Failure> {
        self.write_all(text.as_bytes())
            .map_err(|error| self.failed(error))
    }

    /// Adds `value` as JSON on one line.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn add_json_line(&mut self, value: &impl Serialize) -> Result<(), Failure> {
        serde_json::to_writer(&mut *self, value).map_err(|error| self.failed(error))?;
        self.add("\n")
    }

    /// Adds `value` as JSON that people can read.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn add_json(&mut self, value: &impl Serialize) -> Result<(), Failure> {
        serde_json::to_writer_pretty(&mut *self, value).map_err(|error| self.failed(error))?;
        self.add("\n")
    }

    /// Where the file will lie.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The error of a write to this file that failed.
    fn failed(&self, error: impl Into<io::Error>) -> Failure {
        Failure::Output {
            path: self.path.clone(),
            cause: error.into(),
        }
    }

    /// Puts the file in its place, replacing what was there.
    ///
    /// # Errors
    /// [`Failure::Output`]; what was there is then unchanged.
    pub fn commit(self) -> Result<(), Failure> {
        Self::commit_all(vec![self])
    }

    /// Puts files that belong together in their places: none before all are complete on the disk.
    ///
    /// # Errors
    /// [`Failure::Output`]; unless a file cannot be renamed, nothing has changed then.
    pub fn commit_all(files: Vec<Self>) -> Result<(), Failure> {
        CompleteFile::place_all(Self::complete(files)?)
    }

    /// Puts the `files` of one folder in the place of `old` ones, so that it never holds some of these and some
    /// of those: nothing changes before all are complete on the disk; then the `marker` is put there, the old
    /// files are removed, and the others come in their order. The last of them should replace the marker, which
    /// tells who was killed in between.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn replace_all(marker: Self, old: &[PathBuf], files: Vec<Self>) -> Result<(), Failure> {
        let marker = Self::complete(vec![marker])?;
        let complete = Self::complete(files)?;
        CompleteFile::place_all(marker)?;
        for path in old {
            fs::remove_file(path).map_err(Failure::output(path))?;
        }
        CompleteFile::place_all(complete)
    }

    /// Sees to it that files are whole and on the disk.
    fn complete(files: Vec<Self>) -> Result<Vec<CompleteFile>, Failure> {
        let complete = |Self { path, file }| match on_disk(file) {
            Ok(file) => Ok(CompleteFile { path, file }),
            Err(error) => Err(Failure::output(&path)(error)),
        };
        files.into_iter().map(complete).collect()
    }

    /// The checksum of what has been written so far.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn checksum(&mut self) -> Result<String, Failure> {
        self.read_back().map_err(|error| self.failed(error))
    }

    fn read_back(&mut self) -> io::Result<String> {
        self.file.flush()?;
        let file = self.file.get_mut().as_file_mut();
        file.rewind()?;
        let sum = checksum(&mut *file)?;
        file.seek(SeekFrom::End(0))?;
        Ok(sum)
    }
}

/// A file that is whole and on the disk, beside its place.
struct CompleteFile {
    path: PathBuf,
    file: NamedTempFile,
}

impl CompleteFile {
    fn place_all(files: Vec<Self>) -> Result<(), Failure> {
        let mut folders = Vec::new();
        for Self { path, file } in files {
            file.persist(&path)
                .map_err(|error| Failure::output(&path)(error.error))?;
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

/// The CRC-32 of all bytes that are left to read, as text.
pub fn checksum(mut from: impl io::Read) -> io::Result<String> {
    let mut hasher = crc32fast::Hasher::new();
    let mut bytes = vec![0; 1 << 16];
    loop {
        match from.read(&mut bytes)? {
            0 => return Ok(format!("{:08x}", hasher.finalize())),
            count => hasher.update(&bytes[..count]),
        }
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

    fn write(path: &Path, text: &str) -> Result<(), Failure> {
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
        assert!(matches!(missing, Failure::Output { .. }));
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

    #[test]
    fn files_are_replaced_together_and_a_marker_tells_of_half_of_them() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for name in ["state", "a", "old"] {
            write(&path(name), "first").unwrap();
        }
        let replace = |old: &[PathBuf]| {
            let file = |name, text: &[u8]| AtomicFile::with_content(&path(name), text).unwrap();
            let files = vec![file("a", b"second"), file("state", b"whole")];
            AtomicFile::replace_all(file("state", b"half"), old, files)
        };
        let there = || {
            let mut names: Vec<_> = fs::read_dir(folder.path())
                .unwrap()
                .map(|entry| entry.unwrap().file_name().into_string().unwrap())
                .collect();
            names.sort();
            (names.join(" "), fs::read_to_string(path("state")).unwrap())
        };
        // As if it was stopped in between: one of the old files cannot be removed.
        assert!(replace(&[path("old"), path("absent"), path("a")]).is_err());
        assert_eq!(there(), ("a state".to_owned(), "half".to_owned()));
        replace(&[path("a")]).unwrap();
        assert_eq!(there(), ("a state".to_owned(), "whole".to_owned()));
        assert_eq!(fs::read(path("a")).unwrap(), b"second");
    }

    #[test]
    fn a_checksum_is_that_of_all_that_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("long");
        let mut file = AtomicFile::create(&path).unwrap();
        let half = "0123456789".repeat(10_000);
        file.add(&half).unwrap();
        file.checksum().unwrap();
        file.add(&half).unwrap();
        let sum = file.checksum().unwrap();
        file.commit().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), half.repeat(2));
        assert_eq!(
            sum,
            format!("{:08x}", crc32fast::hash(half.repeat(2).as_bytes()))
        );
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
