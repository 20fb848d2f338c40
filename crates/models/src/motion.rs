//! The robot's part of the process model, eq. (2).

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::Pose;

/// Control input `u_n` = [Ωₙ, vₙ].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Control {
    /// Ω, increments of roll, pitch and yaw, radians.
    pub rotation: Vector3<f64>,
    /// v, translation in the body frame *before* the motion, cm.
    pub translation: Vector3<f64>,
}

/// ∂χ'/∂χ of the pose, 6 × 6, in the order (Θ, x).
pub type MotionJacobian = Matrix6<f64>;

/// The pose after `control` with the noise w = (`w_Ω`, `w_v`), radians and cm, world axes:
/// Θ' = wrap(Θ + Ω + `w_Ω`), x' = x + R(Θ) v + `w_v`. Eq. (2).
#[must_use]
pub fn move_pose(pose: &Pose, control: &Control, noise: &Vector6<f64>) -> Pose {
    let translation = pose.orientation.rotation() * control.translation;
    let mut delta = *noise;
    for k in 0..3 {
        delta[k] += control.rotation[k];
        delta[3 + k] += translation[k];
    }
    pose.plus(&delta)
}

/// The pose after `control` without noise: f(χ, u, 0) of Algorithm 1.
#[must_use]
pub fn predicted_pose(pose: &Pose, control: &Control) -> Pose {
    move_pose(pose, control, &Vector6::zeros())
}

/// F, the derivative of the pose after `control` by the pose before it. The noise enters with the
/// identity, so G = I.
#[must_use]
pub fn motion_jacobian(pose: &Pose, control: &Control) -> MotionJacobian {
    let mut jacobian = Matrix6::identity();
    for (k, derivative) in pose.orientation.rotation_derivatives().iter().enumerate() {
        jacobian
            .fixed_view_mut::<3, 1>(3, k)
            .copy_from(&(derivative * control.translation));
    }
    jacobian
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Vector6;
    use proptest::prelude::*;
    use std::f64::consts::FRAC_PI_2;

    fn control(u: [f64; 6]) -> Control {
        Control {
            rotation: Vector3::new(u[0], u[1], u[2]),
            translation: Vector3::new(u[3], u[4], u[5]),
        }
    }

    #[test]
    fn translation_is_in_the_body_frame_before_the_rotation() {
        let facing_y = Pose::from_vector(&Vector6::new(0.0, 0.0, FRAC_PI_2, 1.0, 2.0, 3.0));
        let moved = predicted_pose(&facing_y, &control([0.0, 0.0, 0.5, 1.0, 0.0, 0.0]));
        assert_relative_eq!(moved.position.y, 3.0, epsilon = 1e-15);
        assert_relative_eq!(moved.position.x, 1.0, epsilon = 1e-15);
        assert_relative_eq!(moved.orientation.yaw, FRAC_PI_2 + 0.5, epsilon = 1e-15);
    }

    proptest! {
        #[test]
        fn jacobian_matches_finite_differences(
            pose in prop::array::uniform6(-3.0..3.0), u in prop::array::uniform6(-3.0..3.0)
        ) {
            let pose = Pose::from_vector(&Vector6::from(pose));
            let u = control(u);
            let analytic = motion_jacobian(&pose, &u);
            let step = 1e-6;
            for k in 0..6 {
                let mut delta = Vector6::zeros();
                delta[k] = step;
                let forward = predicted_pose(&pose.plus(&delta), &u);
                let backward = predicted_pose(&pose.plus(&-delta), &u);
                let numeric = forward.minus(&backward) / (2.0 * step);
                prop_assert!((analytic.column(k) - numeric).amax() < 1e-8);
            }
        }

        #[test]
        fn noise_adds_to_the_predicted_pose(
            pose in prop::array::uniform6(-3.0..3.0),
            u in prop::array::uniform6(-3.0..3.0),
            w in prop::array::uniform6(-0.1..0.1)
        ) {
            let pose = Pose::from_vector(&Vector6::from(pose));
            let (u, w) = (control(u), Vector6::from(w));
            let error = move_pose(&pose, &u, &w).minus(&predicted_pose(&pose, &u));
            prop_assert!((error - w).amax() < 1e-12);
        }
    }
}
