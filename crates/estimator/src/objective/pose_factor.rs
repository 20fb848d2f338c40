//! The pose's error as L s with s ~ N(0, I), and the features' part that goes with it.

use adslam_models::POSE_DIM;
use nalgebra::Matrix6;

use crate::Covariance;
use crate::buffer::Buffer;

/// L with LLᵀ = `p`, lower triangular; where `p` is singular the columns without a pivot are zero.
pub(super) fn semidefinite_root(p: &Matrix6<f64>) -> Matrix6<f64> {
    let mut root = Matrix6::zeros();
    let mut rest = *p;
    for k in 0..6 {
        let pivot = rest[(k, k)];
        // What is left of a variance after all of it was explained is rounding.
        if pivot <= 1e-14 * p[(k, k)] {
            continue;
        }
        let column = rest.column(k) / pivot.sqrt();
        for i in k..6 {
            root[(i, k)] = column[i];
        }
        for j in k + 1..6 {
            for i in k + 1..6 {
                rest[(i, j)] -= column[i] * column[j];
            }
        }
    }
    root
}

/// J = P_fr L⁻ᵀ, 3M × 6, with zero columns where L has none.
pub(super) fn set_cross_factor(j: &mut Buffer, covariance: &Covariance, root: &Matrix6<f64>) {
    let size = covariance.dim() - POSE_DIM;
    let p_fr = covariance.matrix().submatrix(POSE_DIM, 0, size, POSE_DIM);
    j.reshape(size, POSE_DIM);
    for k in 0..POSE_DIM {
        for i in 0..size {
            j[(i, k)] = if root[(k, k)] == 0.0 {
                0.0
            } else {
                let explained: f64 = (0..k).map(|l| j[(i, l)] * root[(k, l)]).sum();
                (p_fr[(i, k)] - explained) / root[(k, k)]
            };
        }
    }
}
