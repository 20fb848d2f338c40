//! Measurement models: the robot's sensor, eq. (10), and the object's structure, eqs. (4), (5).

use nalgebra::{Matrix3, Matrix3x6, Point3, Vector3};

use crate::Pose;

/// Derivatives of one feature measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureMeasurementJacobians {
    /// ∂z/∂(Θ, x), 3 × 6.
    pub pose: Matrix3x6<f64>,
    /// ∂z/∂p, 3 × 3.
    pub feature: Matrix3<f64>,
}

/// The feature at `p_in_world` as the sensor measures it, without noise: z = R(Θ)ᵀ(p − x), cm, body
/// frame.
///
/// Eq. (10) prints R(Θ)(x − p), which with the R of eq. (2) is no body-frame vector; this is
/// the form that the paper's published results were computed with.
#[must_use]
pub fn feature_measurement(pose: &Pose, p_in_world: &Point3<f64>) -> Vector3<f64> {
    pose.body_from_world(p_in_world)
}

/// Derivatives of [`feature_measurement`] by the pose and by the feature.
#[must_use]
pub fn feature_measurement_jacobians(
    pose: &Pose,
    p_in_world: &Point3<f64>,
) -> FeatureMeasurementJacobians {
    let body_from_world = pose.orientation.rotation().into_inner().transpose();
    let offset = p_in_world - pose.position;
    let mut jacobian = Matrix3x6::zeros();
    for (k, derivative) in pose.orientation.rotation_derivatives().iter().enumerate() {
        jacobian.set_column(k, &(derivative.transpose() * offset));
    }
    jacobian
        .fixed_view_mut::<3, 3>(0, 3)
        .copy_from(&-body_from_world);
    FeatureMeasurementJacobians {
        pose: jacobian,
        feature: body_from_world,
    }
}

/// The structure measurement between two features, without noise: eqs. (4) and (5) with the
/// reference p¹ cancelled, `p_to` − `p_from`, cm, world axes. Its derivatives are +I and −I.
#[must_use]
pub fn structure_measurement(p_from: &Point3<f64>, p_to: &Point3<f64>) -> Vector3<f64> {
    p_to - p_from
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector6;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn jacobians_match_finite_differences(
            pose in prop::array::uniform6(-3.0..3.0), p in prop::array::uniform3(-9.0..9.0)
        ) {
            let pose = Pose::from_vector(&Vector6::from(pose));
            let p = Point3::from(p);
            let analytic = feature_measurement_jacobians(&pose, &p);
            let step = 1e-6;
            for k in 0..6 {
                let mut delta = Vector6::zeros();
                delta[k] = step;
                let forward = feature_measurement(&pose.plus(&delta), &p);
                let backward = feature_measurement(&pose.plus(&-delta), &p);
                let numeric = (forward - backward) / (2.0 * step);
                prop_assert!((analytic.pose.column(k) - numeric).amax() < 1e-7);
            }
            for k in 0..3 {
                let mut delta = Vector3::zeros();
                delta[k] = step;
                let forward = feature_measurement(&pose, &(p + delta));
                let backward = feature_measurement(&pose, &(p - delta));
                let numeric = (forward - backward) / (2.0 * step);
                prop_assert!((analytic.feature.column(k) - numeric).amax() < 1e-8);
            }
        }

        #[test]
        fn structure_does_not_depend_on_the_reference_feature(
            a in prop::array::uniform3(-9.0..9.0),
            b in prop::array::uniform3(-9.0..9.0),
            reference in prop::array::uniform3(-9.0..9.0)
        ) {
            let (a, b, first) = (Point3::from(a), Point3::from(b), Point3::from(reference));
            let local = |p: &Point3<f64>| p - first;
            let printed = local(&b) - local(&a);
            prop_assert!((structure_measurement(&a, &b) - printed).amax() < 1e-12);
        }
    }
}
