//! A sweep made ready to run.

use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::Sweep;
use crate::ExperimentError;
use crate::config::checked_runs;
use crate::diagnostics::InputError;
use crate::metrics::RunSummary;
use crate::run::{Interrupt, NoObserver, Setup, simulate};
use crate::scenario::Named;
use crate::study::points::{self, Point};
use crate::study::{Study, StudyPlan, StudyUnit};

/// A sweep made ready to run: the object of every point built.
#[derive(Debug)]
pub struct SweepPlan {
    pub(super) sweep: Sweep,
    pub(super) runs: usize,
    /// Of the points, in their order.
    pub(super) setups: Vec<Setup>,
}

/// What is kept of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepRecord {
    /// Its numbers.
    pub summary: RunSummary,
    /// What the user should know of it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

impl SweepPlan {
    /// Reads the sweep at `path` and builds its points; with another number of runs, if one is given.
    ///
    /// # Errors
    /// Anything wrong with a file, or too many runs.
    pub fn load(path: &Path, runs: Option<usize>) -> Result<Self, InputError> {
        Self::new(Sweep::load(path)?, runs)
    }

    /// Builds the points of a sweep; with another number of runs, if one is given.
    ///
    /// # Errors
    /// An object that cannot be built, a robot that starts inside it, or too many runs.
    pub fn new(sweep: Sweep, runs: Option<usize>) -> Result<Self, InputError> {
        if let Some(runs) = runs {
            checked_runs(&sweep.path, runs)?;
            if sweep.runs_in_all(runs).is_none() {
                let message = sweep.too_many(runs);
                return Err(InputError::about_file(&sweep.path, message)
                    .with_help("ask for fewer with --runs"));
            }
        }
        Ok(Self {
            runs: runs.unwrap_or(sweep.runs),
            setups: Setup::of_all(sweep.points.iter().map(|point| &point.scenario))?,
            sweep,
        })
    }

    /// The sweep.
    #[must_use]
    pub const fn sweep(&self) -> &Sweep {
        &self.sweep
    }

    /// How many runs there are in all.
    #[must_use]
    pub fn total_runs(&self) -> usize {
        self.setups.len() * self.sweep.planners.len() * self.runs
    }

    /// What the user should know before running, each once.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        points::warnings(self.points())
    }

    /// Every point with its planners.
    fn points(&self) -> impl Iterator<Item = Point<'_>> + Clone {
        let planners = self.sweep.planners.as_slice();
        self.setups.iter().map(move |setup| (setup, planners))
    }

    /// Begins the sweep in `folder`, or goes on with it.
    ///
    /// # Errors
    /// As [`Study::open`].
    pub fn open(&self, folder: &Path) -> Result<Study<'_, SweepRecord>, ExperimentError> {
        Study::open(folder, self.study())
    }

    /// Does one run: the work of the sweep's study.
    ///
    /// # Errors
    /// As [`simulate`].
    pub fn run(
        unit: &StudyUnit<'_>,
        interrupt: &Interrupt,
    ) -> Result<SweepRecord, ExperimentError> {
        let outcome = simulate(
            unit.setup,
            unit.planner,
            unit.seed,
            interrupt,
            &mut NoObserver,
        )?;
        Ok(SweepRecord {
            summary: outcome.summary,
            warnings: outcome.warnings,
        })
    }

    /// The runs: point by point, planner by planner, seed by seed.
    fn study(&self) -> StudyPlan<'_> {
        StudyPlan {
            kind: "sweep",
            identity: self.identity(),
            units: points::units(self.points(), self.sweep.first_seed, self.runs),
        }
    }

    fn identity(&self) -> Map<String, Value> {
        let points = self.sweep.points.iter().zip(&self.setups);
        let points: Vec<Value> = points
            .map(|(point, setup)| {
                json!({ "set": point.overrides, "object_crc32": setup.object_checksum() })
            })
            .collect();
        let planners: Vec<&str> = self
            .sweep
            .planners
            .iter()
            .map(|planner| planner.as_str())
            .collect();
        let parts = [
            ("runs", json!(self.runs)),
            ("first_seed", json!(self.sweep.first_seed)),
            ("planners", json!(planners)),
            ("scenario", self.sweep.scenario.keys()),
            ("points", json!(points)),
        ];
        parts
            .map(|(name, value)| (name.to_owned(), value))
            .into_iter()
            .collect()
    }
}
