//! The strong rival of the filter's structure update: all contrasts at once, S = σ²/M + Π P Π on the
//! features, V = L⁻¹ Π P, P ← P − VᵀV, with faer's factorisation, solve and symmetric product. Algorithm 1
//! with the pairs collapsed, but not taken block by block: n²m + nm² + m³/3 operations, m = 3M.

use adslam_estimator::Covariance;
use adslam_models::POSE_DIM;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, Mat, Par, Side};

/// The whole covariance as faer has it.
pub fn matrix(covariance: &Covariance) -> Mat<f64> {
    let n = covariance.dim();
    Mat::from_fn(n, n, |i, j| covariance.entry(i, j))
}

/// Takes the mean over the features off each column, axis by axis.
fn centre(m: &mut Mat<f64>) {
    let share = 3.0 / m.nrows() as f64;
    for j in 0..m.ncols() {
        let column = m.col_as_slice_mut(j);
        let mut mean = [0.0; 3];
        for (i, x) in column.iter().enumerate() {
            mean[i % 3] += x * share;
        }
        for (i, x) in column.iter_mut().enumerate() {
            *x -= mean[i % 3];
        }
    }
}

/// P after all pairs are measured; `None` where P is no covariance.
pub fn update(p: &mut Mat<f64>, sigma: f64) -> Option<()> {
    let features = p.nrows() - POSE_DIM;
    let mut v = p.subrows(POSE_DIM, features).to_owned();
    centre(&mut v);
    let mut s = v.subcols(POSE_DIM, features).transpose().to_owned();
    centre(&mut s);
    for i in 0..features {
        s[(i, i)] += 3.0 * sigma * sigma / features as f64;
    }
    let factor = s.llt(Side::Lower).ok()?;
    solve_lower_triangular_in_place(factor.L(), v.as_mut(), Par::Seq);
    triangular::matmul(
        p.as_mut(),
        BlockStructure::TriangularLower,
        Accum::Add,
        v.transpose(),
        BlockStructure::Rectangular,
        v.as_ref(),
        BlockStructure::Rectangular,
        -1.0,
        Par::Seq,
    );
    for j in 0..p.ncols() {
        for i in 0..j {
            p[(i, j)] = p[(j, i)];
        }
    }
    Some(())
}
