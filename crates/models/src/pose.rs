//! The robot's pose.

use nalgebra::{Point3, Vector3, Vector6};

use crate::EulerAngles;

/// Orientation Θ and position x of the robot in the world: the first six entries of the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Orientation, body to world.
    pub orientation: EulerAngles,
    /// Position in the world, cm.
    pub position: Point3<f64>,
}

impl Default for Pose {
    fn default() -> Self {
        Self {
            orientation: EulerAngles::default(),
            position: Point3::origin(),
        }
    }
}

impl Pose {
    /// A pose from its orientation and its position in the world, cm.
    #[must_use]
    pub const fn new(orientation: EulerAngles, position: Point3<f64>) -> Self {
        Self {
            orientation,
            position,
        }
    }

    /// From (roll, pitch, yaw, x, y, z), radians and cm.
    #[must_use]
    pub fn from_vector(v: &Vector6<f64>) -> Self {
        Self::new(
            EulerAngles::new(v[0], v[1], v[2]),
            Point3::new(v[3], v[4], v[5]),
        )
    }

    /// As (roll, pitch, yaw, x, y, z), radians and cm.
    #[must_use]
    pub fn to_vector(&self) -> Vector6<f64> {
        let (angles, p) = (self.orientation, self.position);
        Vector6::new(angles.roll, angles.pitch, angles.yaw, p.x, p.y, p.z)
    }

    /// The world point `p_in_world` as the robot sees it: Rᵀ(p − x), cm.
    #[must_use]
    pub fn body_from_world(&self, p_in_world: &Point3<f64>) -> Vector3<f64> {
        self.orientation
            .rotation()
            .inverse_transform_vector(&(p_in_world - self.position))
    }

    /// χ ⊕ δ: adds (δΘ, δx) to the angles and the position, with the angles wrapped.
    #[must_use]
    pub fn plus(&self, delta: &Vector6<f64>) -> Self {
        let angles: Vector3<f64> = delta.fixed_rows::<3>(0).into_owned();
        let position: Vector3<f64> = delta.fixed_rows::<3>(3).into_owned();
        Self::new(self.orientation.plus(&angles), self.position + position)
    }

    /// χ ⊖ `other`, angles wrapped: undoes [`Self::plus`]. For how far poses are from each other see
    /// [`Self::error`].
    #[must_use]
    pub fn minus(&self, other: &Self) -> Vector6<f64> {
        self.joined(self.orientation.minus(other.orientation), other)
    }

    /// The error vector (eΘ, eₓ) of eq. (11) against `reference`, radians and cm. Of the two triples of angles
    /// that every orientation has, eΘ takes the nearest, see [`EulerAngles::error`].
    #[must_use]
    pub fn error(&self, reference: &Self) -> Vector6<f64> {
        self.joined(self.orientation.error(reference.orientation), reference)
    }

    /// These angles, then the position less the other's.
    fn joined(&self, angles: Vector3<f64>, other: &Self) -> Vector6<f64> {
        let position = self.position - other.position;
        Vector6::new(
            angles.x, angles.y, angles.z, position.x, position.y, position.z,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_pose_has_no_error_against_itself_in_other_angles() {
        let pose = Pose::from_vector(&Vector6::new(0.1, 2.0, -0.3, 1.0, 2.0, 3.0));
        let turned = EulerAngles::from_rotation(&pose.orientation.rotation());
        assert!(turned.pitch < 1.3, "the other triple: {turned:?}");
        let same = Pose::new(turned, pose.position);
        assert!(same.minus(&pose).norm() > 3.0);
        assert!(same.error(&pose).norm() < 1e-12);
        let moved = Pose::new(turned, pose.position + Vector3::new(0.3, 0.0, 0.4));
        assert!((moved.error(&pose).norm() - 0.5).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn minus_undoes_plus(
            start in prop::array::uniform6(-3.0..3.0), delta in prop::array::uniform6(-3.0..3.0)
        ) {
            let pose = Pose::from_vector(&Vector6::from(start));
            let delta = Vector6::from(delta);
            prop_assert!((pose.plus(&delta).minus(&pose) - delta).amax() < 1e-12);
            prop_assert_eq!(Pose::from_vector(&pose.to_vector()), pose);
        }
    }
}
