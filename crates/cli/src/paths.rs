//! Paths.

use std::path::Path;

/// A path as people see it.
pub(crate) fn shown(path: &Path) -> String {
    path.display().to_string()
}

/// The folder of a file.
pub(crate) fn folder_of(file: &Path) -> &Path {
    file.parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}
