//! Tests of configurations: the shipped ones, overrides, and what is said about wrong ones.

mod overrides;
mod shipped;
mod wrong;

use std::fs;
use std::path::PathBuf;

use adslam_diagnostics::InputError;
use tempfile::TempDir;

use super::Config;
use crate::tests::{HEART, POLYGON, repository};

/// A folder with scenarios, published results and one configuration.
struct Folder(TempDir);

impl Folder {
    fn with(config: &str) -> Self {
        let folder = Self(tempfile::tempdir().expect("a folder"));
        let published = fs::read_to_string(repository("configs/published.toml")).expect("tables");
        for (name, text) in [
            ("polygon.toml", POLYGON),
            ("heart.toml", HEART),
            ("published.toml", &published),
            ("config.toml", config),
        ] {
            fs::write(folder.path(name), text).expect("a file");
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
}

fn loaded(config: &str) -> Result<Config, InputError> {
    Config::load(&Folder::with(config).path("config.toml"))
}

const ONE: &str =
    "title = \"one\"\n[[experiments]]\nscenario = \"polygon.toml\"\nplanners = [\"global\"]\n";
