//! Errors at one step.

use adslam_estimator::Belief;
use adslam_models::{EulerAngles, FeatureId, POSE_DIM, Pose, State, feature_offset};
use adslam_statistics::mean;
use nalgebra::{Isometry3, Vector3, Vector6};

use super::align;

/// The errors of a belief against the truth at one step.
#[derive(Clone, Debug, PartialEq)]
pub struct StepMetrics {
    /// Eq. (11): √(e_Θᵀe_Θ + e_xᵀe_x), radians and cm together as the paper has it.
    pub pose_error: f64,
    /// The orientation's part of it, radians.
    pub orientation_error: f64,
    /// The angle of the rotation between the true orientation and the estimate, radians: the geodesic distance
    /// on SO(3), which no choice of angles changes.
    pub geodesic_orientation_error: f64,
    /// The position's part of it, cm.
    pub position_error: f64,
    /// Eq. (12) for each feature, cm.
    pub feature_errors: Vec<f64>,
    /// eᵀP⁻¹e of the pose, 6 degrees of freedom, e being the estimator's own error; absent while its
    /// covariance is singular, as at an exactly known start.
    pub pose_nees: Option<f64>,
    /// eᵀP⁻¹e of each feature, 3 degrees of freedom; absent where its covariance is singular.
    pub feature_nees: Vec<Option<f64>>,
    /// eᵀP⁻¹e of the whole state, n degrees of freedom, divided by n; absent while P is singular.
    pub joint_nees_per_dof: Option<f64>,
    /// Eq. (11) after the estimate was aligned to the object, see [`measure_step`].
    pub relative_pose_error: f64,
    /// The geodesic distance of the orientations after the alignment, radians.
    pub relative_geodesic_orientation_error: f64,
    /// The distance of the positions after the alignment, cm.
    pub relative_position_error: f64,
    /// Mean of eq. (12) after the alignment, cm.
    pub relative_feature_error: f64,
}

/// Compares a belief with the truth. `own_error` is the error of which the belief's covariance is that, see
/// [`Estimator::error`](adslam_estimator::Estimator::error): the NEES are of it.
///
/// The object-relative errors align the estimated features rigidly to the true ones and move the
/// estimated pose with them: they hold what the robot knows of its place relative to the object,
/// without the drift of everything together, which no measurement shows.
///
/// `None` if the estimate is not finite.
#[must_use]
pub fn measure_step(belief: &Belief, truth: &State, own_error: &[f64]) -> Option<StepMetrics> {
    let State { pose, features } = truth;
    let error = belief.state.pose.error(pose);
    let estimated = &belief.state.features;
    let distances = |moved: &Isometry3<f64>| -> Vec<f64> {
        estimated
            .iter()
            .zip(features)
            .map(|(e, p)| (moved * e - p).norm())
            .collect()
    };
    let feature_errors = distances(&Isometry3::identity());
    let alignment = align(estimated, features)?;
    let relative_pose = moved_pose(&belief.state.pose, &alignment);
    let relative_error = relative_pose.error(pose);
    Some(StepMetrics {
        pose_error: error.norm(),
        orientation_error: error.fixed_rows::<3>(0).norm(),
        geodesic_orientation_error: belief.state.pose.orientation.angle_to(pose.orientation),
        position_error: error.fixed_rows::<3>(3).norm(),
        pose_nees: pose_nees(belief, own_error),
        feature_nees: feature_nees(belief, own_error),
        joint_nees_per_dof: belief
            .covariance
            .mahalanobis_squared(own_error)
            .ok()
            .map(|nees| nees / own_error.len() as f64),
        relative_pose_error: relative_error.norm(),
        relative_geodesic_orientation_error: relative_pose.orientation.angle_to(pose.orientation),
        relative_position_error: relative_error.fixed_rows::<3>(3).norm(),
        relative_feature_error: mean(&distances(&alignment)),
        feature_errors,
    })
}

fn moved_pose(pose: &Pose, by: &Isometry3<f64>) -> Pose {
    let rotation = by.rotation * pose.orientation.quaternion();
    Pose::new(
        EulerAngles::from_rotation(&rotation.to_rotation_matrix()),
        by * pose.position,
    )
}

fn pose_nees(belief: &Belief, error: &[f64]) -> Option<f64> {
    let error = Vector6::from(*error.first_chunk::<POSE_DIM>()?);
    let factor = belief.covariance.pose().cholesky()?;
    Some(error.dot(&factor.solve(&error)))
}

fn feature_nees(belief: &Belief, error: &[f64]) -> Vec<Option<f64>> {
    let of = |feature| {
        let error = Vector3::from(*error.get(feature_offset(feature)..)?.first_chunk::<3>()?);
        let factor = belief.covariance.feature(feature).cholesky()?;
        Some(error.dot(&factor.solve(&error)))
    };
    (0..belief.state.features.len())
        .map(FeatureId)
        .map(of)
        .collect()
}

impl StepMetrics {
    /// Mean over the features of their NEES; absent while one of them has none.
    #[must_use]
    pub fn feature_nees_mean(&self) -> Option<f64> {
        let each: Option<Vec<f64>> = self.feature_nees.iter().copied().collect();
        each.filter(|each| !each.is_empty()).map(|each| mean(&each))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use adslam_estimator::{ErrorState, EulerError};
    use approx::assert_relative_eq;
    use nalgebra::{Matrix6, Point3};

    fn measured(belief: &Belief, truth: &State) -> StepMetrics {
        let error = EulerError::error(&belief.state, truth);
        measure_step(belief, truth, &error).unwrap()
    }

    fn truth() -> State {
        let pose = Pose::from_vector(&Vector6::new(0.1, 0.2, 3.1, 1.0, 2.0, 3.0));
        let features = vec![
            Point3::new(1.0, 0.0, 0.0),
            Point3::new(0.0, 2.0, 0.0),
            Point3::new(0.0, 0.0, 3.0),
            Point3::origin(),
        ];
        State { pose, features }
    }

    #[test]
    fn errors_by_hand() {
        let truth = truth();
        let State { pose, features } = truth.clone();
        // The yaw differs across the wrap: 3.1 + 0.12 is beyond π.
        let estimate = pose.plus(&Vector6::new(0.0, 0.0, 0.12, 0.03, 0.04, 0.0));
        let off: Vec<Point3<f64>> = features.iter().map(|p| p + Vector3::x() * 0.2).collect();
        let belief = Belief::initial(estimate, off, &(Matrix6::identity() * 0.01), 0.1).unwrap();
        let metrics = measured(&belief, &truth);
        assert_relative_eq!(metrics.pose_error, 0.13, epsilon = 1e-12);
        assert_relative_eq!(metrics.orientation_error, 0.12, epsilon = 1e-12);
        assert_relative_eq!(metrics.geodesic_orientation_error, 0.12, epsilon = 1e-12);
        assert_relative_eq!(metrics.position_error, 0.05, epsilon = 1e-12);
        assert_relative_eq!(metrics.pose_nees.unwrap(), 1.69, epsilon = 1e-10);
        assert_relative_eq!(metrics.feature_nees[3].unwrap(), 4.0, epsilon = 1e-10);
        assert_relative_eq!(metrics.feature_nees_mean().unwrap(), 4.0, epsilon = 1e-10);
        let joint = (1.69 + 4.0 * 4.0) / 18.0;
        assert_relative_eq!(metrics.joint_nees_per_dof.unwrap(), joint, epsilon = 1e-10);
        assert_relative_eq!(metrics.feature_errors[2], 0.2, epsilon = 1e-12);
        assert!(metrics.relative_feature_error < 1e-12);
    }

    /// The alignment turns the estimate by a rotation, whose angles have their pitch within ±90°.
    #[test]
    fn a_pitch_beyond_a_right_angle_is_no_error() {
        let mut truth = truth();
        truth.pose.orientation = EulerAngles::new(0.1, 2.1, -0.4);
        let State { pose, features } = truth.clone();
        let estimate = pose.plus(&Vector6::new(0.0, 0.02, 0.0, 0.3, 0.0, 0.4));
        let belief = Belief::initial(estimate, features, &Matrix6::zeros(), 0.1).unwrap();
        let metrics = measured(&belief, &truth);
        assert_relative_eq!(metrics.pose_error, 0.2504_f64.sqrt(), epsilon = 1e-12);
        assert_relative_eq!(
            metrics.relative_pose_error,
            metrics.pose_error,
            epsilon = 1e-9
        );
        let geodesic = metrics.relative_geodesic_orientation_error;
        assert_relative_eq!(geodesic, 0.02, epsilon = 1e-9);
        assert_relative_eq!(metrics.relative_position_error, 0.5, epsilon = 1e-9);
    }

    #[test]
    fn moving_everything_together_leaves_no_relative_error() {
        let truth = truth();
        let State { pose, features } = truth.clone();
        let motion = Isometry3::new(Vector3::new(0.3, -0.2, 0.1), Vector3::new(0.0, 0.1, 0.3));
        let moved = features.iter().map(|p| motion * p).collect();
        let belief =
            Belief::initial(moved_pose(&pose, &motion), moved, &Matrix6::zeros(), 0.1).unwrap();
        let metrics = measured(&belief, &truth);
        assert!(metrics.pose_error > 0.3);
        assert!(metrics.relative_pose_error < 1e-12);
        assert!(metrics.relative_geodesic_orientation_error < 1e-12);
        assert!(metrics.relative_position_error < 1e-12);
        assert_eq!(metrics.pose_nees, None, "an exactly known pose has no NEES");
    }
}
