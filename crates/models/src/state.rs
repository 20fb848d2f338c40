//! The joint state of eq. (1) and where each part of it lies.

use std::fmt;

use nalgebra::{Point3, Vector3};

use crate::Pose;

/// Entries of the state that the robot's pose takes.
pub const POSE_DIM: usize = 6;

/// Which feature: its place in the state, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FeatureId(pub usize);

impl fmt::Display for FeatureId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "feature {}", self.0)
    }
}

/// n = 6 + 3M, the dimension of the state with M features.
#[must_use]
pub const fn state_dim(feature_count: usize) -> usize {
    POSE_DIM + 3 * feature_count
}

/// The first of the three state entries of a feature.
#[must_use]
pub const fn feature_offset(feature: FeatureId) -> usize {
    POSE_DIM + 3 * feature.0
}

/// χ = (Θ, x, p¹ … pᴹ), eq. (1): the pose and every feature, in the world.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// The robot.
    pub pose: Pose,
    /// Positions of the features, cm.
    pub features: Vec<Point3<f64>>,
}

impl State {
    /// n = 6 + 3M.
    #[must_use]
    pub fn dim(&self) -> usize {
        state_dim(self.features.len())
    }

    /// Moves every feature by its own displacement, cm: p' = p + `r_t` t + `r_d` d, the rest of
    /// eq. (2). Its Jacobian is the identity. Displacements beyond the number of features are ignored.
    pub fn move_features(&mut self, displacements: &[Vector3<f64>]) {
        for (p, displacement) in self.features.iter_mut().zip(displacements) {
            *p += displacement;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_layout_is_pose_then_features() {
        let mut state = State {
            pose: Pose::default(),
            features: vec![Point3::origin(); 4],
        };
        assert_eq!(state.dim(), 18);
        assert_eq!(feature_offset(FeatureId(3)) + 3, state.dim());
        state.move_features(&[Vector3::x(), Vector3::y()]);
        assert_eq!(state.features[1], Point3::new(0.0, 1.0, 0.0));
        assert_eq!(state.features[2], Point3::origin());
        assert_eq!(FeatureId(3).to_string(), "feature 3");
    }
}
