//! Checking a file of any kind, for `adslam check`.

use std::fmt;
use std::path::Path;

use super::{Config, Published};
use crate::diagnostics::{Document, InputError};
use crate::scenario::{Object, Scenario};

/// What a file turned out to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// A scenario: what the world is.
    Scenario,
    /// A configuration: what is run.
    Configuration,
    /// Published results.
    Published,
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scenario => "scenario",
            Self::Configuration => "configuration",
            Self::Published => "published tables",
        })
    }
}

/// Keys of the root that only one kind of file has.
const TELLING_KEYS: [(FileKind, &[&str]); 3] = [
    (
        FileKind::Configuration,
        &["experiments", "runs", "first_seed"],
    ),
    (FileKind::Published, &["tables"]),
    (
        FileKind::Scenario,
        &[
            "object",
            "noise",
            "sensor",
            "robot",
            "viewpoints",
            "planners",
            "motion",
            "steps",
        ],
    ),
];

/// Reads the file at `path`, finds out by its keys what kind it is, and checks it and what it names
/// (a configuration's scenarios and tables; whether a scenario's mesh file is there).
///
/// # Errors
/// The first thing that is wrong with it, or that it is none of the three kinds.
pub fn check_file(path: &Path) -> Result<FileKind, InputError> {
    let document = Document::read(path)?;
    let keys = document.keys("");
    let telling = |(_, telling): &&(FileKind, &[&str])| {
        keys.iter().any(|key| telling.contains(&key.as_str()))
    };
    let Some((kind, _)) = TELLING_KEYS.iter().find(telling) else {
        let message = format!(
            "{} is neither a scenario nor a configuration",
            path.display()
        );
        return Err(InputError::about_file(path, message).with_help(
            "a scenario has [object], [noise], [robot], …; a configuration [[experiments]]; a file \
             of published results [tables.…]. docs/scenario.md lists all keys",
        ));
    };
    match kind {
        FileKind::Configuration => drop(Config::from_document(&document)?),
        FileKind::Published => drop(Published::from_document(&document)?),
        FileKind::Scenario => check_mesh_is_there(&Scenario::from_document(document)?)?,
    }
    Ok(*kind)
}

fn check_mesh_is_there(scenario: &Scenario) -> Result<(), InputError> {
    match &scenario.object {
        Object::Mesh(mesh) if !mesh.file.is_file() => Err(scenario
            .error_at(
                "object.mesh.file",
                format!("there is no file {}", mesh.file.display()),
            )
            .with_help("the path counts from the scenario's folder")),
        _ => Ok(()),
    }
}
