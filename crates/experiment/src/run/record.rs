//! A run written down: steps.csv, features.csv, the trajectories and summary.json.

use std::path::{Path, PathBuf};

use super::{Observer, StepView};
use crate::ExperimentError;
use crate::metrics::RunSummary;
use crate::output::{AtomicFile, FeaturesFile, LastFeatures, StepsFile, TumFile};

/// Writes a run into a folder. The files appear when the run has finished, all complete.
#[derive(Debug)]
pub struct RunRecorder {
    folder: PathBuf,
    steps: StepsFile,
    features: FeaturesFile,
    truth: TumFile,
    estimate: TumFile,
    last: LastFeatures,
}

impl RunRecorder {
    /// Begins to write into `folder`, which must exist.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn create(folder: &Path, feature_count: usize) -> Result<Self, ExperimentError> {
        Ok(Self {
            folder: folder.to_owned(),
            steps: StepsFile::create(&folder.join("steps.csv"), feature_count)?,
            features: FeaturesFile::create(&folder.join("features.csv"), feature_count)?,
            truth: TumFile::create(&folder.join("truth.tum"))?,
            estimate: TumFile::create(&folder.join("estimate.tum"))?,
            last: LastFeatures::default(),
        })
    }

    /// Completes all files; returns their paths, summary.json first.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn commit(self, summary: &RunSummary) -> Result<Vec<PathBuf>, ExperimentError> {
        self.steps.commit()?;
        self.features.commit(&self.last)?;
        self.truth.commit()?;
        self.estimate.commit()?;
        // Last, so that a summary means that the rest is there.
        let path = self.folder.join("summary.json");
        AtomicFile::write_json(&path, summary)?;
        let others = ["steps.csv", "features.csv", "truth.tum", "estimate.tum"];
        Ok(std::iter::once(path)
            .chain(others.map(|name| self.folder.join(name)))
            .collect())
    }
}

impl Observer for RunRecorder {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), ExperimentError> {
        self.steps.add(view)?;
        self.features.add(view);
        self.truth.add(view.step, view.pose)?;
        self.estimate.add(view.step, &view.belief.state.pose)?;
        self.last = LastFeatures::of(view);
        Ok(())
    }
}
