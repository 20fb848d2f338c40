//! `[sensor]` and `[robot]`: what the robot sees, where it starts, how it can move.

use serde::Deserialize;

use super::values::{Finite, List, NonNegative, Positive, Vec3};

/// `[sensor]`
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// Features farther away are not seen (cm).
    pub range_cm: Positive,
    /// Features nearer than this are not seen (cm); default 0.1.
    #[serde(default = "min_range")]
    pub min_range_cm: NonNegative,
}

/// `[robot]`
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Robot {
    /// Roll, pitch and yaw at step 1; default zero.
    #[serde(default)]
    pub start_deg: Vec3,
    /// Position at step 1 (world frame, cm); default the origin.
    #[serde(default)]
    pub start_cm: Vec3,
    /// Planners keep the robot farther than this from the surface (cm).
    pub clearance_cm: NonNegative,
    /// What the planners choose from.
    pub actions: Actions,
}

/// `[robot.actions]`: the candidates Ω = (roll, pitch, yaw), v = R(Ω) (dx, 0, dz) of section
/// III-D, in all combinations.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Actions {
    /// Changes of roll.
    pub roll_deg: List<Finite>,
    /// Changes of pitch.
    pub pitch_deg: List<Finite>,
    /// Changes of yaw.
    pub yaw_deg: List<Finite>,
    /// Steps along x of the turned body (cm).
    pub dx_cm: List<Finite>,
    /// Steps along z of the turned body (cm).
    pub dz_cm: List<Finite>,
    /// An action that would take |roll| beyond this is left out.
    pub max_roll_deg: NonNegative,
    /// An action that would take |pitch| beyond this is left out.
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
