//! `[sensor]` and `[robot]`: what the robot sees, where it starts, how it can move.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Finite, List, NonNegative, Positive, Vec3};

/// What the robot sees: features in the half-space in front of it (positive x of its body), within the range, that the
/// object does not hide.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// Features farther away than this are not seen (cm).
    pub range_cm: Positive,
    /// Features nearer than this are not seen; below the range (cm).
    #[serde(default = "min_range")]
    pub min_range_cm: NonNegative,
}

/// The robot, its start and its actions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Robot {
    /// Orientation at step 1: roll, pitch and yaw (degrees).
    #[serde(default)]
    pub start_deg: Vec3,
    /// Position at step 1, which has to be outside the object (world frame, cm).
    #[serde(default)]
    pub start_cm: Vec3,
    /// Planners keep farther than this from the surface (cm). Where no action does, they take one whose way does not
    /// cross it and that ends farthest from it; staying counts as one always.
    pub clearance_cm: NonNegative,
    /// What the planners choose from: all combinations of five lists.
    pub actions: Actions,
}

/// What the planners choose from: all combinations of the five lists, at most 100 000. An action
/// turns by Ω = (roll, pitch, yaw) and moves by v = R(Ω) (dx, 0, dz), section III-D.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Actions {
    /// Changes of roll (degrees).
    pub roll_deg: List<Finite>,
    /// Changes of pitch (degrees).
    pub pitch_deg: List<Finite>,
    /// Changes of yaw (degrees).
    pub yaw_deg: List<Finite>,
    /// Ways along x of the turned body (cm).
    pub dx_cm: List<Finite>,
    /// Ways along z of the turned body (cm).
    pub dz_cm: List<Finite>,
    /// An action that would take the roll beyond this, either way, is left out, unless all would go beyond a limit
    /// (degrees).
    pub max_roll_deg: NonNegative,
    /// An action that would take the pitch beyond this, either way, is left out, unless all would go beyond a limit
    /// (degrees).
    pub max_pitch_deg: NonNegative,
}

impl Actions {
    /// N_u: how many actions there are.
    pub fn count(&self) -> usize {
        [
            &self.roll_deg,
            &self.pitch_deg,
            &self.yaw_deg,
            &self.dx_cm,
            &self.dz_cm,
        ]
        .into_iter()
        .fold(1, |product, list| product.saturating_mul(list.len()))
    }
}

fn min_range() -> NonNegative {
    NonNegative::default_of(0.1)
}
