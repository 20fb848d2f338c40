//! What an estimator takes for the error of a state.
//!
//! Whatever the error is, to first order it is linear in the paper's, δ = χ ⊖ χ̂ with angles and positions
//! subtracted: τ = T(χ̂) δ. The covariance is kept in δ for every estimator, P_τ = T P Tᵀ; all Jacobians
//! follow by the chain rule at the same state, so propagation and the conditioning on measurements
//! are the same computation. Two things are left, and they are what an [`ErrorState`] is: where a
//! correction leads, which is not linear, and that P_τ, not P, stays the same when the estimate then
//! moves from χ̂ to χ̂⁺: P ← D P Dᵀ with D = T(χ̂⁺)⁻¹ T(χ̂).
//!
//! That is for what the robot's sensor saw. Structure measurements are linear in δ, and correct in δ.

mod euler;
mod right_invariant;
mod so3;

use adslam_models::{EulerAngles, Pose, State};
use nalgebra::{Matrix3, Rotation3, Vector3};

pub use euler::EulerError;
pub use right_invariant::RightInvariantError;
pub use so3::So3Error;

use crate::EstimatorError;

/// The error coordinates of an estimator. Vectors δ and errors are in the order of the state, radians and cm,
/// in the paper's coordinates: the δ that is T(χ̂)⁻¹ τ.
pub trait ErrorState: Clone + std::fmt::Debug + Send + 'static {
    /// χ̂ ← χ̂ ⊞ δ, where `delta` has an entry for each of the state.
    fn retract(state: &mut State, delta: &[f64]);

    /// The δ with `truth` = `estimate` ⊞ δ: the error of which the belief's covariance is that.
    #[must_use]
    fn error(estimate: &State, truth: &State) -> Vec<f64>;

    /// Whether T turns angles into a rotation, which near pitch ±90° loses digits: false where T = I.
    const CONVERTS_ANGLES: bool;

    /// D − I when the estimate moved from `before` to `after`. Only its columns of Θ are not zero: a block
    /// of 3 × 3 each for the rows of Θ, of x, and of each feature. Left empty where D = I.
    fn reset(before: &State, after: &State, blocks: &mut Vec<Matrix3<f64>>);
}

/// δΘ of a rotation θ in the world, W(Θ) δΘ = θ; NaN at pitch ±π/2, where angles cannot follow.
fn angles_of(theta: &Vector3<f64>, orientation: EulerAngles) -> Vector3<f64> {
    inverse_axes(orientation) * theta
}

/// W(Θ)⁻¹.
fn inverse_axes(orientation: EulerAngles) -> Matrix3<f64> {
    orientation
        .rotation_axes()
        .try_inverse()
        .unwrap_or_else(|| Matrix3::repeat(f64::NAN))
}

/// What converting a covariance may change of it at most.
const LARGEST_LOSS: f64 = 1e-6;

/// Refuses orientations between which a covariance in angles cannot be carried over with six right digits.
///
/// P = W₀⁻¹ R W₀⁻ᵀ of a covariance R of rotations becomes D P Dᵀ, D = W₁⁻¹ W₀. Its rounding errors, ε |D|² |P|,
/// count in rotations at `after`: relative to R that is at most ε (|W₁| |D| |W₀⁻¹|)², with Frobenius norms. Where little
/// is corrected D is I, and that is 18 ε/cos²(pitch).
pub(crate) fn check_conversion(
    before: EulerAngles,
    after: EulerAngles,
) -> Result<(), EstimatorError> {
    let (from, to) = (before.rotation_axes(), after.rotation_axes());
    let reset = inverse_axes(after) * from;
    let condition = to.norm() * reset.norm() * inverse_axes(before).norm();
    let loss = f64::EPSILON * condition * condition;
    if loss <= LARGEST_LOSS {
        return Ok(());
    }
    Err(EstimatorError::PitchNearRightAngle {
        pitch_deg: after.pitch.to_degrees(),
        loss,
    })
}

/// The rotation from the estimate to the truth, in the world.
fn rotation_between(estimate: &Pose, truth: &Pose) -> Rotation3<f64> {
    truth.orientation.rotation() * estimate.orientation.rotation().inverse()
}

/// The orientation turned by `rotation` in the world. Its angles are those nearest to the old ones, as they
/// may be beyond pitch ±π/2.
fn turned(orientation: EulerAngles, rotation: &Rotation3<f64>) -> EulerAngles {
    EulerAngles::nearest_of_rotation(&(rotation * orientation.rotation()), orientation)
}

/// An error from its angles, then positions.
fn joined(angles: Vector3<f64>, positions: impl Iterator<Item = Vector3<f64>>) -> Vec<f64> {
    std::iter::once(angles)
        .chain(positions)
        .flat_map(|v| [v.x, v.y, v.z])
        .collect()
}

/// The robot's position and all features.
fn positions(state: &State) -> impl Iterator<Item = &nalgebra::Point3<f64>> {
    std::iter::once(&state.pose.position).chain(&state.features)
}

/// Each position with its part of δ, to change it.
fn positions_with<'a>(
    state: &'a mut State,
    delta: &'a [f64],
) -> impl Iterator<Item = (&'a mut nalgebra::Point3<f64>, Vector3<f64>)> {
    let (parts, _) = delta.get(3..).unwrap_or_default().as_chunks::<3>();
    std::iter::once(&mut state.pose.position)
        .chain(&mut state.features)
        .zip(parts.iter().copied().map(Vector3::from))
}

/// δΘ of δ.
fn angles_in(delta: &[f64]) -> Vector3<f64> {
    delta
        .first_chunk::<3>()
        .copied()
        .map_or_else(Vector3::zeros, Vector3::from)
}
