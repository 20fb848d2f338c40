//! Squared errors and innovations over many runs, and what they say.

use std::fmt;

use adslam_statistics::{Interval, chi_squared};
use serde::Serialize;

use super::ConsistencyRecord;

/// The probability with which a consistent filter stays within the intervals.
pub const CHI_SQUARED_CONFIDENCE: f64 = 0.99;

/// What is measured of a filter. Each is χ² distributed if the filter is consistent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Squared error of the pose, 6 degrees of freedom.
    PoseNees,
    /// Squared error of a feature, 3 degrees of freedom, mean over the features. The features share their
    /// drift, so their mean is taken to vary like one of them.
    FeatureNees,
    /// Squared error of the whole state.
    JointNees,
    /// Squared innovation of the feature measurements of a step.
    FeatureNis,
    /// Squared innovation of the structure measurements of a step, given those.
    StructureNis,
}

impl Measure {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::PoseNees,
        Self::FeatureNees,
        Self::JointNees,
        Self::FeatureNis,
        Self::StructureNis,
    ];

    /// What its name is in tables.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::PoseNees => "Pose NEES",
            Self::FeatureNees => "Feature NEES",
            Self::JointNees => "Joint NEES",
            Self::FeatureNis => "Feature NIS",
            Self::StructureNis => "Structure NIS",
        }
    }
}

/// What a measure says of a filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Its errors are as large as it says.
    Consistent,
    /// Its errors are larger than it says.
    OverConfident,
    /// Its errors are smaller than it says.
    Cautious,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Consistent => "consistent",
            Self::OverConfident => "over-confident",
            Self::Cautious => "cautious",
        })
    }
}

/// The mean over the runs at one step, over its degrees of freedom: 1 if all is well.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StepMean {
    /// n, from 1.
    pub step: usize,
    /// The mean.
    pub mean: f64,
    /// Where it lies with the probability [`CHI_SQUARED_CONFIDENCE`].
    pub interval: Interval,
}

/// A measure over the steps of many runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judgement {
    /// Which.
    pub measure: Measure,
    /// Mean over the steps of the mean over the runs, over the degrees of freedom.
    pub mean: f64,
    /// Where the mean over the runs lies at one step with the probability [`CHI_SQUARED_CONFIDENCE`], over the degrees of
    /// freedom; the mean over the steps where these change from step to step.
    pub interval: Interval,
    /// The part of the steps at which the mean over the runs is within that step's interval.
    pub steps_inside: f64,
    /// Where the mean lies in the interval. Errors of one run go with each other from step to step, so
    /// that the mean over the steps is taken to vary like a single step at most.
    pub verdict: Verdict,
    /// Every step that has a value in some run.
    pub steps: Vec<StepMean>,
}

impl Judgement {
    /// Of the runs of one estimator and planner; `None` if the measure was never taken.
    #[must_use]
    pub fn of(measure: Measure, runs: &[&ConsistencyRecord]) -> Option<Self> {
        let last = runs.iter().map(|run| run.steps()).max()?;
        let steps: Vec<StepMean> = (0..last)
            .filter_map(|index| step_mean(measure, runs, index))
            .collect();
        let over_steps =
            |value: fn(&StepMean) -> f64| steps.iter().map(value).sum::<f64>() / steps.len() as f64;
        if steps.is_empty() {
            return None;
        }
        let mean = over_steps(|step| step.mean);
        let interval = Interval {
            low: over_steps(|step| step.interval.low),
            high: over_steps(|step| step.interval.high),
        };
        Some(Self {
            measure,
            mean,
            interval,
            steps_inside: over_steps(|step| f64::from(u8::from(step.interval.contains(step.mean)))),
            verdict: if mean < interval.low {
                Verdict::Cautious
            } else if mean > interval.high {
                Verdict::OverConfident
            } else {
                Verdict::Consistent
            },
            steps,
        })
    }
}

/// Σ values / Σ degrees of freedom over the runs that have one at this step.
fn step_mean(measure: Measure, runs: &[&ConsistencyRecord], index: usize) -> Option<StepMean> {
    let values = runs.iter().filter_map(|run| run.value(measure, index));
    let (value, dof) = values.fold((0.0, 0), |sum, value| (sum.0 + value.0, sum.1 + value.1));
    if dof == 0 {
        return None;
    }
    Some(StepMean {
        step: index + 1,
        mean: value / dof as f64,
        interval: chi_squared::interval_per_dof(CHI_SQUARED_CONFIDENCE, dof),
    })
}
