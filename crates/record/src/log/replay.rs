//! The filter over a log.

use std::io::BufRead;
use std::path::Path;

use adslam_agent::{Agent, Estimators, GateProbability, StepInput};
use adslam_diagnostics::{Failure, InputError, Interrupt};
use adslam_estimator::{
    Belief, EstimatorError, FeatureMeasurement, FilterNoise, Measurements, PairMeasurement,
    Parallelism, StructureMeasurements,
};
use adslam_models::{Control, FeatureId};
use adslam_names::EstimatorName;
use adslam_simulation::{StepMetrics, measure_step};
use nalgebra::Vector3;

use super::estimates::{EstimateErrors, EstimateLine};
use super::format::{LogFilter, LogStep, LogTruth};
use super::read::LogReader;
use super::summary::{ReplaySummary, SummingUp};

/// A filter working through a log.
pub struct Replay<R> {
    log: LogReader<R>,
    name: String,
    noise: FilterNoise,
    filter: (EstimatorName, Option<GateProbability>),
    agent: Agent,
    time: Option<f64>,
    metrics: Option<StepMetrics>,
}

/// Which filter goes through a log.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilterChoice {
    /// The estimator; absent for that of the log, or else the paper's.
    pub estimator: Option<EstimatorName>,
    /// What it does with feature measurements that are far from what it expects.
    pub gate: GateChoice,
}

/// Which feature measurements a filter believes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum GateChoice {
    /// What the log says, or else all.
    #[default]
    AsRecorded,
    /// All.
    All,
    /// This part of good ones.
    Probability(GateProbability),
}

impl FilterChoice {
    /// Its gate, with nothing left to the log.
    fn gate(self, recorded: Option<&LogFilter>) -> Option<GateProbability> {
        match self.gate {
            GateChoice::AsRecorded => GateProbability::new(recorded?.gate_probability?),
            GateChoice::All => None,
            GateChoice::Probability(probability) => Some(probability),
        }
    }
}

/// What to do with a line that cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TailPolicy {
    /// Refuse the whole log.
    Refuse,
    /// Keep the estimates up to the line before.
    KeepComplete,
}

impl<R: BufRead> Replay<R> {
    /// Reads the header and starts one of the `estimators` from it. `path` is for messages.
    ///
    /// # Errors
    /// A header that cannot be used, or an estimator that is not among them.
    pub fn new(
        reader: R,
        path: &Path,
        choice: FilterChoice,
        estimators: &Estimators,
    ) -> Result<Self, InputError> {
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
        let recorded = log.header().filter.as_ref();
        let probability = choice.gate(recorded);
        let named = recorded.and_then(|filter| filter.estimator.as_deref());
        let entry = match (&choice.estimator, named) {
            (Some(chosen), _) => estimators.get(chosen.as_str()),
            (None, Some(named)) => estimators.get(named),
            (None, None) => estimators.get(EstimatorName::default().as_str()),
        };
        let entry = entry.map_err(|reason| {
            let what = format!("has a filter that there is not: {reason}");
            log.error(&what, "or leave filter out, and say it with --estimator")
        })?;
        let name = entry.name;
        let estimator = entry
            .build(noise, probability, Parallelism::Rayon)
            .map_err(|error| about("noise", error))?;
        let belief = log
            .header()
            .initial
            .belief()
            .map_err(|error| about("first estimate", error))?;
        let mut replay = Self {
            time: log.header().time,
            log,
            name: path.display().to_string(),
            noise,
            filter: (name, probability),
            agent: Agent::new(estimator, belief),
            metrics: None,
        };
        let truth = replay.log.header().truth.clone();
        replay.compare(truth.as_ref())?;
        Ok(replay)
    }

    /// Filters the next step; `None` at the end of the log.
    ///
    /// # Errors
    /// A line that cannot be used, or a covariance that breaks down.
    pub fn advance(&mut self) -> Result<Option<u64>, Failure> {
        let Some(step) = self.log.next_step()? else {
            return Ok(None);
        };
        self.apply(&step).map_err(|cause| Failure::Filter {
            run: format!("{}, line {}", self.name, self.log.line()),
            step: usize::try_from(step.step).unwrap_or(usize::MAX),
            cause: cause.into(),
        })?;
        self.time = step.time;
        self.compare(step.truth.as_ref())?;
        Ok(Some(step.step))
    }

    /// Measures how far the belief is from the truth, where that is known.
    fn compare(&mut self, truth: Option<&LogTruth>) -> Result<(), InputError> {
        self.metrics = None;
        if let Some(truth) = truth.map(LogTruth::state) {
            let belief = self.agent.belief();
            let error = self.agent.estimator().error(&belief.state, &truth);
            let metrics = measure_step(belief, &truth, &error);
            self.metrics = metrics.filter(|found| EstimateErrors::from(found).are_finite());
            if self.metrics.is_none() {
                let what = "has a truth from which the error is not finite";
                let help = "is it in the log's unit of length?";
                return Err(self.log.error(what, help));
            }
        }
        Ok(())
    }

    /// What the filter believes after the step advanced to last.
    #[must_use]
    pub fn belief(&self) -> &Belief {
        self.agent.belief()
    }

    /// The noise that the filter assumes.
    #[must_use]
    pub fn noise(&self) -> &FilterNoise {
        &self.noise
    }

    /// The estimates after the step advanced to last, which was `step`.
    #[must_use]
    pub fn estimates(&self, step: u64) -> EstimateLine {
        let agent = &self.agent;
        EstimateLine {
            time: self.time,
            errors: self.metrics.as_ref().map(EstimateErrors::from),
            ..EstimateLine::of(step, agent.belief(), agent.report(), agent.rejected())
        }
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
        let sums: Option<Vec<Vector3<f64>>> = step
            .structure_sums
            .as_ref()
            .map(|sums| sums.iter().copied().map(Vector3::from).collect());
        let structure = match &sums {
            Some(sums) => StructureMeasurements::AllPairsSummed(sums),
            None => StructureMeasurements::Pairs(&pairs),
        };
        self.agent.step(&StepInput {
            control: &control,
            feature_motion: &motion,
            measurements: Measurements {
                features: &features,
                structure,
            },
        })?;
        Ok(())
    }
}

/// Filters the log in `reader` with one of the `estimators` and hands on a line of estimates for each step, as it comes. `path` is for
/// messages.
///
/// # Errors
/// Bad lines (unless kept out by `policy`), a covariance that breaks down, an interruption, or whatever
/// `each` cannot go on with.
pub fn filter_log(
    reader: impl BufRead,
    path: &Path,
    choice: FilterChoice,
    estimators: &Estimators,
    policy: TailPolicy,
    interrupt: &Interrupt,
    each: &mut dyn FnMut(&EstimateLine) -> Result<(), Failure>,
) -> Result<ReplaySummary, Failure> {
    let mut replay = Replay::new(reader, path, choice, estimators)?;
    let mut sums = SummingUp::new(replay.log.header(), replay.filter);
    sums.add_metrics(replay.metrics.as_ref());
    loop {
        if interrupt.requested() {
            return Err(Failure::Interrupted);
        }
        let step = match replay.advance() {
            Ok(Some(step)) => step,
            Ok(None) => return Ok(sums.finish(None)),
            Err(Failure::Input(error)) if policy == TailPolicy::KeepComplete => {
                return Ok(sums.finish(Some(error)));
            }
            Err(error) => return Err(error),
        };
        each(&replay.estimates(step))?;
        sums.add_update(step, replay.agent.report());
        sums.add_metrics(replay.metrics.as_ref());
    }
}
