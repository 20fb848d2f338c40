//! A run written down as a log.

use std::path::Path;

use adslam_estimator::StructureMeasurements;
use adslam_models::State;
use nalgebra::Vector3;

use super::format::{
    FORMAT, InitialEstimate, LogControl, LogFeature, LogFilter, LogHeader, LogNoise, LogPair,
    LogStep, LogTruth, VERSION, rows,
};
use crate::ExperimentError;
use crate::output::AtomicFile;
use crate::run::{FilterInput, Observer, Setup, StepView};
use crate::scenario::{EstimatorName, LengthUnit, Named, PlannerName};

/// The name of the log in a run's folder.
pub const LOG_FILE: &str = "log.jsonl";

/// Writes a run as a log with its truth, from which a [`Replay`](super::Replay) makes the run's estimates again,
/// to the last bit.
#[derive(Debug)]
pub struct LogRecorder<'a> {
    file: AtomicFile,
    setup: &'a Setup,
    source: String,
}

impl<'a> LogRecorder<'a> {
    /// Begins to write the run of `planner` with `seed` into `folder`, which must exist.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn create(
        folder: &Path,
        setup: &'a Setup,
        planner: PlannerName,
        seed: u64,
    ) -> Result<Self, ExperimentError> {
        Ok(Self {
            file: AtomicFile::create(&folder.join(LOG_FILE))?,
            setup,
            source: format!(
                "adslam {}: {}, {planner} planner, seed {seed}",
                env!("CARGO_PKG_VERSION"),
                setup.name
            ),
        })
    }

    /// Ends the log; its file still has to be committed.
    #[must_use]
    pub fn finish(self) -> AtomicFile {
        self.file
    }

    fn header(&self, view: &StepView<'_>) -> LogHeader {
        let setup = self.setup;
        let filter = &setup.scenario.filter;
        let (state, noise) = (&view.belief.state, setup.planning.noise);
        LogHeader {
            format: FORMAT.to_owned(),
            version: VERSION,
            length_unit: LengthUnit::Cm.as_str().to_owned(),
            features: state.features.len(),
            initial: InitialEstimate {
                pose: state.pose.to_vector().into(),
                features: state.features.iter().map(|p| p.coords.into()).collect(),
                pose_covariance: rows(&view.belief.covariance.pose()),
                feature_sigma: setup.initial_feature_sigma,
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
                estimator: Some(EstimatorName::as_str(filter.estimator).to_owned()),
                gate_probability: filter.gate_probability.map(|probability| *probability),
            }),
            source: Some(self.source.clone()),
        }
    }
}

impl Observer for LogRecorder<'_> {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), ExperimentError> {
        match &view.input {
            None => self.file.add_json_line(&self.header(view)),
            Some(input) => self.file.add_json_line(&step(view, input)),
        }
    }
}

fn step(view: &StepView<'_>, input: &FilterInput<'_>) -> LogStep {
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
