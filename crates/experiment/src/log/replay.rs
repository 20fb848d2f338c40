//! The filter over a log.

use std::io::BufRead;
use std::path::Path;

use adslam_estimator::{
    Belief, Estimator, EstimatorError, EstimatorKind, FeatureMeasurement, FilterNoise,
    Measurements, PairMeasurement, Parallelism, StructureMeasurements, UpdateReport,
};
use adslam_models::{Control, FeatureId};
use nalgebra::Vector3;

use super::format::{EstimateLine, LogStep};
use super::read::LogReader;
use crate::ExperimentError;
use crate::diagnostics::InputError;
use crate::output::AtomicFile;
use crate::run::{GateWatch, Interrupt, gate};
use crate::scenario::EstimatorName;
use crate::scenario::values::GateProbability;

/// A filter working through a log.
pub struct Replay<R> {
    log: LogReader<R>,
    name: String,
    noise: FilterNoise,
    estimator: Box<dyn Estimator>,
    belief: Belief,
    report: UpdateReport,
}

/// Which filter goes through a log.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilterChoice {
    /// The estimator.
    pub estimator: EstimatorName,
    /// The part of good feature measurements that pass its gate; absent where there is none.
    pub gate_probability: Option<GateProbability>,
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
    /// Feature measurements that the gate kept out.
    pub rejected: usize,
    /// What the user should know of it.
    pub warnings: Vec<String>,
    /// Why it ended before the end of the log, with [`TailPolicy::KeepComplete`].
    pub stopped_by: Option<InputError>,
}

impl<R: BufRead> Replay<R> {
    /// Reads the header and starts the filter from it. `path` is for messages.
    ///
    /// # Errors
    /// A header that cannot be used.
    pub fn new(reader: R, path: &Path, choice: FilterChoice) -> Result<Self, InputError> {
        let log = LogReader::new(reader, path)?;
        let about = |what: &str, error: EstimatorError| {
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
        let noise = log.header().noise.into();
        let estimator = EstimatorKind::from(choice.estimator)
            .build(noise, choice.gate_probability.map(gate), Parallelism::Rayon)
            .map_err(|error| about("noise", error))?;
        let belief = log
            .header()
            .initial
            .belief()
            .map_err(|error| about("first estimate", error))?;
        Ok(Self {
            log,
            name: path.display().to_string(),
            noise,
            estimator,
            belief,
            report: UpdateReport::default(),
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

    /// The noise that the filter assumes.
    #[must_use]
    pub fn noise(&self) -> &FilterNoise {
        &self.noise
    }

    /// The estimates after the step advanced to last, which was `step`.
    #[must_use]
    pub fn estimates(&self, step: u64) -> EstimateLine {
        EstimateLine::of(step, &self.belief, &self.report, self.estimator.rejected())
    }

    fn apply(&mut self, step: &LogStep) -> Result<(), EstimatorError> {
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
        self.estimator
            .predict(&mut self.belief, &control, &motion)?;
        let measurements = Measurements {
            features: &features,
            structure,
        };
        self.report = self.estimator.update(&mut self.belief, &measurements)?;
        Ok(())
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
    choice: FilterChoice,
    out: &mut AtomicFile,
    policy: TailPolicy,
    interrupt: &Interrupt,
    progress: &mut dyn FnMut(),
) -> Result<ReplaySummary, ExperimentError> {
    let mut replay = Replay::new(reader, path, choice)?;
    let features = replay.log.header().features;
    let mut summary = ReplaySummary {
        steps: 0,
        features,
        rejected: 0,
        warnings: Vec::new(),
        stopped_by: None,
    };
    let mut gate_watch = GateWatch::default();
    loop {
        if interrupt.requested() {
            return Err(ExperimentError::Interrupted);
        }
        let step = match replay.advance() {
            Ok(Some(step)) => step,
            Ok(None) => break,
            Err(ExperimentError::Input(error)) if policy == TailPolicy::KeepComplete => {
                summary.stopped_by = Some(error);
                break;
            }
            Err(error) => return Err(error),
        };
        out.add_json_line(&replay.estimates(step))?;
        summary.steps += 1;
        summary.rejected += replay.report.rejected;
        gate_watch.add(step, &replay.report);
        progress();
    }
    summary.warnings.extend(gate_watch.warning());
    Ok(summary)
}
