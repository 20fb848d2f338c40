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

    /// χ ⊖ `other`: the error vector (eΘ, eₓ) of eq. (11), with the angles wrapped.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Vector6<f64> {
        let angles = self.orientation.minus(other.orientation);
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
