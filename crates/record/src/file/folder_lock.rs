//! One process at a time in a folder.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, InputError};

use super::not_writable;

/// A locked file in a folder, which keeps other processes of this program out of it until this is dropped. The
/// system gives the lock back too when the process dies.
#[derive(Debug)]
pub struct FolderLock {
    path: PathBuf,
    is_temporary: bool,
    _file: File,
}

impl FolderLock {
    /// Takes the lock `name` of a folder, and says in its file who is at work. `remedy` is for who comes second.
    pub fn take(folder: &Path, name: &str, remedy: &str) -> Result<Self, Failure> {
        let path = folder.join(name);
        loop {
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let file = options
                .open(&path)
                .map_err(|error| not_writable(folder, &error))?;
            if let Err(cause) = file.try_lock() {
                return Err(refused(folder, &path, file, cause, remedy));
            }
            // Who had it may have removed it in between.
            if is_at(&file, &path) {
                sign(&file);
                return Ok(Self {
                    path,
                    is_temporary: false,
                    _file: file,
                });
            }
        }
    }

    /// The same lock, whose file is removed with it.
    pub fn temporary(mut self) -> Self {
        // Elsewhere nobody could tell that the file was removed.
        self.is_temporary = cfg!(unix);
        self
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        if self.is_temporary {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Whether the open file is the one at `path`.
fn is_at(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let identity = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
        let (ours, there) = (
            file.metadata().map(identity),
            fs::metadata(path).map(identity),
        );
        matches!((ours, there), (Ok(ours), Ok(there)) if ours == there)
    }
    #[cfg(not(unix))]
    {
        let _ = (file, path);
        true
    }
}

/// Why a lock cannot be taken.
fn refused(folder: &Path, path: &Path, file: File, cause: TryLockError, remedy: &str) -> Failure {
    let shown = folder.display();
    match cause {
        TryLockError::WouldBlock => {
            let mut holder = String::new();
            let read = file.take(20).read_to_string(&mut holder);
            let holder = match (read, holder.trim_end().parse::<u32>()) {
                (Ok(_), Ok(process)) => format!(" (process {process})"),
                _ => String::new(),
            };
            let message = format!("another adslam{holder} is at work in {shown}");
            InputError::about_file(folder, message)
                .with_help(remedy)
                .into()
        }
        TryLockError::Error(cause) if cause.kind() == io::ErrorKind::Unsupported => {
            let message = format!("the file system of {shown} cannot lock files: {cause}");
            InputError::about_file(folder, message)
                .with_help("give a folder on a local disk with --out")
                .into()
        }
        TryLockError::Error(cause) => Failure::output(path)(cause),
    }
}

/// Writes the number of this process for whoever comes second to read. It is always as long, so that one write
/// replaces that of a process which died here; the lock holds without it.
fn sign(mut lock: &File) {
    let signed = lock.write_all(format!("{:<10}\n", std::process::id()).as_bytes());
    if signed.is_err() {
        let _ = lock.set_len(0);
    }
}
