//! Conditioning a covariance on measurements, block by block, in memory that is kept.
//!
//! Measurements with independent noise may be taken one after another instead of all at once. With
//! blocks of b rows out of m that costs about n²m + nmb operations, where one joint update with its m × m
//! factorisation costs n²m + nm² + m³/3; and it needs room for n × b numbers only, not n × m.

use adslam_models::POSE_DIM;
use std::ops::Range;

use faer::prelude::ReborrowMut;

use crate::buffer::Buffer;
use crate::linear_algebra::{cholesky, solve_lower, whiten_and_accumulate};
use crate::{Covariance, EstimatorError, Parallelism};

/// Memory for conditioning. It grows to what a step needs and is then used again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Workspace {
    /// P Hᵀ of one block, n × b.
    pub(crate) products: Buffer,
    /// S = H P Hᵀ + O of one block, b × b; the lower triangle counts.
    pub(crate) innovation_covariance: Buffer,
    /// What each carried vector X grows by: X ← X + P Hᵀ S⁻¹ B, b × the number carried. The first
    /// column is the innovation.
    pub(crate) growth: Buffer,
    /// Vectors that change with the covariance, n × their number; the first is the correction δ so
    /// far.
    pub(crate) carried: Buffer,
    /// The pose's part of Hᵀ for a block of features, 6 × b.
    pub(crate) of_pose: Buffer,
    /// Combinations of P's columns, n × their number.
    pub(crate) selection: Buffer,
    /// Columns of P.
    pub(crate) columns: Buffer,
    /// yᵀS⁻¹y of the blocks since [`Self::prepare`].
    nis: f64,
}

impl Workspace {
    /// Room for states of `dim` entries, with `carried` vectors that are all zero.
    pub(crate) fn prepare(&mut self, dim: usize, carried: usize) {
        let block = block_rows(dim);
        // The largest block first, so that no other needs more.
        self.products.reshape(dim, block);
        self.innovation_covariance.reshape(block, block);
        self.of_pose.reshape(POSE_DIM, block);
        self.growth.reshape(block, carried);
        self.carried.reshape(dim, carried);
        self.carried.fill(0.0);
        self.nis = 0.0;
    }

    /// Room for a block of `rows` measured numbers.
    pub(crate) fn start_block(&mut self, rows: usize) {
        self.products.reshape(self.carried.nrows(), rows);
        self.innovation_covariance.reshape(rows, rows);
        self.growth.reshape(rows, self.carried.ncols());
    }

    /// yᵀS⁻¹y of all that was conditioned on since [`Self::prepare`]: each block's innovation is that given
    /// the blocks before it, so their sum is that of all rows together.
    pub(crate) fn nis(&self) -> f64 {
        self.nis
    }

    /// The correction of the whole state, in `delta`.
    pub(crate) fn copy_correction(&self, delta: &mut Vec<f64>) {
        delta.clear();
        delta.extend_from_slice(self.carried.col_as_slice(0));
    }

    /// The correction of one entry of the state.
    pub(crate) fn correction(&self, entry: usize) -> f64 {
        self.carried[(entry, 0)]
    }

    /// Conditions the covariance (its lower triangle) on the block that is laid out here, and moves
    /// the carried vectors along. `name` is what S is called in errors.
    pub(crate) fn condition(
        &mut self,
        covariance: &mut Covariance,
        name: &'static str,
        parallelism: Parallelism,
    ) -> Result<(), EstimatorError> {
        let mut factor = self.innovation_covariance.as_mut();
        cholesky(factor.rb_mut(), name)?;
        solve_lower(factor.as_ref(), self.growth.as_mut());
        let whitened = self.growth.col_as_slice(0);
        self.nis += whitened.iter().map(|y| y * y).sum::<f64>();
        whiten_and_accumulate(
            factor.as_ref(),
            self.products.as_mut(),
            self.growth.as_ref(),
            self.carried.as_mut(),
            parallelism,
        );
        covariance.subtract_gram(self.products.as_ref(), parallelism);
        Ok(())
    }
}

/// b: how many rows of measurements are taken at once, a multiple of three. Wide blocks come nearer to
/// the speed of a matrix product, narrow ones need fewer operations; measured.
pub(crate) fn block_rows(dim: usize) -> usize {
    match dim {
        0..300 => 24,
        300..1000 => 48,
        _ => 192,
    }
}

/// The numbers `all` of what is measured on three axes each, in blocks for a state of `dim` entries.
pub(crate) fn blocks(all: Range<usize>, dim: usize) -> impl Iterator<Item = Range<usize>> {
    let size = block_rows(dim) / 3;
    let end = all.end;
    all.step_by(size)
        .map(move |first| first..end.min(first + size))
}

/// y ← y + a x.
pub(crate) fn add_scaled(y: &mut [f64], a: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += a * x;
    }
}
