//! A run written down as a log.

use std::path::Path;

use adslam_agent::{GateProbability, StepInput};
use adslam_diagnostics::Failure;
use adslam_estimator::StructureMeasurements;
use adslam_models::State;
use adslam_names::{LengthUnit, Named, PlannerName};
use adslam_simulation::{EpisodeModel, StepView};
use nalgebra::Vector3;

use super::format::{
    FORMAT, InitialEstimate, LogControl, LogFeature, LogFilter, LogHeader, LogNoise, LogPair,
    LogStep, LogTruth, VERSION, rows,
};
use crate::{AtomicFile, Observer};

/// The name of the log in a run's folder.
pub const LOG_FILE: &str = "log.jsonl";

/// Writes a run as a log with its truth, from which a [`Replay`](super::Replay) makes the run's estimates again,
/// to the last bit.
#[derive(Debug)]
pub struct LogRecorder {
    file: AtomicFile,
    model: EpisodeModel,
    source: String,
}

impl LogRecorder {
    /// Begins to write the run of `planner` with `seed` into `folder`, which must exist.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn create(
        folder: &Path,
        model: &EpisodeModel,
        planner: PlannerName,
        seed: u64,
    ) -> Result<Self, Failure> {
        Ok(Self {
            file: AtomicFile::create(&folder.join(LOG_FILE))?,
            model: model.clone(),
            source: format!(
                "adslam {}: {}, {planner} planner, seed {seed}",
                env!("CARGO_PKG_VERSION"),
                model.name
            ),
        })
    }

    /// Ends the log; its file still has to be committed.
    #[must_use]
    pub fn finish(self) -> AtomicFile {
        self.file
    }

    fn header(&self, view: &StepView<'_>) -> LogHeader {
        let model = &self.model;
        let (state, noise) = (&view.belief.state, model.planning.noise);
        LogHeader {
            format: FORMAT.to_owned(),
            version: VERSION,
            length_unit: LengthUnit::Cm.as_str().to_owned(),
            features: state.features.len(),
            initial: InitialEstimate {
                pose: state.pose.to_vector().into(),
                features: state.features.iter().map(|p| p.coords.into()).collect(),
                pose_covariance: rows(&view.belief.covariance.pose()),
                feature_sigma: model.initial_feature_sigma,
            },
            noise: LogNoise {
                rotation_sigma: noise.rotation_sigma,
                translation_sigma: noise.translation_sigma,
                feature_motion_sigma: noise.feature_motion_sigma,
                feature_measurement_sigma: noise.feature_measurement_sigma,
                structure_measurement_sigma: noise.structure_measurement_sigma,
            },
            time: None,
            truth: Some(truth(view)),
            filter: Some(LogFilter {
                estimator: Some(model.estimator.name.to_string()),
                gate_probability: model.gate_probability.map(GateProbability::get),
            }),
            source: Some(self.source.clone()),
        }
    }
}

impl Observer for LogRecorder {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        match &view.input {
            None => self.file.add_json_line(&self.header(view)),
            Some(input) => self.file.add_json_line(&step(view, input)),
        }
    }
}

fn step(view: &StepView<'_>, input: &StepInput<'_>) -> LogStep {
    let numbers = |vectors: &[Vector3<f64>]| vectors.iter().map(|&v| v.into()).collect();
    let (pairs, sums) = match input.measurements.structure {
        StructureMeasurements::None => (Vec::new(), None),
        StructureMeasurements::AllPairsSummed(sums) => (Vec::new(), Some(numbers(sums))),
        StructureMeasurements::Pairs(pairs) => (pairs.iter().map(LogPair::from).collect(), None),
    };
    LogStep {
        step: view.step as u64,
        control: LogControl {
            rotation: input.control.rotation.into(),
            translation: input.control.translation.into(),
        },
        feature_motion: numbers(input.feature_motion),
        feature_measurements: input
            .measurements
            .features
            .iter()
            .map(|measured| LogFeature {
                id: measured.feature.0,
                z: measured.z.into(),
            })
            .collect(),
        structure_measurements: pairs,
        structure_sums: sums,
        time: None,
        truth: Some(truth(view)),
    }
}

fn truth(view: &StepView<'_>) -> LogTruth {
    LogTruth::of(&State {
        pose: *view.pose,
        features: view.features.to_vec(),
    })
}
