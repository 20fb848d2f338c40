//! Room for the factorisation of one visible set, kept from set to set.

use adslam_models::FeatureId;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_inverse::invert_lower_triangular;
use faer::linalg::triangular_solve::solve_upper_triangular_in_place;
use faer::{Accum, Par};
use nalgebra::SMatrix;

use super::shared::{Matrix12, SharedBlocks};
use crate::EstimatorError;
use crate::buffer::Buffer;
use crate::linear_algebra::{cholesky, set_product, solve_lower};

/// The blocks of one set: B and its factor, U and what becomes of it, P̂J, and P̂².
#[derive(Clone, Debug, Default)]
pub(super) struct SetWorkspace {
    /// The first row of each feature among the shared ones.
    places: Vec<usize>,
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
        self.places.clear();
        for &feature in visible {
            self.places.push(3 * shared.place(feature)?);
        }
        for (at, &place) in self.places.iter().enumerate() {
            for axis in 0..3 {
                let (to, from) = (3 * at + axis, place + axis);
                // Of B the factorisation reads the lower triangle only.
                let below = 3 * at;
                let column = &mut self.b.col_as_slice_mut(to)[below..];
                pick(column, shared.b.col_as_slice(from), &self.places[at..]);
                let column = self.squared.col_as_slice_mut(to);
                pick(column, shared.squared.col_as_slice(from), &self.places);
            }
        }
        for j in 0..12 {
            let column = self.x.col_as_slice_mut(j);
            pick(column, shared.u.col_as_slice(j), &self.places);
        }
        for j in 0..6 {
            let column = self.pj.col_as_slice_mut(j);
            pick(column, shared.pj.col_as_slice(j), &self.places);
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

    /// B⁻¹, its lower triangle, from the factor.
    pub(super) fn invert(&mut self) {
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
    }

    /// maxₖ `D_k` `(B⁻¹)_kk` over the set's rows, with D given for all features seen: how far rounding errors of D ε
    /// in B reach.
    pub(super) fn condition(&self, scale: &[f64]) -> f64 {
        let of_feature = |(at, &place): (usize, &usize)| {
            let rows = (0..3).map(|axis| (3 * at + axis, scale[place + axis]));
            rows.map(|(row, scale)| scale * self.inverse[(row, row)])
                .fold(0.0, f64::max)
        };
        let features = self.places.iter().enumerate();
        features.map(of_feature).fold(0.0, f64::max)
    }

    /// Σₖ `(B⁻¹)_kk` `(P̂²)_kk`: what tr(B⁻¹P̂²) is summed from.
    pub(super) fn magnitude_of_inverse_times_squared(&self) -> f64 {
        (0..self.inverse.ncols())
            .map(|k| self.inverse[(k, k)] * self.squared[(k, k)])
            .sum()
    }

    /// Adds |X|ᵀd, d² the diagonal of P̂²: no entry of the terms of XᵀP̂²X is larger than what that squared has.
    pub(super) fn add_sizes(&self, sizes: &mut [f64; 12]) {
        for (column, size) in sizes.iter_mut().enumerate() {
            for (k, x) in self.x.col_as_slice(column).iter().enumerate() {
                *size += x.abs() * self.squared[(k, k)].sqrt();
            }
        }
    }

    /// tr(B⁻¹P̂²), after [`Self::invert`].
    pub(super) fn trace_of_inverse_times_squared(&self) -> f64 {
        (0..self.inverse.ncols())
            .map(|j| {
                let inverse = &self.inverse.col_as_slice(j)[j..];
                let squared = &self.squared.col_as_slice(j)[j..];
                2.0 * dot(inverse, squared) - inverse[0] * squared[0]
            })
            .sum()
    }
}

/// Copies three rows from each of the places, one after the other.
fn pick(to: &mut [f64], from: &[f64], places: &[usize]) {
    for (to, &place) in to.chunks_exact_mut(3).zip(places) {
        to.copy_from_slice(&from[place..place + 3]);
    }
}

/// aᵀb, in several sums at once.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (a, a_rest) = a.as_chunks::<LANES>();
    let (b, b_rest) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}
