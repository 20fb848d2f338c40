//! Checking a file of any kind, for `adslam check`.

use std::path::Path;

use adslam_diagnostics::InputError;
use adslam_scenario::config::{Config, Published};
use adslam_scenario::registry::Registry;
use adslam_scenario::sweep::Sweep;
use adslam_scenario::{FileKind, Scenario};
use adslam_setup::Setup;

use crate::sweep::SweepPlan;

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
/// experiments and of a sweep's points are built, meshes read. `registry` says which planners there are.
///
/// # Errors
/// The first thing that is wrong with it, or that it is of no kind.
pub fn check_file(path: &Path, registry: &Registry) -> Result<CheckedFile, InputError> {
    let kind = FileKind::of_file(path)?;
    let mut warnings = Vec::new();
    match kind {
        FileKind::Configuration => {
            for plan in &Config::load_with(path, registry)?.experiments {
                warnings.extend(Setup::new(&plan.scenario)?.warnings);
            }
        }
        FileKind::Published => drop(Published::load_with(path, registry)?),
        FileKind::Scenario => {
            warnings = Setup::new(&Scenario::load_with(path, registry)?)?.warnings;
        }
        FileKind::Sweep => {
            warnings = SweepPlan::new(Sweep::load_with(path, registry)?, None)?.warnings();
        }
    }
    Ok(CheckedFile { kind, warnings })
}
