//! Tests of sweeps: their plans, and the tables of made-up records.

mod plans;
mod tables;

use std::fs;
use std::path::PathBuf;

use tempfile::TempDir;

use crate::test_files::POLYGON;

const HEAD: &str = "title = \"t\"\nruns = 3\nscenario = \"polygon.toml\"\n\
    planners = [\"local\", \"global\"]\n";

/// A folder with the polygon and one sweep.
struct Folder(TempDir);

impl Folder {
    fn with(rest: &str) -> Self {
        let folder = Self(tempfile::tempdir().expect("a folder"));
        fs::write(folder.path("polygon.toml"), POLYGON).expect("a file");
        fs::write(folder.path("sweep.toml"), format!("{HEAD}{rest}\n")).expect("a file");
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
}
