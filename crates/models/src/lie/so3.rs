//! Rotations: exponential, logarithm and Jacobian in closed form.

use nalgebra::{Matrix3, Rotation3, Vector3};

/// Below this angle, radians, series are exact to rounding and the quotients are not.
const SMALL: f64 = 1e-3;

/// exp(`[θ]×`), the rotation about θ by |θ| radians.
#[must_use]
pub fn exp(theta: &Vector3<f64>) -> Rotation3<f64> {
    Rotation3::new(*theta)
}

/// θ with exp(`[θ]×`) = R and |θ| ≤ π, radians.
#[must_use]
pub fn log(rotation: &Rotation3<f64>) -> Vector3<f64> {
    // By the quaternion: the angle from the trace alone loses half the digits near 0 and π.
    nalgebra::UnitQuaternion::from_rotation_matrix(rotation).scaled_axis()
}

/// J(θ), 3 × 3, with exp(θ + δ) = exp(J(θ) δ) exp(θ) to first order; it also turns the rate of a
/// twist into the way it leads: the points of exp on SE_K(3) are J(θ) ξ.
#[must_use]
pub fn left_jacobian(theta: &Vector3<f64>) -> Matrix3<f64> {
    let cross = theta.cross_matrix();
    let squared = theta.norm_squared();
    let angle = squared.sqrt();
    let (a, b) = if angle < SMALL {
        (
            0.5 - squared / 24.0 + squared * squared / 720.0,
            1.0 / 6.0 - squared / 120.0 + squared * squared / 5040.0,
        )
    } else {
        (
            (1.0 - angle.cos()) / squared,
            (angle - angle.sin()) / (squared * angle),
        )
    };
    Matrix3::identity() + cross * a + cross * cross * b
}

/// J(θ)⁻¹, for |θ| < 2π.
#[must_use]
pub fn left_jacobian_inverse(theta: &Vector3<f64>) -> Matrix3<f64> {
    let cross = theta.cross_matrix();
    let squared = theta.norm_squared();
    let angle = squared.sqrt();
    let c = if angle < SMALL {
        1.0 / 12.0 + squared / 720.0 + squared * squared / 30_240.0
    } else {
        1.0 / squared - angle.sin() / (2.0 * angle * (1.0 - angle.cos()))
    };
    Matrix3::identity() - cross * 0.5 + cross * cross * c
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// About an axis the Jacobian and its inverse are known in closed form without a difference of near numbers.
    #[test]
    fn of_small_angles_every_digit_is_right() {
        for angle in [9.9e-4, 5e-4, 1e-5, -9.9e-4, 1.1e-3] {
            let half: f64 = 0.5 * angle;
            let theta = Vector3::z() * angle;
            let jacobian = left_jacobian(&theta);
            let side = 2.0 * half.sin().powi(2) / angle;
            let digits = if angle.abs() < SMALL { 1.5e-15 } else { 1e-9 };
            assert!((jacobian[(1, 0)] / side - 1.0).abs() < digits, "{angle}");
            assert!((jacobian[(0, 0)] - angle.sin() / angle).abs() < 5e-16);
            let inverse = left_jacobian_inverse(&theta);
            assert_eq!(inverse[(0, 1)], half);
            let digits = if angle.abs() < SMALL { 5e-16 } else { 1e-9 };
            let error = inverse[(0, 0)] - half / half.tan();
            assert!(error.abs() < digits, "{angle}");
        }
    }

    proptest! {
        #[test]
        fn the_inverse_is_the_inverse_at_any_angle(
            axis in prop::array::uniform3(-1.0..1.0), exponent in -9.0..0.79
        ) {
            let theta = Vector3::from(axis) * 10f64.powf(exponent) / 3f64.sqrt();
            let product = left_jacobian(&theta) * left_jacobian_inverse(&theta);
            prop_assert!((product - Matrix3::identity()).amax() < 1e-9);
        }

        /// The derivative of a small rotation is far from rounding; of the exponential it is not.
        #[test]
        fn series_and_quotients_meet(axis in prop::array::uniform3(-1.0..1.0)) {
            let axis = Vector3::from(axis);
            prop_assume!(axis.norm() > 0.1);
            let at = |angle: f64| axis.normalize() * angle;
            let (below, above) = (at(SMALL * (1.0 - 1e-12)), at(SMALL * (1.0 + 1e-12)));
            prop_assert!((left_jacobian(&below) - left_jacobian(&above)).amax() < 1e-10);
            let inverse = left_jacobian_inverse(&below) - left_jacobian_inverse(&above);
            prop_assert!(inverse.amax() < 1e-9);
        }

        #[test]
        fn the_logarithm_undoes_the_exponential_up_to_half_a_turn(
            axis in prop::array::uniform3(-1.0..1.0), angle in 0.0..std::f64::consts::PI
        ) {
            let axis = Vector3::from(axis);
            prop_assume!(axis.norm() > 0.1);
            let theta = axis.normalize() * angle;
            prop_assert!((log(&exp(&theta)) - theta).amax() < 1e-9);
        }
    }
}
