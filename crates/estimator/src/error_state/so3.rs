//! The orientation's error on SO(3), positions subtracted.

use adslam_models::{State, lie};
use nalgebra::Matrix3;

use super::{
    ErrorState, angles_in, angles_of, inverse_axes, joined, positions, positions_with,
    rotation_between, turned,
};

/// R = exp(θ) R̂ with θ in the world's frame, positions by difference: SO(3) × R³⁽¹⁺ᴹ⁾. T turns angles
/// into θ = W(Θ̂) δΘ. The error of the "SO(3)-EKF" of Zhang, Wu, Song, Huang and Dissanayake, 2017.
#[derive(Clone, Copy, Debug)]
pub struct So3Error;

impl ErrorState for So3Error {
    const CONVERTS_ANGLES: bool = true;

    fn retract(state: &mut State, delta: &[f64]) {
        for (p, part) in positions_with(state, delta) {
            *p += part;
        }
        let orientation = &mut state.pose.orientation;
        let theta = orientation.rotation_axes() * angles_in(delta);
        *orientation = turned(*orientation, &lie::exp(&theta));
    }

    fn error(estimate: &State, truth: &State) -> Vec<f64> {
        let theta = lie::log(&rotation_between(&estimate.pose, &truth.pose));
        let angles = angles_of(&theta, estimate.pose.orientation);
        let both = positions(truth).zip(positions(estimate));
        joined(angles, both.map(|(p, estimated)| p - estimated))
    }

    fn reset(before: &State, after: &State, blocks: &mut Vec<Matrix3<f64>>) {
        blocks.clear();
        let axes = before.pose.orientation.rotation_axes();
        blocks.push(inverse_axes(after.pose.orientation) * axes - Matrix3::identity());
        blocks.resize(2 + after.features.len(), Matrix3::zeros());
    }
}
