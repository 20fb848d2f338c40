//! Algorithm 1's covariance in fractions of 120 digits: as good as exact, whatever the sigmas.
#![allow(dead_code, reason = "each test file uses a part")]

use adslam_estimator::{Belief, FeatureMeasurement, FilterNoise, PairMeasurement};
use adslam_models::{Control, State, motion_jacobian};
use nalgebra::{DMatrix, DVector};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use crate::common::{covariance_matrix, stacked};

/// A matrix of fractions, row by row.
pub type Exact = Vec<Vec<BigRational>>;

pub fn exact(m: &DMatrix<f64>) -> Exact {
    let fraction = |x: f64| BigRational::from_float(x).expect("finite");
    m.row_iter()
        .map(|row| row.iter().map(|x| fraction(*x)).collect())
        .collect()
}

/// Bits that are kept of each number, more than 120 digits.
const BITS: u64 = 400;

/// The number to [`BITS`] bits: all of them would take more room with every operation.
fn rounded(x: &BigRational) -> BigRational {
    let shift = (BITS + x.denom().bits()).saturating_sub(x.numer().bits());
    let mantissa = (x.numer() << shift) / x.denom();
    BigRational::new(mantissa, BigInt::one() << shift)
}

fn product(a: &Exact, b: &Exact) -> Exact {
    let columns = b.first().map_or(0, Vec::len);
    a.iter()
        .map(|row| {
            (0..columns)
                .map(|j| {
                    let terms = row.iter().zip(b).filter(|(x, _)| !x.is_zero());
                    terms.fold(BigRational::zero(), |sum, (x, other)| sum + x * &other[j])
                })
                .collect()
        })
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
        moved[i][i] += &exact(&DMatrix::from_element(1, 1, q[i] * q[i]))[0][0];
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
) -> (Exact, Vec<BigRational>) {
    let (h, o, y) = stacked(state, features, pairs, noise);
    let (h, o, y) = (
        exact(&h),
        exact(&DMatrix::from_columns(&[o])),
        exact(&DMatrix::from_columns(&[y])),
    );
    let n = p.len();
    let mut p = p.clone();
    let mut delta = vec![BigRational::zero(); n];
    for (row, (o, y)) in h.iter().zip(o.iter().zip(&y)) {
        let dot = |v: &[BigRational]| -> BigRational {
            let terms = row.iter().zip(v).filter(|(h, _)| !h.is_zero());
            terms.fold(BigRational::zero(), |sum, (h, v)| sum + h * v)
        };
        let ph: Vec<BigRational> = p.iter().map(|row| dot(row)).collect();
        let s = dot(&ph) + &o[0];
        let innovation = &y[0] - dot(&delta);
        for i in 0..n {
            let gain = rounded(&(&ph[i] / &s));
            delta[i] = rounded(&(&delta[i] + &gain * &innovation));
            for j in 0..n {
                p[i][j] = rounded(&(&p[i][j] - &gain * &ph[j]));
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
    DMatrix::from_fn(all.len(), all.len(), |i, j| {
        all[i][j].to_f64().expect("a number")
    })
}

pub fn trace(p: &Exact) -> f64 {
    let sum = (0..p.len()).fold(BigRational::zero(), |sum, i| sum + &p[i][i]);
    sum.to_f64().expect("a number")
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
        assert!(
            pivot > BigRational::zero(),
            "the oracle is positive definite"
        );
        for i in k + 1..n {
            let factor = rounded(&(&rest[i][k] / &pivot));
            if factor.is_zero() {
                continue;
            }
            for j in 0..n {
                rest[i][j] = rounded(&(&rest[i][j] - &factor * &rest[k][j]));
                error[i][j] = rounded(&(&error[i][j] - &factor * &error[k][j]));
            }
            for row in &mut error {
                row[i] = rounded(&(&row[i] - &factor * &row[k]));
            }
        }
        pivots.push(pivot);
    }
    let scaled = DMatrix::from_fn(n, n, |i, j| {
        let squared = &error[i][j] * &error[i][j] / (&pivots[i] * &pivots[j]);
        squared.to_f64().expect("a number").sqrt()
    });
    scaled.norm()
}
