//! The filter over a log.

use std::io::BufRead;
use std::path::Path;

use adslam_estimator::{
    Belief, Ekf, FeatureMeasurement, Measurements, PairMeasurement, Parallelism,
    StructureMeasurements,
};
use adslam_models::{Control, FeatureId};
use nalgebra::Vector3;

use super::format::{EstimateLine, LogStep};
use super::read::LogReader;
use crate::ExperimentError;
use crate::diagnostics::InputError;
use crate::output::AtomicFile;
use crate::run::Interrupt;

/// A filter working through a log.
#[derive(Debug)]
pub struct Replay<R> {
    log: LogReader<R>,
    name: String,
    ekf: Ekf,
    belief: Belief,
}

/// What to do with a line that cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TailPolicy {
    /// Refuse the whole log.
    Refuse,
    /// Keep the estimates up to the line before.
    KeepComplete,
}

/// How far a replay came.
#[derive(Debug)]
pub struct ReplaySummary {
    /// Estimates written.
    pub steps: usize,
    /// M.
    pub features: usize,
    /// Why it ended before the end of the log, with [`TailPolicy::KeepComplete`].
    pub stopped_by: Option<InputError>,
}

impl<R: BufRead> Replay<R> {
    /// Reads the header and starts the filter from it. `path` is for messages.
    ///
    /// # Errors
    /// A header that cannot be used.
    pub fn new(reader: R, path: &Path) -> Result<Self, InputError> {
        let log = LogReader::new(reader, path)?;
        let about = |what: &str, error: adslam_estimator::EstimatorError| {
            let message = format!(
                "{}: line 1: the {what} cannot be used: {error}",
                path.display()
            );
            InputError::about_file(path, message).with_help(
                "give finite numbers, and sigmas and variances that are not negative; docs/log.md \
                 says which sigmas may be 0",
            )
        };
        // One log is one run, so the threads are free for its steps.
        let ekf = Ekf::new(log.header().noise.into())
            .map_err(|error| about("noise", error))?
            .with_parallelism(Parallelism::Rayon);
        let belief = log
            .header()
            .initial
            .belief()
            .map_err(|error| about("first estimate", error))?;
        Ok(Self {
            log,
            name: path.display().to_string(),
            ekf,
            belief,
        })
    }

    /// Filters the next step; nothing at the end of the log.
    ///
    /// # Errors
    /// A line that cannot be used, or a covariance that breaks down.
    pub fn advance(&mut self) -> Result<Option<u64>, ExperimentError> {
        let Some(step) = self.log.next_step()? else {
            return Ok(None);
        };
        self.apply(&step).map_err(|cause| ExperimentError::Filter {
            run: format!("{}, line {}", self.name, self.log.line()),
            step: usize::try_from(step.step).unwrap_or(usize::MAX),
            cause,
        })?;
        Ok(Some(step.step))
    }

    /// What the filter believes after the step advanced to last.
    #[must_use]
    pub fn belief(&self) -> &Belief {
        &self.belief
    }

    /// The filter.
    #[must_use]
    pub fn ekf(&self) -> &Ekf {
        &self.ekf
    }

    fn apply(&mut self, step: &LogStep) -> Result<(), adslam_estimator::EstimatorError> {
        let control = Control {
            rotation: Vector3::from(step.control.rotation),
            translation: Vector3::from(step.control.translation),
        };
        let motion: Vec<Vector3<f64>> = step
            .feature_motion
            .iter()
            .copied()
            .map(Vector3::from)
            .collect();
        let features: Vec<FeatureMeasurement> = step
            .feature_measurements
            .iter()
            .map(|m| FeatureMeasurement {
                feature: FeatureId(m.id),
                z: Vector3::from(m.z),
            })
            .collect();
        let pairs: Vec<PairMeasurement> = step
            .structure_measurements
            .iter()
            .map(|m| PairMeasurement {
                from: FeatureId(m.from),
                to: FeatureId(m.to),
                z: Vector3::from(m.z),
            })
            .collect();
        let structure = StructureMeasurements::Pairs(&pairs);
        self.ekf.predict(&mut self.belief, &control, &motion)?;
        self.ekf.update(
            &mut self.belief,
            &Measurements {
                features: &features,
                structure,
            },
        )
    }
}

/// Filters the log in `reader` and writes a line of estimates for each step to `out`. `path` is for
/// messages; `progress` is called after each step.
///
/// # Errors
/// Bad lines (unless kept out by `policy`), a covariance that breaks down, a failing writer, or an
/// interruption.
pub fn filter_log(
    reader: impl BufRead,
    path: &Path,
    out: &mut AtomicFile,
    policy: TailPolicy,
    interrupt: &Interrupt,
    progress: &mut dyn FnMut(),
) -> Result<ReplaySummary, ExperimentError> {
    let mut replay = Replay::new(reader, path)?;
    let features = replay.log.header().features;
    let mut summary = ReplaySummary {
        steps: 0,
        features,
        stopped_by: None,
    };
    loop {
        if interrupt.requested() {
            return Err(ExperimentError::Interrupted);
        }
        let step = match replay.advance() {
            Ok(Some(step)) => step,
            Ok(None) => return Ok(summary),
            Err(ExperimentError::Input(error)) if policy == TailPolicy::KeepComplete => {
                summary.stopped_by = Some(error);
                return Ok(summary);
            }
            Err(error) => return Err(error),
        };
        out.add_json_line(&EstimateLine::of(step, replay.belief()))?;
        summary.steps += 1;
        progress();
    }
}
