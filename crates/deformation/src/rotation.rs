//! Rotations that turn a translation or a deformation: r_t and r_d of eq. (2).

use std::fmt::Debug;

use nalgebra::{Rotation3, Unit, Vector3};

use crate::MotionError;

/// A rotation that may change with time.
pub trait Rotation: Debug + Send + Sync {
    /// r(τ) in SO(3), in the world frame, at `time` (in steps, 1 at the start).
    fn at(&self, time: f64) -> Rotation3<f64>;
}

/// A rotation about a fixed axis: r(τ) = exp(axis · (angle + rate · (τ − 1))).
///
/// The default is the identity at all times, as in the paper's runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisRotation {
    axis: Unit<Vector3<f64>>,
    angle_at_start_rad: f64,
    rate_rad_per_step: f64,
}

impl AxisRotation {
    /// A rotation about `axis` (world frame, any length but zero), by `angle_at_start_rad` at
    /// step 1 and `rate_rad_per_step` more with each step.
    ///
    /// # Errors
    /// When the axis is zero or not finite.
    pub fn new(
        axis: Vector3<f64>,
        angle_at_start_rad: f64,
        rate_rad_per_step: f64,
    ) -> Result<Self, MotionError> {
        // Scaled first: the square of a tiny or huge component would leave the range of f64.
        let largest = axis.amax();
        let finite = axis.iter().all(|component| component.is_finite());
        let axis = (finite && largest > 0.0)
            .then(|| Unit::new_normalize(axis / largest))
            .ok_or(MotionError::BadAxis(axis.x, axis.y, axis.z))?;
        Ok(Self {
            axis,
            angle_at_start_rad,
            rate_rad_per_step,
        })
    }
}

impl Default for AxisRotation {
    fn default() -> Self {
        Self {
            axis: Vector3::z_axis(),
            angle_at_start_rad: 0.0,
            rate_rad_per_step: 0.0,
        }
    }
}

impl Rotation for AxisRotation {
    fn at(&self, time: f64) -> Rotation3<f64> {
        let angle = self.angle_at_start_rad + self.rate_rad_per_step * (time - 1.0);
        Rotation3::from_axis_angle(&self.axis, angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn turns_about_its_axis() {
        let quarter_turns = AxisRotation::new(Vector3::new(0.0, 0.0, 5.0), 0.0, FRAC_PI_2).unwrap();
        let x = Vector3::x();
        assert_relative_eq!(quarter_turns.at(1.0) * x, x, epsilon = 1e-12);
        assert_relative_eq!(quarter_turns.at(2.0) * x, Vector3::y(), epsilon = 1e-12);
        assert_relative_eq!(quarter_turns.at(3.0) * x, -x, epsilon = 1e-12);
    }

    #[test]
    fn the_default_is_the_identity_exactly() {
        assert_eq!(AxisRotation::default().at(40.0), Rotation3::identity());
    }

    #[test]
    fn an_axis_needs_a_direction() {
        for axis in [
            Vector3::zeros(),
            Vector3::new(f64::NAN, 1.0, 0.0),
            Vector3::x() / 0.0,
        ] {
            assert!(matches!(
                AxisRotation::new(axis, 1.0, 0.0),
                Err(MotionError::BadAxis(..))
            ));
        }
        assert!(AxisRotation::new(Vector3::x() * 1e-300, 1.0, 0.0).is_ok());
    }
}
