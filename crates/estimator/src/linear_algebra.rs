//! The few dense factorisations and products that the filter is made of, on faer, in one thread: a
//! single thread is fastest at these sizes, and runs are spread over the cores instead.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::prelude::ReborrowMut;
use faer::{Accum, Mat, MatMut, MatRef, Par};

use crate::EstimatorError;

/// Replaces the lower triangle of a symmetric matrix, of which only that triangle is read, by its
/// Cholesky factor L.
///
/// # Errors
/// [`EstimatorError::NotPositiveDefinite`] with the name given.
pub(crate) fn cholesky(
    mut matrix: MatMut<'_, f64>,
    name: &'static str,
) -> Result<(), EstimatorError> {
    let dim = matrix.nrows();
    let broken = EstimatorError::NotPositiveDefinite { matrix: name, dim };
    let mut buffer = MemBuffer::new(cholesky_in_place_scratch::<f64>(
        dim,
        Par::Seq,
        Default::default(),
    ));
    cholesky_in_place(
        matrix.rb_mut(),
        Default::default(),
        Par::Seq,
        MemStack::new(&mut buffer),
        Default::default(),
    )
    .map_err(|_| broken.clone())?;
    // A factorisation may let NaN through; its diagonal shows it.
    let diagonal_good = (0..dim).all(|i| matrix[(i, i)].is_finite() && matrix[(i, i)] > 0.0);
    if diagonal_good { Ok(()) } else { Err(broken) }
}

/// L⁻¹ B in place, L the lower triangle of `factor`.
pub(crate) fn solve_lower(factor: MatRef<'_, f64>, rhs: MatMut<'_, f64>) {
    solve_lower_triangular_in_place(factor, rhs, Par::Seq);
}

/// P ← P − WᵀW, kept exactly symmetric.
pub(crate) fn subtract_gram(p: &mut Mat<f64>, w: MatRef<'_, f64>) {
    triangular::matmul(
        p.as_mut(),
        BlockStructure::TriangularLower,
        Accum::Add,
        w.transpose(),
        BlockStructure::Rectangular,
        w,
        BlockStructure::Rectangular,
        -1.0,
        Par::Seq,
    );
    mirror_lower(p);
}

/// Copies the lower triangle onto the upper one.
pub(crate) fn mirror_lower(p: &mut Mat<f64>) {
    for j in 0..p.ncols() {
        for i in 0..j {
            p[(i, j)] = p[(j, i)];
        }
    }
}

/// Sum of the squares of all entries.
pub(crate) fn squared_norm(m: MatRef<'_, f64>) -> f64 {
    m.col_iter()
        .map(|column| column.iter().map(|x| x * x).sum::<f64>())
        .sum()
}
