//! The paper's error: angles and positions subtracted.

use adslam_models::State;
use nalgebra::Matrix3;

use super::{ErrorState, angles_in, joined, positions, positions_with};

/// δ = χ ⊖ χ̂, angles wrapped, of the truth's two triples of angles the one nearest to the estimate's; T = I. The
/// error of Algorithm 1 and eqs. (11), (12).
#[derive(Clone, Copy, Debug)]
pub struct EulerError;

impl ErrorState for EulerError {
    const CONVERTS_ANGLES: bool = false;

    fn retract(state: &mut State, delta: &[f64]) {
        for (p, part) in positions_with(state, delta) {
            *p += part;
        }
        state.pose.orientation = state.pose.orientation.plus(&angles_in(delta));
    }

    fn error(estimate: &State, truth: &State) -> Vec<f64> {
        let angles = truth.pose.orientation.error(estimate.pose.orientation);
        let both = positions(truth).zip(positions(estimate));
        joined(angles, both.map(|(p, estimated)| p - estimated))
    }

    fn reset(_: &State, _: &State, blocks: &mut Vec<Matrix3<f64>>) {
        blocks.clear();
    }
}
