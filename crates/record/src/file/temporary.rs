//! Unfinished files, and the folders that they and results go into.

use std::ffi::OsStr;
use std::fs::{self, OpenOptions, TryLockError};
use std::io;
use std::path::Path;

use adslam_diagnostics::InputError;
use tempfile::{Builder, NamedTempFile};

/// How the names of unfinished files begin.
const PREFIX: &str = ".adslam-";
/// Letters and digits behind that, drawn by chance.
const DRAWN: usize = 6;

/// A new file in `folder`, locked as long as it is open: that tells it from what a dead process left.
///
/// Others may read it as far as the user's umask allows: the files of `tempfile` are private to their owner, and
/// results are not.
pub(super) fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(PREFIX).rand_bytes(DRAWN);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    loop {
        let file = builder.tempfile_in(folder)?;
        if is_claimed(&file) {
            return Ok(file);
        }
    }
}

/// Locks a new file; false if another process, which took it for a leftover, was faster.
fn is_claimed(file: &NamedTempFile) -> bool {
    match file.as_file().try_lock() {
        Ok(()) => file.path().exists(),
        Err(TryLockError::WouldBlock) => false,
        // Where nothing can be locked, nothing is taken for a leftover.
        Err(TryLockError::Error(_)) => true,
    }
}

/// Makes sure that `folder` exists and can be written to, before any long work begins, and removes the unfinished
/// files that killed processes left in it; those of processes at work stay.
///
/// # Errors
/// [`InputError`] if it is a file, cannot be made or cannot be written to.
pub fn prepare_folder(folder: &Path) -> Result<(), InputError> {
    make_folder(folder)?;
    let probe = temporary(folder).map_err(|error| not_writable(folder, &error))?;
    drop(probe);
    remove_leftovers(folder);
    Ok(())
}

/// Makes sure that `folder` exists.
///
/// # Errors
/// [`InputError`] if it is a file or cannot be made.
pub fn make_folder(folder: &Path) -> Result<(), InputError> {
    if folder.exists() && !folder.is_dir() {
        let message = format!(
            "{} is a file, and results go into a folder",
            folder.display()
        );
        return Err(InputError::about_file(folder, message)
            .with_help("give the path of a folder, or of one that does not exist yet"));
    }
    fs::create_dir_all(folder).map_err(|error| not_writable(folder, &error))
}

/// The error of a folder in which no file can be made.
pub fn not_writable(folder: &Path, cause: &io::Error) -> InputError {
    let message = format!(
        "the folder {} cannot be written to: {cause}",
        folder.display()
    );
    InputError::about_file(folder, message)
        .with_help("give a folder that can be written to with --out")
}

/// Removes unfinished files whose process is dead. What cannot be removed disturbs nobody.
fn remove_leftovers(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        if is_file && is_temporary(&entry.file_name()) {
            remove_unclaimed(&entry.path());
        }
    }
}

fn is_temporary(name: &OsStr) -> bool {
    let drawn = name.to_str().and_then(|name| name.strip_prefix(PREFIX));
    drawn.is_some_and(|drawn| {
        drawn.len() == DRAWN && drawn.bytes().all(|byte| byte.is_ascii_alphanumeric())
    })
}

fn remove_unclaimed(path: &Path) {
    // For writing, without which some file systems lock nothing.
    let Ok(file) = OpenOptions::new().read(true).write(true).open(path) else {
        return;
    };
    if file.try_lock().is_ok() {
        let _ = fs::remove_file(path);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::thread;

    use super::*;

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
    }

    #[test]
    fn only_what_a_dead_process_left_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let of_others = [".adslam-notes.md", ".adslam-ab", ".adslam-ab-123", "notes"];
        for name in of_others.iter().chain(&[".adslam-abc123"]) {
            fs::write(path(name), "half").unwrap();
        }
        fs::create_dir(path(".adslam-folder")).unwrap();
        let at_work = temporary(folder.path()).unwrap();
        prepare_folder(folder.path()).unwrap();
        assert!(!path(".adslam-abc123").exists());
        assert!(at_work.path().exists());
        assert!(path(".adslam-folder").exists());
        assert!(of_others.iter().all(|name| path(name).exists()));
    }

    /// Processes that come and go in a folder where others tidy up.
    #[test]
    fn nobody_is_disturbed_by_who_tidies_up() {
        let folder = tempfile::tempdir().unwrap();
        let done = AtomicBool::new(false);
        thread::scope(|scope| {
            scope.spawn(|| {
                while !done.load(Ordering::Relaxed) {
                    remove_leftovers(folder.path());
                }
            });
            for number in 0..2000 {
                let file = temporary(folder.path()).unwrap();
                file.persist(folder.path().join(format!("{}", number % 5)))
                    .unwrap();
                prepare_folder(folder.path()).unwrap();
            }
            done.store(true, Ordering::Relaxed);
        });
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 5);
    }
}
