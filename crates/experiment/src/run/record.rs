//! A run written down: steps.csv, features.csv, the trajectories, its history and summary.json.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::{HistoryRecorder, Observer, RunHistory, Setup, StepView};
use crate::ExperimentError;
use crate::metrics::RunSummary;
use crate::output::{AtomicFile, FeaturesFile, LastFeatures, StepsFile, TumFile, TumTime};
use crate::scenario::{LengthUnit, PlannerName};

/// Writes a run into a folder. The files appear when the run has finished, all complete.
#[derive(Debug)]
pub struct RunRecorder<'a> {
    folder: PathBuf,
    history: HistoryRecorder<'a>,
    summary: AtomicFile,
    steps: StepsFile,
    features: FeaturesFile,
    truth: TumFile,
    estimate: TumFile,
    last: LastFeatures,
}

/// What summary.json holds.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct RunReport<'a> {
    /// The run in a few numbers.
    #[serde(flatten)]
    pub summary: &'a RunSummary,
    /// What its user should know of it and of its scenario.
    pub warnings: &'a [String],
}

impl<'a> RunRecorder<'a> {
    /// Begins to write the run of `planner` with `seed` into `folder`, which must exist; the positions of the
    /// trajectories in `unit`.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn create(
        folder: &Path,
        setup: &'a Setup,
        planner: PlannerName,
        seed: u64,
        unit: LengthUnit,
    ) -> Result<Self, ExperimentError> {
        let feature_count = setup.world.rest.len();
        let trajectory =
            |name: &str| TumFile::create(&folder.join(name), TumTime::Step, LengthUnit::Cm, unit);
        Ok(Self {
            folder: folder.to_owned(),
            history: HistoryRecorder::new(setup, planner, seed),
            summary: AtomicFile::create(&folder.join("summary.json"))?,
            steps: StepsFile::create(&folder.join("steps.csv"), feature_count)?,
            features: FeaturesFile::create(&folder.join("features.csv"), feature_count)?,
            truth: trajectory("truth.tum")?,
            estimate: trajectory("estimate.tum")?,
            last: LastFeatures::default(),
        })
    }

    /// The run so far.
    #[must_use]
    pub const fn history(&self) -> &RunHistory {
        self.history.history()
    }

    /// Completes all files and returns their paths. summary.json comes last: where it is, the others
    /// are.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn commit(mut self, report: &RunReport<'_>) -> Result<Vec<PathBuf>, ExperimentError> {
        self.summary.add_json(report)?;
        let files = vec![
            self.steps.finish()?,
            self.features.finish(&self.last)?,
            self.truth.finish(),
            self.estimate.finish(),
            self.history.finish(&self.folder)?,
            self.summary,
        ];
        let paths = files.iter().map(|file| file.path().to_owned()).collect();
        AtomicFile::commit_all(files)?;
        Ok(paths)
    }
}

impl Observer for RunRecorder<'_> {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), ExperimentError> {
        self.steps.add(view)?;
        self.features.add(view);
        self.truth.add(view.step, view.pose)?;
        self.estimate.add(view.step, &view.belief.state.pose)?;
        self.last = LastFeatures::of(view);
        self.history.step(view)
    }
}
