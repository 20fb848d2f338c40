//! Room for the factorisation of one visible set, kept from set to set.

use adslam_models::FeatureId;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_inverse::invert_lower_triangular;
use faer::linalg::triangular_solve::solve_upper_triangular_in_place;
use faer::{Accum, Par};
use nalgebra::SMatrix;

use super::group::{Matrix12, SharedBlocks};
use crate::EstimatorError;
use crate::buffer::Buffer;
use crate::linear_algebra::{cholesky, set_product, solve_lower};

/// The blocks of one set: B and its factor, U and what becomes of it, P̂J, and P̂².
#[derive(Clone, Debug, Default)]
pub(super) struct SetWorkspace {
    /// B, then L.
    b: Buffer,
    /// U, then L⁻¹U, then X = B⁻¹U.
    x: Buffer,
    pj: Buffer,
    squared: Buffer,
    inverse_factor: Buffer,
    inverse: Buffer,
    squared_x: Buffer,
    small: Buffer,
}

impl SetWorkspace {
    /// Copies the set's blocks out of the shared ones.
    pub(super) fn gather(
        &mut self,
        shared: &SharedBlocks,
        visible: &[FeatureId],
    ) -> Result<(), EstimatorError> {
        let rows = 3 * visible.len();
        for square in [
            &mut self.b,
            &mut self.squared,
            &mut self.inverse_factor,
            &mut self.inverse,
        ] {
            square.reshape(rows, rows);
        }
        self.x.reshape(rows, 12);
        self.squared_x.reshape(rows, 12);
        self.pj.reshape(rows, 6);
        self.small.reshape(12, 12);
        for (column, &to) in visible.iter().enumerate() {
            let to = 3 * shared.place(to)?;
            for (row, &from) in visible.iter().enumerate() {
                let from = 3 * shared.place(from)?;
                for b in 0..3 {
                    for a in 0..3 {
                        let (i, j) = (3 * row + a, 3 * column + b);
                        self.b[(i, j)] = shared.b[(from + a, to + b)];
                        self.squared[(i, j)] = shared.squared[(from + a, to + b)];
                    }
                }
            }
        }
        for (row, &from) in visible.iter().enumerate() {
            let from = 3 * shared.place(from)?;
            for a in 0..3 {
                for j in 0..12 {
                    self.x[(3 * row + a, j)] = shared.u[(from + a, j)];
                }
                for j in 0..6 {
                    self.pj[(3 * row + a, j)] = shared.pj[(from + a, j)];
                }
            }
        }
        Ok(())
    }

    /// L and L⁻¹U.
    pub(super) fn factorise(&mut self) -> Result<(), EstimatorError> {
        cholesky(
            self.b.as_mut(),
            "innovation covariance of the feature measurements",
        )?;
        solve_lower(self.b.as_ref(), self.x.as_mut());
        Ok(())
    }

    /// (L⁻¹U)ᵀ(L⁻¹U), before [`Self::finish_solve`].
    pub(super) fn gram_of_whitened(&mut self) -> Matrix12 {
        let small = self.small.as_mut();
        set_product(small, self.x.transpose(), self.x.as_ref());
        SMatrix::from_fn(|i, j| self.small[(i, j)])
    }

    /// X = L⁻ᵀ(L⁻¹U).
    pub(super) fn finish_solve(&mut self) {
        solve_upper_triangular_in_place(self.b.transpose(), self.x.as_mut(), Par::Seq);
    }

    /// (P̂J)ᵀX.
    pub(super) fn pj_times_x(&mut self) -> SMatrix<f64, 6, 12> {
        let small = self.small.as_mut().subrows_mut(0, 6);
        set_product(small, self.pj.transpose(), self.x.as_ref());
        SMatrix::from_fn(|i, j| self.small[(i, j)])
    }

    /// XᵀP̂²X.
    pub(super) fn squared_between_x(&mut self) -> Matrix12 {
        let product = self.squared_x.as_mut();
        set_product(product, self.squared.as_ref(), self.x.as_ref());
        let small = self.small.as_mut();
        set_product(small, self.x.transpose(), self.squared_x.as_ref());
        SMatrix::from_fn(|i, j| self.small[(i, j)])
    }

    /// tr(B⁻¹P̂²).
    pub(super) fn trace_of_inverse_times_squared(&mut self) -> f64 {
        invert_lower_triangular(self.inverse_factor.as_mut(), self.b.as_ref(), Par::Seq);
        triangular::matmul(
            self.inverse.as_mut(),
            BlockStructure::TriangularLower,
            Accum::Replace,
            self.inverse_factor.transpose(),
            BlockStructure::TriangularUpper,
            self.inverse_factor.as_ref(),
            BlockStructure::TriangularLower,
            1.0,
            Par::Seq,
        );
        let mut below = 0.0;
        let mut diagonal = 0.0;
        for j in 0..self.inverse.ncols() {
            diagonal += self.inverse[(j, j)] * self.squared[(j, j)];
            let column = self
                .inverse
                .col(j)
                .subrows(j + 1, self.inverse.nrows() - j - 1);
            let other = self
                .squared
                .col(j)
                .subrows(j + 1, self.inverse.nrows() - j - 1);
            below += column
                .iter()
                .zip(other.iter())
                .map(|(a, b)| a * b)
                .sum::<f64>();
        }
        diagonal + 2.0 * below
    }
}
