//! Checking a file of any kind, for `adslam check`.

use std::path::Path;

use super::{Config, Published};
use crate::diagnostics::{Document, FileKind, InputError};
use crate::run::Setup;
use crate::scenario::Scenario;
use crate::sweep::{Sweep, SweepPlan};

/// A file in which nothing is wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CheckedFile {
    /// What it turned out to be.
    pub kind: FileKind,
    /// What its author should know nevertheless.
    pub warnings: Vec<String>,
}

/// Reads the file at `path`, finds out by its keys what kind it is, and checks it and all that it
/// names, as far as can be done without a run: the worlds of scenarios, of a configuration's
/// experiments and of a sweep's points are built, meshes read.
///
/// # Errors
/// The first thing that is wrong with it, or that it is of no kind.
pub fn check_file(path: &Path) -> Result<CheckedFile, InputError> {
    let document = Document::read(path)?;
    let Some(kind) = FileKind::of(&document) else {
        let message = format!(
            "{} is neither a scenario nor a configuration nor a sweep",
            path.display()
        );
        return Err(InputError::about_file(path, message).with_help(
            "a scenario has [object], [noise], [robot], …; a configuration [[experiments]]; a sweep \
             [grid] or [[points]]; a file of published results [tables.…]. `adslam new` writes one with all keys",
        ));
    };
    let mut warnings = Vec::new();
    match kind {
        FileKind::Configuration => {
            for plan in &Config::from_document(&document)?.experiments {
                warnings.extend(Setup::new(&plan.scenario)?.warnings);
            }
        }
        FileKind::Published => drop(Published::from_document(&document)?),
        FileKind::Scenario => {
            warnings = Setup::new(&Scenario::from_document(document)?)?.warnings;
        }
        FileKind::Sweep => {
            warnings = SweepPlan::new(Sweep::from_document(&document)?, None)?.warnings();
        }
    }
    Ok(CheckedFile { kind, warnings })
}
