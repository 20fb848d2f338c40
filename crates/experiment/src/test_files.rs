//! Files of the repository that tests read.

use std::path::{Path, PathBuf};

pub(crate) const POLYGON: &str = include_str!("../../../scenarios/polygon.toml");

/// A file of the repository.
pub(crate) fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}
