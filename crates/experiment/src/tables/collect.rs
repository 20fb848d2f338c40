//! The results of a configuration.

use std::path::PathBuf;

use adslam_diagnostics::Failure;
use adslam_names::{Look, PlannerName};
use adslam_record::RunHistory;
use adslam_scenario::config::PublishedScenario;
use adslam_simulation::RunSummary;

use crate::provenance::BuildRuns;

/// The results of a configuration.
#[derive(Clone, Debug)]
pub struct Tables {
    /// The configuration's title.
    pub title: String,
    /// Runs of each planner that were asked for.
    pub runs: usize,
    /// The seed of the first of them; the others count up from it.
    pub first_seed: u64,
    /// The experiments, in the configuration's order.
    pub experiments: Vec<ExperimentTables>,
    /// The configuration and then its scenarios, each once.
    pub sources: Vec<SourceFile>,
    /// The mesh that took the place of the scenarios' own, as [`Selection::mesh`](adslam_scenario::config::Selection::mesh) says.
    pub mesh: Option<PathBuf>,
    /// Runs that failed, and why.
    pub failures: Vec<String>,
    /// Whether the user stopped it before all runs were done.
    pub interrupted: bool,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// What made the runs.
    pub builds: Vec<BuildRuns>,
}

/// A file that results were made from, as it was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// Where it lies.
    pub path: PathBuf,
    /// What it says.
    pub text: String,
}

/// The results of one experiment.
#[derive(Clone, Debug)]
pub struct ExperimentTables {
    /// Its label.
    pub label: String,
    /// Steps of a run.
    pub steps: usize,
    /// Its planners, in the configuration's order.
    pub planners: Vec<PlannerRuns>,
    /// The published values.
    pub published: Option<PublishedScenario>,
    /// The first run of each planner, where it was recorded: by [`TablePlan::record`]; in the order of the
    /// planners.
    ///
    /// [`TablePlan::record`]: super::TablePlan::record
    pub histories: Vec<RunHistory>,
}

/// The finished runs of one planner, by seed.
#[derive(Clone, Debug)]
pub struct PlannerRuns {
    /// Which planner.
    pub planner: PlannerName,
    /// What it looks like, where its name does not say it.
    pub look: Option<Look>,
    /// Its runs.
    pub runs: Vec<RunSummary>,
}

impl Tables {
    /// Whether everything that was asked for is there.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !self.interrupted && self.failures.is_empty()
    }

    /// An error if it is not.
    ///
    /// # Errors
    /// [`Failure::Interrupted`] where runs were not done, else [`Failure::Runs`]
    /// where some failed.
    pub fn into_result(self) -> Result<(), Failure> {
        Failure::unless_complete(self.interrupted, self.failures)
    }

    /// Adds warnings that are not there yet: two experiments may give the same.
    pub(super) fn warn(&mut self, warnings: impl IntoIterator<Item = String>) {
        for warning in warnings {
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn result(failures: &[&str], interrupted: bool) -> Result<(), Failure> {
        let tables = Tables {
            title: String::new(),
            runs: 2,
            first_seed: 1,
            experiments: Vec::new(),
            sources: Vec::new(),
            mesh: None,
            failures: failures.iter().map(ToString::to_string).collect(),
            interrupted,
            warnings: Vec::new(),
            builds: Vec::new(),
        };
        tables.into_result()
    }

    #[test]
    fn an_interruption_stays_one_whatever_had_failed_before() {
        assert!(result(&[], false).is_ok());
        let failed = result(&["a"], false);
        assert!(matches!(failed, Err(Failure::Runs { failures }) if failures == ["a"]));
        for failures in [&[][..], &["a"]] {
            let stopped = result(failures, true);
            assert!(matches!(stopped, Err(Failure::Interrupted)));
        }
    }
}
