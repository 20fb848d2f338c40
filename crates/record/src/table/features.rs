//! features.csv: the features at the end of a run.

use std::path::Path;

use adslam_diagnostics::Failure;
use adslam_models::FeatureId;
use adslam_simulation::StepView;
use nalgebra::Vector3;
use serde::Serialize;

use crate::AtomicFile;

/// How often each feature was seen, and where it and its estimate are at the last step.
#[derive(Debug)]
pub struct FeaturesFile {
    file: AtomicFile,
    seen: Vec<Seen>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    first_step: Option<usize>,
    times: usize,
    nees_sum: f64,
    nees_count: u32,
}

#[derive(Serialize)]
struct Row {
    feature: usize,
    first_seen_step: Option<usize>,
    times_seen: usize,
    true_x_cm: f64,
    true_y_cm: f64,
    true_z_cm: f64,
    estimated_x_cm: f64,
    estimated_y_cm: f64,
    estimated_z_cm: f64,
    sigma_x_cm: f64,
    sigma_y_cm: f64,
    sigma_z_cm: f64,
    error_cm: f64,
    /// Over the steps that have one; 3 is consistent.
    nees_mean: Option<f64>,
}

impl FeaturesFile {
    /// Starts the file for a run with this many features.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn create(path: &Path, feature_count: usize) -> Result<Self, Failure> {
        let seen = vec![Seen::default(); feature_count];
        Ok(Self {
            file: AtomicFile::create(path)?,
            seen,
        })
    }

    /// Counts what a step sees, and adds up the NEES. As in the paper, the start counts for coverage,
    /// not for the times.
    pub fn add(&mut self, view: &StepView<'_>) {
        for feature in view.visible {
            if let Some(seen) = self.seen.get_mut(feature.0) {
                seen.first_step.get_or_insert(view.step);
                seen.times += usize::from(view.step > 1);
            }
        }
        for (seen, nees) in self.seen.iter_mut().zip(&view.metrics.feature_nees) {
            if let Some(nees) = nees {
                seen.nees_sum += nees;
                seen.nees_count += 1;
            }
        }
    }

    /// Writes the features as they are at the last step; the file still has to be committed.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn finish(self, last: &LastFeatures) -> Result<AtomicFile, Failure> {
        let path = self.file.path().to_owned();
        let mut writer = csv::Writer::from_writer(self.file);
        for (i, seen) in self.seen.iter().enumerate() {
            let (Some(p), Some(e), Some(sigma)) =
                (last.truth.get(i), last.estimate.get(i), last.sigma.get(i))
            else {
                continue;
            };
            writer
                .serialize(Row {
                    feature: i,
                    first_seen_step: seen.first_step,
                    times_seen: seen.times,
                    true_x_cm: p.x,
                    true_y_cm: p.y,
                    true_z_cm: p.z,
                    estimated_x_cm: e.x,
                    estimated_y_cm: e.y,
                    estimated_z_cm: e.z,
                    sigma_x_cm: sigma.x,
                    sigma_y_cm: sigma.y,
                    sigma_z_cm: sigma.z,
                    error_cm: (e - p).norm(),
                    nees_mean: (seen.nees_count > 0)
                        .then(|| seen.nees_sum / f64::from(seen.nees_count)),
                })
                .map_err(Failure::output(&path))?;
        }
        writer
            .into_inner()
            .map_err(|error| Failure::output(&path)(error.into_error()))
    }
}

/// The features at the last step seen so far, cm.
#[derive(Clone, Debug, Default)]
pub struct LastFeatures {
    truth: Vec<Vector3<f64>>,
    estimate: Vec<Vector3<f64>>,
    sigma: Vec<Vector3<f64>>,
}

impl LastFeatures {
    /// The features of a step.
    #[must_use]
    pub fn of(view: &StepView<'_>) -> Self {
        let estimate = &view.belief.state.features;
        let sigma = |i: usize| {
            view.belief
                .covariance
                .feature(FeatureId(i))
                .diagonal()
                .map(|v| v.max(0.0).sqrt())
        };
        Self {
            truth: view.features.iter().map(|p| p.coords).collect(),
            estimate: estimate.iter().map(|p| p.coords).collect(),
            sigma: (0..estimate.len()).map(sigma).collect(),
        }
    }
}
