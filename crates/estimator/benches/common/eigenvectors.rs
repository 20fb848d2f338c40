//! What the filter did with measured pairs before the elimination, on one thread: the eigenvectors u of the Laplacian
//! of their graph with an eigenvalue λ above zero are the rows of H, each axis of each with noise of variance σ²/λ;
//! Hᵀ written out, P Hᵀ, S, V = P Hᵀ L⁻ᵀ, P ← P − VVᵀ, mirrored. The correction of the state, n numbers, is
//! left out.

use adslam_models::POSE_DIM;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, Mat, Par, Side};

/// Eigenvalues of a Laplacian are zero or at least about 1/M².
const ZERO_EIGENVALUE: f64 = 1e-10;

/// P after the pairs of the graph are measured; nothing where P is no covariance.
pub fn update(p: &mut Mat<f64>, laplacian: &Mat<f64>, sigma: f64) -> Option<()> {
    let eigen = laplacian.self_adjoint_eigen(Side::Lower).ok()?;
    let (values, vectors) = (eigen.S().column_vector(), eigen.U());
    let kept: Vec<usize> = (0..laplacian.nrows())
        .filter(|&k| values[k] > ZERO_EIGENVALUE)
        .collect();
    let mut rows = Mat::<f64>::zeros(p.nrows(), 3 * kept.len());
    for (column, &k) in kept.iter().enumerate() {
        for i in 0..laplacian.nrows() {
            for axis in 0..3 {
                rows[(POSE_DIM + 3 * i + axis, 3 * column + axis)] = vectors[(i, k)];
            }
        }
    }
    let products = &*p * &rows;
    let mut s = rows.transpose() * &products;
    for (column, &k) in kept.iter().enumerate() {
        for axis in 0..3 {
            s[(3 * column + axis, 3 * column + axis)] += sigma * sigma / values[k];
        }
    }
    let factor = s.llt(Side::Lower).ok()?;
    let mut v = products.transpose().to_owned();
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
    mirror(p);
    Some(())
}

/// The lower triangle to the upper, in tiles that stay in the cache, as the filter does it.
fn mirror(p: &mut Mat<f64>) {
    const TILE: usize = 32;
    let n = p.nrows();
    for left in (0..n).step_by(TILE) {
        for top in (left..n).step_by(TILE) {
            for j in left..n.min(left + TILE) {
                for i in top.max(j + 1)..n.min(top + TILE) {
                    p[(j, i)] = p[(i, j)];
                }
            }
        }
    }
}
