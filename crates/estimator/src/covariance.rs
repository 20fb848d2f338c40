//! The joint covariance: the one place where it changes.

use std::ops::Range;

use adslam_models::{FeatureId, MotionJacobian, POSE_DIM, feature_offset, state_dim};
use faer::{Mat, MatMut, MatRef};
use nalgebra::{Matrix3, Matrix6};

use crate::buffer::Buffer;
use crate::linear_algebra::{
    add_product_lower, cholesky, copy_transposed, mirror_lower, solve_lower, squared_norm,
    symmetric_times,
};
use crate::{EstimatorError, FilterNoise, Parallelism};

/// P, the n × n covariance of the state's error (angles by difference, positions by difference, in
/// the world), in rad², rad·cm and cm². Exactly symmetric outside an update.
#[derive(Clone, Debug)]
pub struct Covariance {
    matrix: Mat<f64>,
}

impl Covariance {
    /// Of nothing: room for another's values.
    pub(crate) fn empty() -> Self {
        Self { matrix: Mat::new() }
    }

    /// Independent blocks: the pose's, and `feature_sigma`² I for each of `feature_count` features.
    pub(crate) fn initial(pose: &Matrix6<f64>, feature_sigma: f64, feature_count: usize) -> Self {
        let mut matrix = Mat::zeros(state_dim(feature_count), state_dim(feature_count));
        for j in 0..POSE_DIM {
            for i in j..POSE_DIM {
                // A pose covariance that is symmetric but for rounding is taken as symmetric.
                matrix[(i, j)] = 0.5 * (pose[(i, j)] + pose[(j, i)]);
            }
        }
        for i in POSE_DIM..matrix.nrows() {
            matrix[(i, i)] = feature_sigma * feature_sigma;
        }
        mirror_lower(matrix.as_mut(), Parallelism::Sequential);
        Self { matrix }
    }

    /// The n × n covariance with the given entries; of those only the lower triangle (i ≥ j) is
    /// asked for. The caller answers for its being positive semidefinite.
    #[must_use]
    pub fn from_lower(dim: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut matrix = Mat::from_fn(dim, dim, |i, j| if i >= j { entry(i, j) } else { 0.0 });
        mirror_lower(matrix.as_mut(), Parallelism::Sequential);
        Self { matrix }
    }

    /// n = 6 + 3M.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.matrix.nrows()
    }

    /// The number of features M.
    #[must_use]
    pub fn feature_count(&self) -> usize {
        self.dim().saturating_sub(POSE_DIM) / 3
    }

    /// One entry.
    ///
    /// # Panics
    /// If an index is not below [`Self::dim`].
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        self.matrix[(row, column)]
    }

    /// Copies all entries, row by row, into `entries`.
    ///
    /// # Errors
    /// Unless there is room for n² entries, no more and no less.
    pub fn copy_to(&self, entries: &mut [f64]) -> Result<(), EstimatorError> {
        let n = self.dim();
        if entries.len() != n * n {
            return Err(EstimatorError::SliceLength {
                found: entries.len(),
                entries: n * n,
            });
        }
        for (row, entries) in entries.chunks_exact_mut(n.max(1)).enumerate() {
            for (column, entry) in entries.iter_mut().enumerate() {
                *entry = self.matrix[(row, column)];
            }
        }
        Ok(())
    }

    /// Covariance of the pose in the order (roll, pitch, yaw, x, y, z).
    #[must_use]
    pub fn pose(&self) -> Matrix6<f64> {
        // The lower triangle is right at all times, also between the parts of an update.
        Matrix6::from_fn(|i, j| self.matrix[(i.max(j), i.min(j))])
    }

    /// Covariance of one feature, cm².
    ///
    /// # Panics
    /// If the state has no such feature.
    #[must_use]
    pub fn feature(&self, feature: FeatureId) -> Matrix3<f64> {
        let offset = feature_offset(feature);
        Matrix3::from_fn(|i, j| self.matrix[(offset + i, offset + j)])
    }

    /// All variances, in the order of the state.
    #[must_use]
    pub fn variances(&self) -> Vec<f64> {
        (0..self.dim()).map(|i| self.matrix[(i, i)]).collect()
    }

    /// The largest variance of the features with these numbers, cm².
    pub(crate) fn largest_feature_variance(&self, features: Range<usize>) -> f64 {
        let entries = POSE_DIM + 3 * features.start..POSE_DIM + 3 * features.end;
        entries.map(|i| self.matrix[(i, i)]).fold(0.0, f64::max)
    }

    /// The sum of the variances: the planner's objective, eq. (6).
    #[must_use]
    pub fn trace(&self) -> f64 {
        (0..self.dim()).map(|i| self.matrix[(i, i)]).sum()
    }

    /// Whether a Cholesky factor exists.
    #[must_use]
    pub fn is_positive_definite(&self) -> bool {
        let mut factor = self.matrix.clone();
        cholesky(factor.as_mut(), "covariance").is_ok()
    }

    /// eᵀP⁻¹e, the normalised squared error (NEES) of the whole state.
    ///
    /// # Errors
    /// If `error` has the wrong length or the covariance is not positive definite.
    pub fn mahalanobis_squared(&self, error: &[f64]) -> Result<f64, EstimatorError> {
        if error.len() != self.dim() {
            return Err(EstimatorError::WrongCount {
                what: "the error vector",
                found: error.len().saturating_sub(POSE_DIM) / 3,
                expected: self.feature_count(),
            });
        }
        let mut factor = self.matrix.clone();
        cholesky(factor.as_mut(), "covariance")?;
        let mut whitened = Mat::from_fn(error.len(), 1, |i, _| error[i]);
        solve_lower(factor.as_ref(), whitened.as_mut());
        Ok(squared_norm(whitened.as_ref()))
    }

    /// The whole matrix.
    pub(crate) fn matrix(&self) -> MatRef<'_, f64> {
        self.matrix.as_ref()
    }

    /// P − V Vᵀ with V = P Hᵀ L⁻ᵀ and L Lᵀ = S: the update of Algorithm 1 with K = P Hᵀ S⁻¹, on the lower
    /// triangle alone. [`Self::complete`] must follow, after any number of these.
    pub(crate) fn subtract_gram(&mut self, v: MatRef<'_, f64>, parallelism: Parallelism) {
        add_product_lower(self.matrix.as_mut(), -1.0, v, v, parallelism);
    }

    /// D P Dᵀ on the lower triangle, where D − I has only columns of Θ, given as blocks: see
    /// [`ErrorState::reset`](crate::ErrorState::reset). [`Self::complete`] must follow.
    pub(crate) fn reset(
        &mut self,
        blocks: &[Matrix3<f64>],
        [left, right]: [&mut Buffer; 2],
        parallelism: Parallelism,
    ) {
        // With U = D − I, V = P_:Θ and W = V + U P_ΘΘ/2 that is P + U Wᵀ + W Uᵀ.
        let dim = self.dim();
        let of_angles = self.pose().fixed_view::<3, 3>(0, 0).into_owned();
        left.reshape(dim, 6);
        right.reshape(dim, 6);
        self.copy_columns(0, right.subcols_mut(0, 3), Parallelism::Sequential);
        for (k, u) in blocks.iter().enumerate() {
            let half = u * of_angles * 0.5;
            for i in 0..3 {
                for j in 0..3 {
                    let (row, w) = (3 * k + i, right[(3 * k + i, j)] + half[(i, j)]);
                    left[(row, j)] = u[(i, j)];
                    left[(row, 3 + j)] = w;
                    right[(row, j)] = w;
                    right[(row, 3 + j)] = u[(i, j)];
                }
            }
        }
        add_product_lower(
            self.matrix.as_mut(),
            1.0,
            left.as_ref(),
            right.as_ref(),
            parallelism,
        );
    }

    /// Makes the matrix symmetric again after its lower triangle changed.
    ///
    /// # Errors
    /// [`EstimatorError::BadVariance`] where the result has no meaning as a covariance.
    pub(crate) fn complete(&mut self, parallelism: Parallelism) -> Result<(), EstimatorError> {
        mirror_lower(self.matrix.as_mut(), parallelism);
        self.check_variances()
    }

    /// Each variance must be finite and not negative.
    pub(crate) fn check_variances(&self) -> Result<(), EstimatorError> {
        for index in 0..self.dim() {
            let value = self.matrix[(index, index)];
            if !(value.is_finite() && value >= 0.0) {
                return Err(EstimatorError::BadVariance { index, value });
            }
        }
        Ok(())
    }

    /// Y ← P X, from the lower triangle.
    pub(crate) fn times(&self, x: MatRef<'_, f64>, y: MatMut<'_, f64>, parallelism: Parallelism) {
        symmetric_times(self.matrix.as_ref(), x, y, parallelism);
    }

    /// Takes over another covariance's lower triangle in memory that is kept.
    pub(crate) fn copy_lower(&mut self, other: &Self) {
        self.matrix
            .resize_with(other.dim(), other.dim(), |_, _| 0.0);
        for column in 0..other.dim() {
            let from = &other.matrix.col_as_slice(column)[column..];
            self.matrix.col_as_slice_mut(column)[column..].copy_from_slice(from);
        }
    }

    /// Copies whole columns, `first` and those after it, as many as `columns` has, out of the lower
    /// triangle.
    pub(crate) fn copy_columns(
        &self,
        first: usize,
        columns: MatMut<'_, f64>,
        parallelism: Parallelism,
    ) {
        let (dim, width) = (self.dim(), columns.ncols());
        let end = first + width;
        let (above, rest) = columns.split_at_row_mut(first);
        let (mut diagonal, mut below) = rest.split_at_row_mut(width);
        copy_transposed(
            above,
            self.matrix.submatrix(first, 0, width, first),
            parallelism,
        );
        diagonal.copy_from_triangular_lower(self.matrix.submatrix(first, first, width, width));
        mirror_lower(diagonal, Parallelism::Sequential);
        below.copy_from(self.matrix.submatrix(end, first, dim - end, width));
    }

    /// F P Fᵀ + Q, F = diag(`pose_jacobian`, I): the propagation of Algorithm 1. Only the pose's
    /// rows and columns are multiplied.
    pub(crate) fn propagate(&mut self, pose_jacobian: &MotionJacobian, noise: &FilterNoise) {
        let pose = pose_jacobian * self.pose() * pose_jacobian.transpose();
        for i in POSE_DIM..self.dim() {
            let row = nalgebra::Vector6::from_fn(|k, _| self.matrix[(i, k)]);
            let moved = pose_jacobian * row;
            for k in 0..POSE_DIM {
                self.matrix[(i, k)] = moved[k];
                self.matrix[(k, i)] = moved[k];
            }
            self.matrix[(i, i)] += noise.feature_motion_sigma * noise.feature_motion_sigma;
        }
        for j in 0..POSE_DIM {
            for i in j..POSE_DIM {
                self.matrix[(i, j)] = pose[(i, j)];
                self.matrix[(j, i)] = pose[(i, j)];
            }
            let sigma = if j < 3 {
                noise.rotation_sigma
            } else {
                noise.translation_sigma
            };
            self.matrix[(j, j)] += sigma * sigma;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_copied_row_by_row() {
        let covariance = Covariance::from_lower(9, |i, j| (10 * i + j) as f64);
        let mut entries = vec![f64::NAN; 81];
        covariance.copy_to(&mut entries).unwrap();
        assert_eq!(&entries[..3], &[0.0, 10.0, 20.0], "it is symmetric");
        assert_eq!((entries[9 * 8 + 2], entries[9 * 2 + 8]), (82.0, 82.0));
        let error = covariance
            .copy_to(&mut entries[..80])
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("81 entries") && error.contains("slice of 80"),
            "{error}"
        );
    }
}
