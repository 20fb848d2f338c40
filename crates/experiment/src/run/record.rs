//! A run written down: its scenario, steps.csv, pose_covariance.csv, features.csv, the trajectories, its history,
//! summary.json and run.json.

use std::path::{Path, PathBuf};

use adslam_diagnostics::Failure;
use adslam_names::{LengthUnit, PlannerName};
use adslam_record::{
    AtomicFile, FeaturesFile, HistoryRecorder, LastFeatures, Observer, PoseCovarianceFile,
    RunHistory, StepsFile, TumFile, TumTime,
};
use adslam_setup::Setup;
use adslam_simulation::{RunSummary, StepView};
use serde::Serialize;

use super::folder::{RunFolder, SCENARIO_FILE};
use super::manifest::RunManifest;

/// Writes a run into a folder. The files appear when the run has finished, all complete, in the place of the run that
/// was there.
#[derive(Debug)]
pub struct RunRecorder {
    history: HistoryRecorder,
    summary: AtomicFile,
    scenario: AtomicFile,
    steps: StepsFile,
    pose_covariance: PoseCovarianceFile,
    features: FeaturesFile,
    truth: TumFile,
    estimate: TumFile,
    last: LastFeatures,
    manifest: RunManifest,
    path: PathBuf,
    folder: RunFolder,
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

impl RunRecorder {
    /// Begins to write the run of `planner` with `seed` into `folder`, which is made if need be and is locked until
    /// the recorder is dropped; the positions of the trajectories in `unit`.
    ///
    /// # Errors
    /// [`InputError`](adslam_diagnostics::InputError) where the folder holds anything but a run, where another
    /// process works in it and where it cannot be written to; [`Failure::Output`].
    pub fn create(
        folder: &Path,
        setup: &Setup,
        planner: PlannerName,
        seed: u64,
        unit: LengthUnit,
    ) -> Result<Self, Failure> {
        let scenario = setup.scenario.to_toml()?;
        let lock = RunFolder::lock(folder)?;
        let feature_count = setup.model.world.rest.len();
        let path = |name: &str| folder.join(name);
        let trajectory =
            |name: &str| TumFile::create(&path(name), TumTime::Step, LengthUnit::Cm, unit);
        Ok(Self {
            history: HistoryRecorder::new(&setup.model, planner, seed)
                .with_look(setup.scenario.registry().look(planner)),
            summary: AtomicFile::create(&path("summary.json"))?,
            scenario: AtomicFile::with_content(&path(SCENARIO_FILE), scenario.as_bytes())?,
            steps: StepsFile::create(&path("steps.csv"), feature_count)?,
            pose_covariance: PoseCovarianceFile::create(&path("pose_covariance.csv"))?,
            features: FeaturesFile::create(&path("features.csv"), feature_count)?,
            truth: trajectory("truth.tum")?,
            estimate: trajectory("estimate.tum")?,
            last: LastFeatures::default(),
            manifest: RunManifest::new(setup, planner, seed),
            path: folder.to_owned(),
            folder: lock,
        })
    }

    /// The run so far.
    #[must_use]
    pub const fn history(&self) -> &RunHistory {
        self.history.history()
    }

    /// Completes all files, and `others` that belong to the run, and returns their paths. Files of a run that was
    /// there are removed before. run.json comes last: where it says so, the others are there and of one run.
    ///
    /// # Errors
    /// [`Failure::Output`]; unless a file cannot be renamed, nothing has changed then.
    pub fn commit(
        mut self,
        report: &RunReport<'_>,
        others: Vec<AtomicFile>,
    ) -> Result<Vec<PathBuf>, Failure> {
        self.summary.add_json(report)?;
        let mut files = vec![
            self.scenario,
            self.steps.finish()?,
            self.pose_covariance.finish()?,
            self.features.finish(&self.last)?,
            self.truth.finish(),
            self.estimate.finish(),
            self.history.finish(&self.path)?,
        ];
        files.extend(others);
        files.push(self.summary);
        self.folder.replace(self.manifest, files)
    }
}

impl Observer for RunRecorder {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        self.steps.add(view)?;
        self.pose_covariance.add(view)?;
        self.features.add(view);
        self.truth.add(view.step, view.pose)?;
        self.estimate.add(view.step, &view.belief.state.pose)?;
        self.last = LastFeatures::of(view);
        self.history.step(view)
    }
}
