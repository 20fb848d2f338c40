//! `[planners]`: the parameters that each planner has in this world, and the planners' names.

use std::collections::BTreeMap;

use adslam_names::PlannerName;
use adslam_planning::Nearest;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::values::{Fraction, Many, NonNegative, Positive, Vec3};

/// Parameters of every planner, so that all can be compared in this world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Planners {
    /// The predetermined path: the same control at every step.
    pub predetermined: Predetermined,
    /// The local planner, section III-B. Default: as the filter.
    #[serde(default)]
    pub local: Local,
    /// The global planner, section III-C, and the path of the combined one.
    pub global: Global,
    /// The combined planner, section III-D.
    pub combined: Combined,
    /// The keys of planners that a program has of its own, all with the values that hold.
    #[serde(flatten, skip_deserializing)]
    #[schemars(skip)]
    pub own: BTreeMap<PlannerName, Value>,
}

/// The predetermined path: the same control at every step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Predetermined {
    /// Ω: the change of roll, pitch and yaw (degrees).
    pub rotation_deg: Vec3,
    /// v: the translation, in the frame of the body before it turns (cm).
    pub translation_cm: Vec3,
}

/// The local planner: the action after which the trace of the covariance is smallest.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Local {
    /// The feature measurement's sigma, assumed in planning only (cm). Default: the filter's.
    pub feature_measurement_sigma_cm: Option<Positive>,
    /// Time for a decision (ms). When it is up the best action scored so far is taken; the run then
    /// depends on the machine, and `scored_actions` in steps.csv says how many were scored. Default:
    /// none.
    pub deadline_ms: Option<Positive>,
}

/// How the path through viewpoints is found and followed, by the global planner and the combined
/// one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Global {
    /// K of Algorithm 2: sets of viewpoints drawn, the best of which is kept. Without meaning if the
    /// viewpoints are fixed.
    #[serde(default = "samples")]
    pub samples: Many,
    /// Added to the cost of a path, eq. (8), for each leg that crosses the object (cm).
    #[serde(default = "crossing_penalty")]
    pub crossing_penalty_cm: NonNegative,
    /// A viewpoint is reached when the estimated position is this near to it (cm).
    pub reached_within_cm: Positive,
    /// A viewpoint is given up for the next one after this many decisions in a row in which the robot has come no
    /// nearer to it than it was before, by a hundredth of `reached_within_cm`.
    #[serde(default = "give_up_after_steps")]
    pub give_up_after_steps: Many,
}

/// The combined planner: as the local one, among the safe actions that lead nearest to the next
/// viewpoint. Exactly one of `nearest_fraction` and `nearest_count` has to be given.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [
    { "required": ["nearest_fraction"] },
    { "required": ["nearest_count"] },
]))]
pub struct Combined {
    /// n_u, how many actions are compared, as a part of the safe ones; at least one is. Default:
    /// none.
    pub nearest_fraction: Option<Fraction>,
    /// n_u, how many actions are compared, as a number. Default: none.
    pub nearest_count: Option<Many>,
    /// The feature measurement's sigma, assumed in planning only (cm). Default: the filter's.
    pub feature_measurement_sigma_cm: Option<Positive>,
    /// Time for a decision (ms). When it is up the best action scored so far is taken; the run then
    /// depends on the machine, and `scored_actions` in steps.csv says how many were scored. Default:
    /// none.
    pub deadline_ms: Option<Positive>,
}

impl Combined {
    /// n_u. Where, against the rule, both are set the count holds, where none is, all are compared.
    pub fn nearest(&self) -> Nearest {
        match (self.nearest_count, self.nearest_fraction) {
            (Some(count), _) => Nearest::Count(count.get()),
            (None, Some(fraction)) => Nearest::Fraction(*fraction),
            (None, None) => Nearest::Fraction(1.0),
        }
    }
}

fn samples() -> Many {
    Many::default_of(50)
}

fn give_up_after_steps() -> Many {
    Many::default_of(20)
}

fn crossing_penalty() -> NonNegative {
    NonNegative::default_of(1.0)
}
