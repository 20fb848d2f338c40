//! Orientation as three Euler angles, as the paper's state keeps it.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use crate::wrap_angle;

/// Orientation Θ = (roll, pitch, yaw) in radians, with
/// R(Θ) = `Rz(yaw)` `Ry(pitch)` `Rx(roll)` from body to world.
///
/// Eq. (2) adds increments to the angles; it does not compose rotations. At pitch = ±π/2 roll and
/// yaw turn about the same axis and the three angles are no longer independent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EulerAngles {
    /// Rotation about the body's x axis, radians.
    pub roll: f64,
    /// Rotation about the y axis, radians.
    pub pitch: f64,
    /// Rotation about the world's z axis, radians.
    pub yaw: f64,
}

impl EulerAngles {
    /// Angles in radians, in the order of the state vector.
    #[must_use]
    pub const fn new(roll: f64, pitch: f64, yaw: f64) -> Self {
        Self { roll, pitch, yaw }
    }

    /// From the vector (roll, pitch, yaw), radians.
    #[must_use]
    pub fn from_vector(v: &Vector3<f64>) -> Self {
        Self::new(v.x, v.y, v.z)
    }

    /// As the vector (roll, pitch, yaw), radians.
    #[must_use]
    pub fn to_vector(self) -> Vector3<f64> {
        Vector3::new(self.roll, self.pitch, self.yaw)
    }

    /// The angles of a rotation from body to world, pitch in [−π/2, π/2].
    #[must_use]
    pub fn from_rotation(world_from_body: &Rotation3<f64>) -> Self {
        let (roll, pitch, yaw) = world_from_body.euler_angles();
        Self::new(roll, pitch, yaw)
    }

    /// The angles of a rotation from body to world that are nearest to `reference`, see
    /// [`Self::nearest_to`].
    #[must_use]
    pub fn nearest_of_rotation(world_from_body: &Rotation3<f64>, reference: Self) -> Self {
        Self::from_rotation(world_from_body).nearest_to(reference)
    }

    /// The same orientation in the angles that are nearest to `reference`: these, or the other triple that
    /// every orientation has, (roll + π, π − pitch, yaw + π), wrapped. These where both are as near.
    #[must_use]
    pub fn nearest_to(self, reference: Self) -> Self {
        let other = Self::new(self.roll + PI, PI - self.pitch, self.yaw + PI);
        let other = other.plus(&Vector3::zeros());
        let distance = |angles: Self| angles.minus(reference).norm_squared();
        if distance(other) < distance(self) {
            other
        } else {
            self
        }
    }

    /// The error of these angles against `reference`: the differences of the triple of this orientation
    /// that is nearest to it, wrapped to (−π, π], radians. The same orientation has none, whichever
    /// triple gives it.
    #[must_use]
    pub fn error(self, reference: Self) -> Vector3<f64> {
        self.nearest_to(reference).minus(reference)
    }

    /// The geodesic distance of two orientations on SO(3): the angle, 0 to π rad, of the one rotation that
    /// takes one into the other.
    #[must_use]
    pub fn angle_to(self, other: Self) -> f64 {
        self.quaternion().angle_to(&other.quaternion())
    }

    /// R(Θ), from body to world.
    #[must_use]
    pub fn rotation(self) -> Rotation3<f64> {
        Rotation3::from_euler_angles(self.roll, self.pitch, self.yaw)
    }

    /// R(Θ) as a unit quaternion, from body to world.
    #[must_use]
    pub fn quaternion(self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_euler_angles(self.roll, self.pitch, self.yaw)
    }

    /// ∂R/∂roll, ∂R/∂pitch and ∂R/∂yaw.
    #[must_use]
    pub fn rotation_derivatives(self) -> [Matrix3<f64>; 3] {
        let r = self.rotation().into_inner();
        let axes = self.rotation_axes();
        [0, 1, 2].map(|k| axes.column(k).into_owned().cross_matrix() * r)
    }

    /// W(Θ) = [w₁ w₂ w₃], the world axes about which roll, pitch and yaw turn the body:
    /// `∂R/∂Θ_k` = `[w_k]×` R.
    #[must_use]
    pub fn rotation_axes(self) -> Matrix3<f64> {
        let (sin_pitch, cos_pitch) = self.pitch.sin_cos();
        let (sin_yaw, cos_yaw) = self.yaw.sin_cos();
        Matrix3::new(
            cos_yaw * cos_pitch,
            -sin_yaw,
            0.0,
            sin_yaw * cos_pitch,
            cos_yaw,
            0.0,
            -sin_pitch,
            0.0,
            1.0,
        )
    }

    /// Θ + δ with every angle wrapped to (−π, π].
    #[must_use]
    pub fn plus(self, delta: &Vector3<f64>) -> Self {
        Self::from_vector(&(self.to_vector() + delta).map(wrap_angle))
    }

    /// Θ − `other`, every difference wrapped to (−π, π]: undoes [`Self::plus`]. It compares numbers, not
    /// orientations; for those see [`Self::error`].
    #[must_use]
    pub fn minus(self, other: Self) -> Vector3<f64> {
        (self.to_vector() - other.to_vector()).map(wrap_angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn elementary(angle: f64, axis: usize) -> Matrix3<f64> {
        let (s, c) = angle.sin_cos();
        match axis {
            0 => Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c),
            1 => Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c),
            _ => Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
        }
    }

    proptest! {
        #[test]
        fn rotation_is_yaw_times_pitch_times_roll(
            roll in -3.1..3.1, pitch in -3.1..3.1, yaw in -3.1..3.1
        ) {
            let expected = elementary(yaw, 2) * elementary(pitch, 1) * elementary(roll, 0);
            let angles = EulerAngles::new(roll, pitch, yaw);
            prop_assert!((angles.rotation().into_inner() - expected).amax() < 1e-14);
        }

        #[test]
        fn derivatives_match_finite_differences(
            roll in -3.1..3.1, pitch in -1.5..1.5, yaw in -3.1..3.1
        ) {
            let angles = EulerAngles::new(roll, pitch, yaw);
            let step = 1e-6;
            for (k, derivative) in angles.rotation_derivatives().iter().enumerate() {
                let mut delta = Vector3::zeros();
                delta[k] = step;
                let forward = angles.plus(&delta).rotation().into_inner();
                let backward = angles.plus(&-delta).rotation().into_inner();
                let numeric = (forward - backward) / (2.0 * step);
                prop_assert!((derivative - numeric).amax() < 1e-9);
            }
        }

        #[test]
        fn angles_survive_the_rotation(
            roll in -3.1..3.1, pitch in -1.5..1.5, yaw in -3.1..3.1
        ) {
            let angles = EulerAngles::new(roll, pitch, yaw);
            let back = EulerAngles::from_rotation(&angles.rotation());
            prop_assert!(back.minus(angles).norm() < 1e-12);
        }
    }

    proptest! {
        #[test]
        fn the_nearest_angles_are_those_one_came_from(
            roll in -3.1..3.1, pitch in -3.1..3.1, yaw in -3.1..3.1,
            offset in prop::array::uniform3(-0.3..0.3)
        ) {
            let angles = EulerAngles::new(roll, pitch, yaw);
            // Nearer to pitch ±π/2 the two triples meet.
            prop_assume!(pitch.cos().abs() > 0.5);
            let near = angles.plus(&Vector3::from(offset));
            let back = EulerAngles::nearest_of_rotation(&angles.rotation(), near);
            prop_assert!(back.minus(angles).norm() < 1e-12);
        }
    }

    #[test]
    fn of_triples_that_are_as_near_the_angles_stay() {
        use std::f64::consts::FRAC_PI_2;
        let reference = EulerAngles::new(FRAC_PI_2, FRAC_PI_2, FRAC_PI_2);
        for (roll, yaw) in [(0.0, 0.0), (PI, PI)] {
            let angles = EulerAngles::new(roll, FRAC_PI_2, yaw);
            assert_eq!(angles.nearest_to(reference), angles);
        }
    }

    proptest! {
        /// The trace of the relative rotation knows nothing of triples and quaternions.
        #[test]
        fn the_geodesic_angle_is_that_of_the_relative_rotation(
            a in prop::array::uniform3(-3.1..3.1), b in prop::array::uniform3(-3.1..3.1)
        ) {
            let [a, b] = [a, b].map(|angles| EulerAngles::from_vector(&Vector3::from(angles)));
            let relative = a.rotation().inverse() * b.rotation();
            let cosine = (relative.matrix().trace() - 1.0) / 2.0;
            prop_assert!((a.angle_to(b).cos() - cosine).abs() < 1e-12);
            prop_assert!((a.angle_to(b) - b.angle_to(a)).abs() < 1e-12);
            prop_assert!(a.angle_to(a) < 1e-12);
        }

        #[test]
        fn errors_do_not_depend_on_the_triple(
            angles in prop::array::uniform3(-3.1..3.1), other in prop::array::uniform3(-3.1..3.1)
        ) {
            let [a, b] = [angles, other].map(|angles| EulerAngles::from_vector(&Vector3::from(angles)));
            let twin = EulerAngles::new(a.roll + PI, PI - a.pitch, a.yaw + PI);
            prop_assert!((twin.rotation().matrix() - a.rotation().matrix()).amax() < 1e-12);
            prop_assert!(twin.error(a).norm() < 1e-12, "of one orientation");
            prop_assert!((a.error(b).norm() - twin.error(b).norm()).abs() < 1e-12);
            prop_assert!((a.error(b).norm() - b.error(twin).norm()).abs() < 1e-12);
            prop_assert!(a.error(b).norm() <= a.minus(b).norm());
        }

        #[test]
        fn small_errors_are_the_differences_to_the_last_bit(
            angles in prop::array::uniform3(-3.1..3.1), delta in prop::array::uniform3(-0.5..0.5)
        ) {
            let a = EulerAngles::from_vector(&Vector3::from(angles));
            let b = a.plus(&Vector3::from(delta));
            // The other triple of b has its pitch at least this far from a's.
            prop_assume!(a.pitch.cos().abs() > 0.5);
            prop_assert_eq!(b.error(a), b.minus(a));
        }
    }

    #[test]
    fn addition_wraps_and_does_not_compose() {
        let sum = EulerAngles::new(3.0, 0.2, 0.0).plus(&Vector3::new(0.5, 0.1, 0.0));
        assert_relative_eq!(sum.roll, 3.5 - std::f64::consts::TAU, epsilon = 1e-15);
        assert_relative_eq!(sum.pitch, 0.3, epsilon = 1e-15);
    }
}
