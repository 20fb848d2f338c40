//! What most studies keep of a run.

use adslam_diagnostics::{Failure, Interrupt};
use adslam_record::NoObserver;
use adslam_simulation::RunSummary;
use serde::{Deserialize, Serialize};

use super::StudyUnit;
use crate::run::{RunOutcome, simulate};

/// A run in a few numbers, and what is to be said of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SummaryRecord {
    /// Its numbers.
    pub summary: RunSummary,
    /// What the user should know of it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

impl SummaryRecord {
    /// Does the run of a unit.
    ///
    /// # Errors
    /// As [`simulate`].
    pub fn of_unit(unit: &StudyUnit<'_>, interrupt: &Interrupt) -> Result<Self, Failure> {
        let StudyUnit {
            setup,
            planner,
            seed,
            ..
        } = *unit;
        simulate(setup, planner, seed, interrupt, &mut NoObserver).map(Self::from)
    }
}

impl From<RunOutcome> for SummaryRecord {
    fn from(outcome: RunOutcome) -> Self {
        Self {
            summary: outcome.summary,
            warnings: outcome.warnings,
        }
    }
}
