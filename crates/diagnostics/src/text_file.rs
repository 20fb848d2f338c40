//! Texts read whole, and no further than a limit: what a file says of its size need not be true.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::InputError;

/// The text in the file at `path`, of at most `most_bytes`; `remedy` says what files of this kind are.
///
/// # Errors
/// When it cannot be read, is a folder, is larger, or is not UTF-8.
pub fn read_text(path: &Path, most_bytes: u64, remedy: &str) -> Result<String, InputError> {
    let name = path.display();
    let about = |message: String| InputError::about_file(path, message).with_help(remedy);
    let unreadable = |cause| InputError::unreadable(path, cause);
    let file = File::open(path).map_err(unreadable)?;
    let too_large = || {
        about(format!(
            "{name} has more than {most_bytes} bytes, the most that are read"
        ))
    };
    let metadata = file.metadata().map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(about(format!("{name} is a folder, not a file"))
            .with_help("give the path of a file in it"));
    }
    if metadata.len() > most_bytes {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    // Devices and pipes have no size, and a file may grow while it is read.
    file.take(most_bytes + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > most_bytes {
        return Err(too_large());
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        about(format!("{name} is not text: byte {at} is not UTF-8"))
    })
}

/// Whether there is anything at this path.
pub fn is_there(path: &Path) -> Result<bool, InputError> {
    std::fs::exists(path).map_err(|error| InputError::unreadable(path, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_than_the_limit_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "four").unwrap();
        assert_eq!(read_text(&path, 4, "").unwrap(), "four");
        let error = read_text(&path, 3, "shorten it").unwrap_err();
        assert!(error.message().contains("more than 3 bytes"), "{error}");
        assert_eq!(error.remedy(), Some("shorten it"));
    }

    /// A device says that it has no bytes, and gives them without end.
    #[cfg(unix)]
    #[test]
    fn what_never_ends_is_not_read_on() {
        let error = read_text(Path::new("/dev/zero"), 1 << 20, "").unwrap_err();
        assert!(
            error.message().contains("more than 1048576 bytes"),
            "{error}"
        );
    }
}
