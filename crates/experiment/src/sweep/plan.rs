//! A sweep made ready to run.

use std::path::Path;

use adslam_diagnostics::{Failure, InputError};
use adslam_scenario::config::checked_runs;
use adslam_scenario::registry::Registry;
use adslam_scenario::sweep::Sweep;
use adslam_setup::Setup;

use crate::study::{OtherBuilds, Study, StudyPlan, StudyPoint, SummaryRecord, points};

/// A sweep made ready to run: the object of every point built.
#[derive(Debug)]
pub struct SweepPlan {
    pub(super) sweep: Sweep,
    pub(super) runs: usize,
    /// Of the points, in their order.
    pub(super) setups: Vec<Setup>,
}

impl SweepPlan {
    /// Reads the sweep at `path` and builds its points; with another number of runs, if one is given.
    ///
    /// # Errors
    /// Anything wrong with a file, or too many runs.
    pub fn load(path: &Path, runs: Option<usize>) -> Result<Self, InputError> {
        Self::load_with(path, runs, &Registry::standard())
    }

    /// The same for a program with planners of its own.
    ///
    /// # Errors
    /// As [`SweepPlan::load`].
    pub fn load_with(
        path: &Path,
        runs: Option<usize>,
        registry: &Registry,
    ) -> Result<Self, InputError> {
        Self::new(Sweep::load_with(path, registry)?, runs)
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
    fn points(&self) -> impl Iterator<Item = StudyPoint<'_>> + Clone {
        let planners = self.sweep.planners.as_slice();
        let point = move |setup| StudyPoint {
            setup,
            planners,
            label: None,
        };
        self.setups.iter().map(point)
    }

    /// Begins the sweep in `folder`, resumes it, or lets it grow.
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

    /// The runs: point by point, planner by planner, seed by seed.
    fn study(&self) -> StudyPlan<'_> {
        StudyPlan {
            kind: "sweep",
            points: self.points().collect(),
            first_seed: self.sweep.first_seed,
            runs: self.runs,
        }
    }
}
