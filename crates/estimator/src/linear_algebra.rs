//! The few dense factorisations and products that the filter is made of, on faer.
//!
//! faer's kernels run on one thread each; large work is cut into tiles whose borders depend on its
//! size alone and [`Parallelism`] says who does them. None of it allocates.

use std::mem::MaybeUninit;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};

use crate::{EstimatorError, Parallelism};

/// Scratch bytes that are taken from the stack: enough for factors of 4000 rows.
const STACK_SCRATCH: usize = 32 << 10;

/// The side of the tiles that products with a large symmetric matrix are cut into.
const TILE: usize = 512;

/// Rows of a tall matrix that are worked on at once.
const STRIP: usize = 192;

/// faer's widest kernel works on this many rows; a cut elsewhere leaves it slower remainders.
const KERNEL_ROWS: usize = 48;

/// The side of the tiles of a transposition: two of them fit the first cache.
const TRANSPOSED_TILE: usize = 32;

/// Numbers in a cache line.
const CACHE_LINE: usize = 8;

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
    let needed = cholesky_in_place_scratch::<f64>(dim, Par::Seq, Default::default());
    let mut on_stack = [const { MaybeUninit::uninit() }; STACK_SCRATCH];
    let mut on_heap;
    let scratch = if needed.unaligned_bytes_required() <= STACK_SCRATCH {
        MemStack::new(&mut on_stack)
    } else {
        on_heap = MemBuffer::new(needed);
        MemStack::new(&mut on_heap)
    };
    cholesky_in_place(
        matrix.rb_mut(),
        Default::default(),
        Par::Seq,
        scratch,
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

/// V = W L⁻ᵀ in place of W, and `sum` ← `sum` + V B.
pub(crate) fn whiten_and_accumulate(
    factor: MatRef<'_, f64>,
    mut w: MatMut<'_, f64>,
    b: MatRef<'_, f64>,
    mut sum: MatMut<'_, f64>,
    parallelism: Parallelism,
) {
    if let Some(middle) = split(w.nrows(), STRIP, KERNEL_ROWS) {
        let (w_top, w_bottom) = w.split_at_row_mut(middle);
        let (sum_top, sum_bottom) = sum.split_at_row_mut(middle);
        parallelism.join(
            || whiten_and_accumulate(factor, w_top, b, sum_top, parallelism),
            || whiten_and_accumulate(factor, w_bottom, b, sum_bottom, parallelism),
        );
        return;
    }
    solve_lower(factor, w.rb_mut().transpose_mut());
    matmul(sum.rb_mut(), Accum::Add, w.rb(), b, 1.0, Par::Seq);
}

/// The lower triangle of P ← P + α A Bᵀ, where that is symmetric; the upper one is left as it is.
pub(crate) fn add_product_lower(
    p: MatMut<'_, f64>,
    alpha: f64,
    a: MatRef<'_, f64>,
    b: MatRef<'_, f64>,
    parallelism: Parallelism,
) {
    let Some(middle) = split(p.nrows(), TILE, KERNEL_ROWS) else {
        triangular::matmul(
            p,
            BlockStructure::TriangularLower,
            Accum::Add,
            a,
            BlockStructure::Rectangular,
            b.transpose(),
            BlockStructure::Rectangular,
            alpha,
            Par::Seq,
        );
        return;
    };
    let (top_left, _, bottom_left, bottom_right) = p.split_at_mut(middle, middle);
    let (a_top, a_bottom) = a.split_at_row(middle);
    let (b_top, b_bottom) = b.split_at_row(middle);
    parallelism.join(
        || add_product(bottom_left, alpha, a_bottom, b_top, parallelism),
        || {
            parallelism.join(
                || add_product_lower(top_left, alpha, a_top, b_top, parallelism),
                || add_product_lower(bottom_right, alpha, a_bottom, b_bottom, parallelism),
            );
        },
    );
}

/// M ← A B.
pub(crate) fn set_product(m: MatMut<'_, f64>, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    matmul(m, Accum::Replace, a, b, 1.0, Par::Seq);
}

/// M ← Aᵀ A.
pub(crate) fn set_gram(mut m: MatMut<'_, f64>, a: MatRef<'_, f64>) {
    triangular::matmul(
        m.rb_mut(),
        BlockStructure::TriangularLower,
        Accum::Replace,
        a.transpose(),
        BlockStructure::Rectangular,
        a,
        BlockStructure::Rectangular,
        1.0,
        Par::Seq,
    );
    mirror_lower(m, Parallelism::Sequential);
}

/// M ← M + α A Bᵀ.
pub(crate) fn add_product(
    m: MatMut<'_, f64>,
    alpha: f64,
    a: MatRef<'_, f64>,
    b: MatRef<'_, f64>,
    parallelism: Parallelism,
) {
    if let Some(middle) = split(m.nrows(), TILE, KERNEL_ROWS) {
        let (top, bottom) = m.split_at_row_mut(middle);
        let (a_top, a_bottom) = a.split_at_row(middle);
        parallelism.join(
            || add_product(top, alpha, a_top, b, parallelism),
            || add_product(bottom, alpha, a_bottom, b, parallelism),
        );
    } else if let Some(middle) = split(m.ncols(), TILE, KERNEL_ROWS) {
        let (left, right) = m.split_at_col_mut(middle);
        let (b_left, b_right) = b.split_at_row(middle);
        parallelism.join(
            || add_product(left, alpha, a, b_left, parallelism),
            || add_product(right, alpha, a, b_right, parallelism),
        );
    } else {
        matmul(m, Accum::Add, a, b.transpose(), alpha, Par::Seq);
    }
}

/// Y ← P X, P symmetric and given by its lower triangle.
pub(crate) fn symmetric_times(
    p: MatRef<'_, f64>,
    x: MatRef<'_, f64>,
    mut y: MatMut<'_, f64>,
    parallelism: Parallelism,
) {
    if let Some(middle) = split(p.nrows(), TILE, KERNEL_ROWS) {
        let (top_left, _, corner, bottom_right) = p.split_at(middle, middle);
        let (x_top, x_bottom) = x.split_at_row(middle);
        let (mut y_top, mut y_bottom) = y.split_at_row_mut(middle);
        parallelism.join(
            || {
                symmetric_times(top_left, x_top, y_top.rb_mut(), parallelism);
                matmul(
                    y_top,
                    Accum::Add,
                    corner.transpose(),
                    x_bottom,
                    1.0,
                    Par::Seq,
                );
            },
            || {
                symmetric_times(bottom_right, x_bottom, y_bottom.rb_mut(), parallelism);
                matmul(y_bottom, Accum::Add, corner, x_top, 1.0, Par::Seq);
            },
        );
        return;
    }
    let parts = [
        (p, BlockStructure::TriangularLower, Accum::Replace),
        (
            p.transpose(),
            BlockStructure::StrictTriangularUpper,
            Accum::Add,
        ),
    ];
    for (p, structure, accum) in parts {
        triangular::matmul(
            y.rb_mut(),
            BlockStructure::Rectangular,
            accum,
            p,
            structure,
            x,
            BlockStructure::Rectangular,
            1.0,
            Par::Seq,
        );
    }
}

/// Copies the lower triangle onto the upper one.
pub(crate) fn mirror_lower(p: MatMut<'_, f64>, parallelism: Parallelism) {
    let Some(middle) = split(p.nrows(), TRANSPOSED_TILE, CACHE_LINE) else {
        let mut p = p;
        for j in 0..p.ncols() {
            for i in 0..j {
                p[(i, j)] = p[(j, i)];
            }
        }
        return;
    };
    let parallelism = parallelism.for_dim(p.nrows());
    let (top_left, top_right, bottom_left, bottom_right) = p.split_at_mut(middle, middle);
    parallelism.join(
        || copy_transposed(top_right, bottom_left.rb(), parallelism),
        || {
            parallelism.join(
                || mirror_lower(top_left, parallelism),
                || mirror_lower(bottom_right, parallelism),
            );
        },
    );
}

/// M ← Aᵀ, tile by tile.
pub(crate) fn copy_transposed(
    mut m: MatMut<'_, f64>,
    a: MatRef<'_, f64>,
    parallelism: Parallelism,
) {
    let parallelism = parallelism.for_dim(m.nrows() + m.ncols());
    let (by_rows, by_columns) = (
        split(m.nrows(), TRANSPOSED_TILE, CACHE_LINE),
        split(m.ncols(), TRANSPOSED_TILE, CACHE_LINE),
    );
    match (by_rows, by_columns) {
        (Some(middle), _) if m.nrows() >= m.ncols() => {
            let (top, bottom) = m.split_at_row_mut(middle);
            let (left, right) = a.split_at_col(middle);
            parallelism.join(
                || copy_transposed(top, left, parallelism),
                || copy_transposed(bottom, right, parallelism),
            );
        }
        (_, Some(middle)) => {
            let (left, right) = m.split_at_col_mut(middle);
            let (top, bottom) = a.split_at_row(middle);
            parallelism.join(
                || copy_transposed(left, top, parallelism),
                || copy_transposed(right, bottom, parallelism),
            );
        }
        _ => m.copy_from(a.transpose()),
    }
}

/// Where to cut `len` in two, at a multiple of `unit`, to come to pieces of at most `limit`; nothing
/// where it is one piece.
fn split(len: usize, limit: usize, unit: usize) -> Option<usize> {
    (len > limit).then(|| (len / 2).next_multiple_of(unit))
}

/// Sum of the squares of all entries.
pub(crate) fn squared_norm(m: MatRef<'_, f64>) -> f64 {
    m.col_iter()
        .map(|column| column.iter().map(|x| x * x).sum::<f64>())
        .sum()
}
