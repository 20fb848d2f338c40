//! `[mismatch]`: where the truth departs from what filter and planners are told.

use std::f64::consts::PI;
use std::sync::Arc;

use adslam_deformation::{AxisRotation, Clock, MotionError, ObjectMotion, ScaledDeformation, Turn};
use adslam_diagnostics::InputError;
use adslam_documents::Document;
use nalgebra::{Point3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Noise;
use super::checks::check_axis;
use super::values::{ClockFactor, Finite, NonNegative, Positive, Probability, Vec3};

/// Where the truth departs from what filter and planners are told. Only the simulated world reads
/// this; what they believe stays that of `known_motion` or `motion`, of `noise` and of `filter`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mismatch {
    /// The true displacement D is this many times that of `motion`.
    pub deformation_factor: NonNegative,
    /// The true motion runs this many times as fast as `motion`: a period is shorter by that.
    pub time_factor: ClockFactor,
    /// The true motion lags behind `motion` by this; below 0 it is ahead (steps, not always whole).
    pub delay_steps: Finite,
    /// Turns the true object, deformed as it is, as one rigid body about the centroid of its
    /// features' rest positions, which its translation takes along. Default: no turn.
    pub rotation: Option<UnmodelledRotation>,
    /// The true noise of the robot's motion is this many times that of `noise`.
    pub robot_noise_factor: NonNegative,
    /// The true noise of the features' motion, σ_t and σ_d, is this many times that of `noise`.
    pub feature_noise_factor: NonNegative,
    /// The true noise of measured features is this many times that of `noise`.
    pub measurement_noise_factor: NonNegative,
    /// The true noise of measured differences between features is this many times that of `noise`.
    pub structure_noise_factor: NonNegative,
    /// How likely a measured feature has a gross error, each for itself at each step.
    pub outlier_probability: Probability,
    /// Of each coordinate of a gross error, a Gaussian that comes on top of the noise and is not cut
    /// off; needed where `outlier_probability` is above 0 (cm). Default: none.
    pub outlier_sigma_cm: Option<Positive>,
    /// How likely a feature in sight is not measured, each for itself at each step; it does not count
    /// as seen then.
    pub missed_detection_probability: Probability,
    /// How likely no structure measurement arrives at a step.
    pub dropped_structure_probability: Probability,
}

/// A rotation that filter and planners know nothing of: exp(axis · rate · (n − 1)) at step n.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnmodelledRotation {
    /// The axis, a vector other than zero whose length is of no matter (world frame).
    pub axis: Vec3,
    /// The turn of each step (degrees).
    pub rate_deg_per_step: Finite,
}

impl Default for Mismatch {
    fn default() -> Self {
        let one = NonNegative::default_of(1.0);
        let never = Probability::default_of(0.0);
        Self {
            deformation_factor: one,
            time_factor: ClockFactor::default_of(1.0),
            delay_steps: Finite::default_of(0.0),
            rotation: None,
            robot_noise_factor: one,
            feature_noise_factor: one,
            measurement_noise_factor: one,
            structure_noise_factor: one,
            outlier_probability: never,
            outlier_sigma_cm: None,
            missed_detection_probability: never,
            dropped_structure_probability: never,
        }
    }
}

impl Mismatch {
    /// What no single value shows.
    pub(super) fn check(&self, noise: &Noise, document: &Document) -> Result<(), InputError> {
        if let Some(rotation) = &self.rotation {
            check_axis(rotation.axis, "mismatch.rotation.axis", document)?;
        }
        if *self.outlier_probability > 0.0 && self.outlier_sigma_cm.is_none() {
            let message = "there are outliers, and no `outlier_sigma_cm` says how gross they are";
            return Err(document
                .error_at("mismatch.outlier_probability", message)
                .with_help(
                    "add `outlier_sigma_cm`, such as 1.0: many times the noise of a measurement",
                ));
        }
        let sigma = *noise.rotation_sigma_rad * *self.robot_noise_factor;
        if sigma > PI {
            let message = format!("the robot would truly turn with a sigma of {sigma} rad");
            return Err(document
                .error_at("mismatch.robot_noise_factor", message)
                .with_help("write a smaller factor: a sigma is half a turn at most, 3.14 rad"));
        }
        Ok(())
    }

    /// The true motion of an object whose features rest at `rest` (world frame, cm) and of which
    /// `motion` is believed.
    ///
    /// # Errors
    /// When a parameter was set to what no file may hold.
    pub(super) fn departed(
        &self,
        mut motion: ObjectMotion,
        rest: &[Point3<f64>],
    ) -> Result<ObjectMotion, MotionError> {
        motion.clock = Clock::new(*self.time_factor, *self.delay_steps)?;
        if *self.deformation_factor != 1.0 {
            let scaled = ScaledDeformation::new(motion.deformation, *self.deformation_factor);
            motion.deformation = Arc::new(scaled);
        }
        if let Some(rotation) = &self.rotation {
            let rate = rotation.rate_deg_per_step.degrees_in_rad();
            motion.turn = Some(Turn {
                centre: centroid(rest),
                rotation: AxisRotation::new(*rotation.axis, 0.0, rate)?,
            });
        }
        Ok(motion)
    }
}

fn centroid(points: &[Point3<f64>]) -> Point3<f64> {
    let sum: Vector3<f64> = points.iter().map(|p| p.coords).sum();
    Point3::from(sum / points.len().max(1) as f64)
}
