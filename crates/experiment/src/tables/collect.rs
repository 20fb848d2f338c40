//! Running everything that a configuration asks for.

use std::path::{Path, PathBuf};

use crate::ExperimentError;
use crate::config::{Config, ExperimentPlan, PublishedScenario, Selection};
use crate::diagnostics::InputError;
use crate::metrics::RunSummary;
use crate::run::warnings::merged;
use crate::run::{Batch, BatchResult, Interrupt, RunHistory, RunOutcome, Setup};
use crate::scenario::PlannerName;

/// What of a configuration is run, and what is kept of it.
#[derive(Clone, Debug, Default)]
pub struct TablesOptions {
    /// What is run.
    pub selection: Selection,
    /// Whether the first run of each planner is kept step by step.
    pub record: bool,
}

/// A configuration made ready to run: all files read, all surfaces built.
#[derive(Debug)]
pub struct TablePlan {
    title: String,
    runs: usize,
    first_seed: u64,
    record: bool,
    sources: Vec<SourceFile>,
    mesh: Option<PathBuf>,
    experiments: Vec<(ExperimentPlan, Setup)>,
}

/// Told after each run: how many have finished.
pub type TablesProgress<'a> = &'a (dyn Fn() + Sync);

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
    /// The mesh that took the place of the scenarios' own, as [`Selection::mesh`] says.
    pub mesh: Option<PathBuf>,
    /// Runs that failed, and why.
    pub failures: Vec<String>,
    /// Whether the user stopped it before all runs were done.
    pub interrupted: bool,
    /// What the user should know.
    pub warnings: Vec<String>,
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
    /// The first run of each planner, where [`TablesOptions::record`] asked for it and it ended
    /// well; in the order of the planners.
    pub histories: Vec<RunHistory>,
}

/// The finished runs of one planner, by seed.
#[derive(Clone, Debug)]
pub struct PlannerRuns {
    /// Which planner.
    pub planner: PlannerName,
    /// Its runs.
    pub runs: Vec<RunSummary>,
}

impl TablePlan {
    /// Reads the configuration at `path` and builds what it names.
    ///
    /// # Errors
    /// Anything wrong with a file, an unknown label, or no runs to do.
    pub fn load(path: &Path, options: &TablesOptions) -> Result<Self, InputError> {
        Self::new(Config::load(path)?, options)
    }

    /// Builds what a configuration names.
    ///
    /// # Errors
    /// As [`TablePlan::load`].
    pub fn new(config: Config, options: &TablesOptions) -> Result<Self, InputError> {
        let Config {
            path,
            text,
            title,
            runs,
            first_seed,
            experiments,
        } = config.select(&options.selection)?;
        let mut sources = vec![SourceFile { path, text }];
        let mut ready = Vec::new();
        for plan in experiments {
            let (path, text) = (plan.scenario.path(), plan.scenario.text());
            if sources.iter().all(|known| known.path != path) {
                sources.push(SourceFile {
                    path: path.to_owned(),
                    text: text.to_owned(),
                });
            }
            let setup = Setup::new(&plan.scenario)?;
            ready.push((plan, setup));
        }
        Ok(Self {
            title,
            runs,
            first_seed,
            record: options.record,
            sources,
            mesh: options.selection.mesh.clone(),
            experiments: ready,
        })
    }

    /// How many runs there are in all.
    #[must_use]
    pub fn total_runs(&self) -> usize {
        self.experiments
            .iter()
            .map(|(plan, _)| plan.planners.len() * self.runs)
            .sum()
    }

    /// Does all runs in parallel. A run that fails, or an interruption, loses none of the others.
    #[must_use]
    pub fn run(&self, interrupt: &Interrupt, progress: TablesProgress<'_>) -> Tables {
        let mut batch = Vec::with_capacity(self.total_runs());
        for (plan, setup) in &self.experiments {
            for &planner in &plan.planners {
                for k in 0..self.runs as u64 {
                    let seed = self.first_seed.wrapping_add(k);
                    batch.push(Batch {
                        setup,
                        planner,
                        seed,
                        record: self.record && k == 0,
                    });
                }
            }
        }
        let mut results = Batch::run_all(&batch, interrupt, progress).into_iter();
        let mut tables = Tables {
            title: self.title.clone(),
            runs: self.runs,
            first_seed: self.first_seed,
            experiments: Vec::new(),
            sources: self.sources.clone(),
            mesh: self.mesh.clone(),
            failures: Vec::new(),
            interrupted: false,
            warnings: Vec::new(),
        };
        for (plan, setup) in &self.experiments {
            tables.warn(setup.warnings.iter().cloned());
            let mut histories = Vec::new();
            let mut of_runs = Vec::new();
            let planners = plan.planners.iter().map(|&planner| {
                let mut runs = Vec::with_capacity(self.runs);
                for result in results.by_ref().take(self.runs) {
                    let Some(outcome) = tables.sort_in(&plan.label, result) else {
                        continue;
                    };
                    runs.push(outcome.summary);
                    of_runs.push(outcome.warnings);
                    histories.extend(outcome.history);
                }
                PlannerRuns { planner, runs }
            });
            let planners = planners.collect();
            tables.warn(merged(of_runs.iter().map(Vec::as_slice)));
            tables.experiments.push(ExperimentTables {
                label: plan.label.clone(),
                steps: setup.steps,
                planners,
                published: plan.published.clone(),
                histories,
            });
        }
        tables
    }
}

impl Tables {
    /// A run of the experiment `label` that finished; notes what became of any other.
    fn sort_in(&mut self, label: &str, result: BatchResult) -> Option<RunOutcome> {
        match result {
            Ok(outcome) => Some(outcome),
            Err(ExperimentError::Interrupted) => {
                self.interrupted = true;
                None
            }
            Err(error) => {
                self.failures.push(format!("[{label}] {error}"));
                None
            }
        }
    }

    /// Whether everything that was asked for is there.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !self.interrupted && self.failures.is_empty()
    }

    /// An error if it is not.
    ///
    /// # Errors
    /// [`ExperimentError::Interrupted`] where runs were not done, else [`ExperimentError::Runs`]
    /// where some failed.
    pub fn into_result(self) -> Result<(), ExperimentError> {
        ExperimentError::unless_complete(self.interrupted, self.failures)
    }

    /// Adds warnings that are not there yet: two experiments may give the same.
    fn warn(&mut self, warnings: impl IntoIterator<Item = String>) {
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

    fn result(failures: &[&str], interrupted: bool) -> Result<(), ExperimentError> {
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
        };
        tables.into_result()
    }

    #[test]
    fn an_interruption_stays_one_whatever_had_failed_before() {
        assert!(result(&[], false).is_ok());
        let failed = result(&["a"], false);
        assert!(matches!(failed, Err(ExperimentError::Runs { failures }) if failures == ["a"]));
        for failures in [&[][..], &["a"]] {
            let stopped = result(failures, true);
            assert!(matches!(stopped, Err(ExperimentError::Interrupted)));
        }
    }
}
