//! The groups that errors of a pose and of features are measured in.
//!
//! An element is an orientation R and K points p¹ … pᴷ (the robot's position is one of them). How two
//! elements compose is the whole difference:
//!
//! | group | composition | tangent |
//! | --- | --- | --- |
//! | [`SeK3`], SE_K(3) | (R₁R₂, R₁p₂ + p₁) | rotation and points turn together |
//! | [`So3TimesPoints`], SO(3) × R³ᴷ | (R₁R₂, p₁ + p₂) | rotation and points apart |
//!
//! Tangents are vectors (θ, ξ¹ … ξᴷ) of 3 + 3K entries, radians and cm, in the frame on the left, the
//! world's. SO(3) is either group with K = 0. References: Barrau and Bonnabel, "The Invariant Extended
//! Kalman Filter as a Stable Observer", 2017; Zhang, Wu, Song, Huang and Dissanayake, "Convergence and
//! Consistency Analysis for a 3-D Invariant-EKF SLAM", 2017.

mod groups;
#[cfg(test)]
mod laws;
mod so3;

pub use groups::{SeK3, So3TimesPoints};
pub use so3::{exp, left_jacobian, left_jacobian_inverse, log};

use nalgebra::{DMatrix, DVector};

/// A Lie group with its exponential at the identity.
pub trait LieGroup: Clone {
    /// The product `self` · `other`. Points beyond the shorter list are left out.
    #[must_use]
    fn compose(&self, other: &Self) -> Self;

    /// The element X⁻¹ with X X⁻¹ = 1.
    #[must_use]
    fn inverse(&self) -> Self;

    /// exp(τ) for a tangent τ of 3 + 3K entries; entries that make no whole point are left out.
    #[must_use]
    fn exp(tangent: &DVector<f64>) -> Self;

    /// The tangent of [`Self::exp`], its rotation at most π.
    #[must_use]
    fn log(&self) -> DVector<f64>;

    /// Ad: X exp(τ) X⁻¹ = exp(Ad τ), square of size 3 + 3K.
    #[must_use]
    fn adjoint(&self) -> DMatrix<f64>;

    /// J(τ): exp(τ + δ) = exp(J(τ) δ) exp(τ) to first order in δ, square of size 3 + 3K.
    #[must_use]
    fn left_jacobian(tangent: &DVector<f64>) -> DMatrix<f64>;
}
