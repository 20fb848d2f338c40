//! Algorithm 1's covariance in numbers of 400 bits: as good as exact, whatever the sigmas.
#![allow(dead_code, reason = "each test file uses a part")]

mod float;

use adslam_estimator::{Belief, FeatureMeasurement, FilterNoise, PairMeasurement};
use adslam_models::{Control, State, motion_jacobian};
use nalgebra::{DMatrix, DVector};

use crate::common::{covariance_matrix, stacked};
pub use float::Float;

/// A matrix, row by row.
pub type Exact = Vec<Vec<Float>>;

pub fn exact(m: &DMatrix<f64>) -> Exact {
    m.row_iter()
        .map(|row| row.iter().map(|x| Float::from(*x)).collect())
        .collect()
}

/// xᵀy, over the entries of x that are not zero.
fn dot<'a>(x: &[Float], y: impl IntoIterator<Item = &'a Float>) -> Float {
    let terms = x.iter().zip(y).filter(|(x, _)| !x.is_zero());
    terms.fold(Float::zero(), |sum, (x, y)| &sum + &(x * y))
}

fn product(a: &Exact, b: &Exact) -> Exact {
    let columns = transposed(b);
    a.iter()
        .map(|row| columns.iter().map(|column| dot(row, column)).collect())
        .collect()
}

fn transposed(a: &Exact) -> Exact {
    let columns = a.first().map_or(0, Vec::len);
    (0..columns)
        .map(|j| a.iter().map(|row| row[j].clone()).collect())
        .collect()
}

/// F P Fᵀ + Q.
pub fn propagated(p: &Exact, state: &State, control: &Control, noise: &FilterNoise) -> Exact {
    let n = p.len();
    let mut f = DMatrix::identity(n, n);
    f.view_mut((0, 0), (6, 6))
        .copy_from(&motion_jacobian(&state.pose, control));
    let q = DVector::from_fn(n, |i, _| match i {
        0..3 => noise.rotation_sigma,
        3..6 => noise.translation_sigma,
        _ => noise.feature_motion_sigma,
    });
    let f = exact(&f);
    let mut moved = product(&product(&f, p), &transposed(&f));
    for i in 0..n {
        moved[i][i] = &moved[i][i] + &Float::from(q[i] * q[i]);
    }
    moved
}

/// P after the measurements, one row after another, and the correction δ of the state.
pub fn updated(
    p: &Exact,
    state: &State,
    features: &[FeatureMeasurement],
    pairs: &[PairMeasurement],
    noise: &FilterNoise,
) -> (Exact, Vec<Float>) {
    let (h, o, y) = stacked(state, features, pairs, noise);
    let n = p.len();
    let mut p = p.clone();
    let mut delta = vec![Float::zero(); n];
    for (row, (o, y)) in exact(&h).iter().zip(o.iter().zip(&y)) {
        let ph: Vec<Float> = p.iter().map(|of_p| dot(row, of_p)).collect();
        let s = &dot(row, &ph) + &Float::from(*o);
        let innovation = &Float::from(*y) - &dot(row, &delta);
        for i in 0..n {
            let gain = &ph[i] / &s;
            delta[i] = &delta[i] + &(&gain * &innovation);
            for j in 0..n {
                p[i][j] = &p[i][j] - &(&gain * &ph[j]);
            }
        }
    }
    (p, delta)
}

pub fn covariance(belief: &Belief) -> Exact {
    exact(&covariance_matrix(belief))
}

/// T P Tᵀ, rounded once at the end.
pub fn between(t: &DMatrix<f64>, belief: &Belief) -> DMatrix<f64> {
    let t = exact(t);
    let all = product(&product(&t, &covariance(belief)), &transposed(&t));
    DMatrix::from_fn(all.len(), all.len(), |i, j| all[i][j].to_f64())
}

pub fn trace(p: &Exact) -> f64 {
    (0..p.len())
        .fold(Float::zero(), |sum, i| &sum + &p[i][i])
        .to_f64()
}

/// The largest part, over all directions, by which `found` differs from the covariance `right`: the norm of
/// L⁻¹ (found − right) L⁻ᵀ with L Lᵀ = right. Six digits are right in every direction where it is 10⁻⁶, and
/// below 1 the found one is positive definite.
pub fn relative_error(found: &Belief, right: &Exact) -> f64 {
    let n = right.len();
    let found = covariance(found);
    let mut rest = right.clone();
    let mut error: Exact = (0..n)
        .map(|i| (0..n).map(|j| &found[i][j] - &right[i][j]).collect())
        .collect();
    let mut pivots = Vec::new();
    // Elimination of `right`, the same on the rows and columns of the error.
    for k in 0..n {
        let pivot = rest[k][k].clone();
        assert!(pivot.is_positive(), "the oracle is positive definite");
        for i in k + 1..n {
            let factor = &rest[i][k] / &pivot;
            if factor.is_zero() {
                continue;
            }
            for j in 0..n {
                rest[i][j] = &rest[i][j] - &(&factor * &rest[k][j]);
                error[i][j] = &error[i][j] - &(&factor * &error[k][j]);
            }
            for row in &mut error {
                row[i] = &row[i] - &(&factor * &row[k]);
            }
        }
        pivots.push(pivot);
    }
    let scaled = DMatrix::from_fn(n, n, |i, j| {
        let squared = &(&error[i][j] * &error[i][j]) / &(&pivots[i] * &pivots[j]);
        squared.to_f64().sqrt()
    });
    scaled.norm()
}
