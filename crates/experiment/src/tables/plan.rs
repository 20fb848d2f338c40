//! Running everything that a configuration asks for.

use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, InputError, Interrupt};
use adslam_scenario::config::{Config, ExperimentPlan, Selection};
use adslam_scenario::registry::Registry;
use adslam_setup::Setup;
use adslam_simulation::RunSummary;

use super::{ExperimentTables, PlannerRuns, SourceFile, Tables};
use crate::provenance::{Build, BuildRuns};
use crate::run::{Batch, Progress, warnings};
use crate::study::{
    OtherBuilds, Study, StudyEnd, StudyPlan, StudyPoint, StudyUnit, SummaryRecord, points,
};

/// A configuration made ready to run: all files read, all surfaces built.
#[derive(Debug)]
pub struct TablePlan {
    title: String,
    runs: usize,
    first_seed: u64,
    sources: Vec<SourceFile>,
    mesh: Option<PathBuf>,
    experiments: Vec<(ExperimentPlan, Setup)>,
}

impl TablePlan {
    /// Reads the configuration at `path` and builds what is selected of it.
    ///
    /// # Errors
    /// Anything wrong with a file, an unknown label, or no runs to do.
    pub fn load(path: &Path, selection: &Selection) -> Result<Self, InputError> {
        Self::load_with(path, selection, &Registry::standard())
    }

    /// The same for a program with planners of its own.
    ///
    /// # Errors
    /// As [`TablePlan::load`].
    pub fn load_with(
        path: &Path,
        selection: &Selection,
        registry: &Registry,
    ) -> Result<Self, InputError> {
        Self::new(Config::load_with(path, registry)?, selection)
    }

    /// Builds what is selected of a configuration.
    ///
    /// # Errors
    /// As [`TablePlan::load`].
    pub fn new(config: Config, selection: &Selection) -> Result<Self, InputError> {
        let Config {
            path,
            text,
            title,
            runs,
            first_seed,
            experiments,
        } = config.select(selection)?;
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
            sources,
            mesh: selection.mesh.clone(),
            experiments: ready,
        })
    }

    /// The configuration's title.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// How many runs there are in all.
    #[must_use]
    pub fn total_runs(&self) -> usize {
        self.experiments
            .iter()
            .map(|(plan, _)| plan.planners.len() * self.runs)
            .sum()
    }

    /// What the user should know before running, each once.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        points::warnings(self.points())
    }

    /// Every experiment with its planners.
    fn points(&self) -> impl Iterator<Item = StudyPoint<'_>> + Clone {
        self.experiments.iter().map(|(plan, setup)| StudyPoint {
            setup,
            planners: &plan.planners,
            label: Some(&plan.label),
        })
    }

    fn study(&self) -> StudyPlan<'_> {
        StudyPlan {
            kind: "configuration's tables",
            points: self.points().collect(),
            first_seed: self.first_seed,
            runs: self.runs,
        }
    }

    /// Begins the runs in `folder`, resumes them, or lets them grow.
    ///
    /// # Errors
    /// As [`Study::open`].
    pub fn open(
        &self,
        folder: &Path,
        other_builds: OtherBuilds,
    ) -> Result<Study<'_, SummaryRecord>, Failure> {
        Study::open(folder, &self.study(), other_builds)
    }

    /// The tables of the records of this plan's study, in its order; `end` is how the work on it ended, and
    /// `builds` what made them, as [`Study::builds`] says.
    #[must_use]
    pub fn tables(
        &self,
        records: &[Option<SummaryRecord>],
        end: StudyEnd,
        builds: Vec<BuildRuns>,
    ) -> Tables {
        let mut tables = Tables {
            title: self.title.clone(),
            runs: self.runs,
            first_seed: self.first_seed,
            experiments: Vec::new(),
            sources: self.sources.clone(),
            mesh: self.mesh.clone(),
            failures: end.failures,
            interrupted: end.interrupted,
            warnings: self.warnings(),
            builds,
        };
        let mut columns = records.chunks(self.runs);
        for (plan, setup) in &self.experiments {
            let mut of_runs = Vec::new();
            let planners = plan.planners.iter().map(|&planner| {
                let done = columns.next().unwrap_or_default().iter().flatten();
                of_runs.extend(done.clone().map(|record| record.warnings.as_slice()));
                PlannerRuns {
                    planner,
                    look: plan.scenario.registry().look(planner),
                    runs: done.map(|record| record.summary.clone()).collect(),
                }
            });
            let planners = planners.collect();
            tables.warn(warnings::merged(of_runs));
            tables.experiments.push(ExperimentTables {
                label: plan.label.clone(),
                steps: setup.model.steps,
                planners,
                published: plan.published.clone(),
                histories: Vec::new(),
            });
        }
        tables
    }

    /// Does all runs in parallel and keeps none in a folder. A run that fails, or an interruption, loses none of
    /// the others.
    #[must_use]
    pub fn run(&self, interrupt: &Interrupt, progress: Progress<'_>) -> Tables {
        let study = self.study();
        let units = study.units(&vec![0; study.points.len()]);
        let batch: Vec<Batch<'_>> = units.iter().map(|unit| batch(unit, false)).collect();
        let mut end = StudyEnd::default();
        let results = Batch::run_all(&batch, interrupt, progress).into_iter();
        let records = results.zip(&units).map(|(result, unit)| match result {
            Ok(outcome) => Some(SummaryRecord::from(outcome)),
            Err(Failure::Interrupted) => {
                end.interrupted = true;
                None
            }
            Err(error) => {
                let label = unit.label.unwrap_or_default();
                end.failures.push(format!("[{label}] {error}"));
                None
            }
        });
        let records: Vec<_> = records.collect();
        let builds = vec![BuildRuns {
            build: Build::this(),
            runs: records.iter().flatten().count(),
        }];
        self.tables(&records, end, builds)
    }

    /// Does the first run of each planner again, where `tables` has it, and keeps it step by step. A run that is not
    /// the same as in the tables, as one of another build may be, is warned of.
    ///
    /// # Errors
    /// [`Failure::Interrupted`], or a run that fails, which it did not when the tables were made.
    pub fn record(&self, tables: &mut Tables, interrupt: &Interrupt) -> Result<(), Failure> {
        let study = StudyPlan {
            runs: 1,
            ..self.study()
        };
        let units = study.units(&vec![0; study.points.len()]);
        let there = |unit: &StudyUnit<'_>| {
            let planners = &tables.experiments[unit.point].planners;
            let column = planners.iter().find(|of| of.planner == unit.planner)?;
            let run = column.runs.iter().find(|run| run.seed == unit.seed)?;
            Some(timeless(run))
        };
        let (units, expected): (Vec<_>, Vec<_>) = units
            .into_iter()
            .filter_map(|unit| there(&unit).map(|run| (unit, run)))
            .unzip();
        let batch: Vec<Batch<'_>> = units.iter().map(|unit| batch(unit, true)).collect();
        let results = Batch::run_all(&batch, interrupt, &|| ());
        for ((unit, expected), result) in units.iter().zip(expected).zip(results) {
            let outcome = result?;
            let label = unit.label.unwrap_or_default();
            if timeless(&outcome.summary) != expected {
                tables.warn([format!(
                    "{label}, {}, seed {}: figures and replay show a run that this build did anew, and it is not the \
                     one in the tables",
                    unit.planner, unit.seed
                )]);
            }
            tables.experiments[unit.point]
                .histories
                .extend(outcome.history);
        }
        Ok(())
    }
}

fn batch<'a>(unit: &StudyUnit<'a>, record: bool) -> Batch<'a> {
    Batch {
        setup: unit.setup,
        planner: unit.planner,
        seed: unit.seed,
        record,
    }
}

/// What is the same whenever a run is done.
fn timeless(run: &RunSummary) -> RunSummary {
    RunSummary {
        decision_ms: None,
        ..run.clone()
    }
}
