//! The error of robot and features together on SE₁₊ₘ(3).

use adslam_models::{State, lie};
use nalgebra::Matrix3;

use super::{
    ErrorState, angles_in, angles_of, inverse_axes, joined, positions, positions_with,
    rotation_between, turned,
};

/// exp(τ) = X X̂⁻¹ with X = (R, x, p¹ … pᴹ): an error of the heading turns the robot and all features
/// about the world's origin. T: θ = W(Θ̂) δΘ, ξᵏ = δᵏ + `[p̂ᵏ]×` θ for x and each feature.
///
/// In τ a motion of everything together is the same vector whatever the estimate is, and no measurement
/// of the robot's sensor depends on it: the filter cannot come to believe that it learned something about
/// it (Barrau and Bonnabel, "An EKF-SLAM algorithm with consistency properties", 2015). Features that move
/// by displacements d known along the world's axes have ξ' = ξ + `[d]×` θ: a common translation stays
/// unobservable, and the heading becomes known as far as such displacements tell it.
#[derive(Clone, Copy, Debug)]
pub struct RightInvariantError;

// The exponential leads to exp(θ) p̂ + J(θ) ξ. With ξ = δ + p̂ × θ and J(θ) [θ]× = exp(θ) − 1 that is
// p̂ + J(θ) δ, wherever the origin is.
impl ErrorState for RightInvariantError {
    const CONVERTS_ANGLES: bool = true;

    fn retract(state: &mut State, delta: &[f64]) {
        let theta = state.pose.orientation.rotation_axes() * angles_in(delta);
        let jacobian = lie::left_jacobian(&theta);
        for (p, part) in positions_with(state, delta) {
            *p += jacobian * part;
        }
        state.pose.orientation = turned(state.pose.orientation, &lie::exp(&theta));
    }

    fn error(estimate: &State, truth: &State) -> Vec<f64> {
        let theta = lie::log(&rotation_between(&estimate.pose, &truth.pose));
        let inverse = lie::left_jacobian_inverse(&theta);
        let both = positions(truth).zip(positions(estimate));
        let moved = both.map(|(p, estimated)| inverse * (p - estimated));
        joined(angles_of(&theta, estimate.pose.orientation), moved)
    }

    fn reset(before: &State, after: &State, blocks: &mut Vec<Matrix3<f64>>) {
        blocks.clear();
        let axes = before.pose.orientation.rotation_axes();
        blocks.push(inverse_axes(after.pose.orientation) * axes - Matrix3::identity());
        let both = positions(before).zip(positions(after));
        blocks.extend(both.map(|(before, after)| (before - after).cross_matrix() * axes));
    }
}
