//! The joint covariance: the one place where it changes.

use adslam_models::{FeatureId, MotionJacobian, POSE_DIM, feature_offset, state_dim};
use faer::{Mat, MatRef};
use nalgebra::{Matrix3, Matrix6};

use crate::linear_algebra::{cholesky, mirror_lower, solve_lower, subtract_gram};
use crate::{EstimatorError, FilterNoise};

/// P, the n × n covariance of the state's error (angles by difference, positions by difference, in
/// the world), in rad², rad·cm and cm². Exactly symmetric at all times.
#[derive(Clone, Debug)]
pub struct Covariance {
    matrix: Mat<f64>,
}

impl Covariance {
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
        mirror_lower(&mut matrix);
        Self { matrix }
    }

    /// The n × n covariance with the given entries; of those only the lower triangle (i ≥ j) is
    /// asked for. The caller answers for its being positive semidefinite.
    #[must_use]
    pub fn from_lower(dim: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut matrix = Mat::from_fn(dim, dim, |i, j| if i >= j { entry(i, j) } else { 0.0 });
        mirror_lower(&mut matrix);
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
        (self.dim() - POSE_DIM) / 3
    }

    /// One entry.
    ///
    /// # Panics
    /// If an index is not below [`Self::dim`].
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        self.matrix[(row, column)]
    }

    /// Covariance of the pose in the order (roll, pitch, yaw, x, y, z).
    #[must_use]
    pub fn pose(&self) -> Matrix6<f64> {
        Matrix6::from_fn(|i, j| self.matrix[(i, j)])
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
        Ok(crate::linear_algebra::squared_norm(whitened.as_ref()))
    }

    /// The whole matrix.
    pub(crate) fn matrix(&self) -> MatRef<'_, f64> {
        self.matrix.as_ref()
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
            }
        }
        for j in 0..POSE_DIM {
            for i in j..POSE_DIM {
                self.matrix[(i, j)] = pose[(i, j)];
            }
            let sigma = if j < 3 {
                noise.rotation_sigma
            } else {
                noise.translation_sigma
            };
            self.matrix[(j, j)] += sigma * sigma;
        }
        for i in POSE_DIM..self.dim() {
            self.matrix[(i, i)] += noise.feature_motion_sigma * noise.feature_motion_sigma;
        }
        mirror_lower(&mut self.matrix);
    }

    /// P − WᵀW, W = L⁻¹HP with LLᵀ = S: the update of Algorithm 1 with K = PHᵀS⁻¹.
    ///
    /// # Errors
    /// [`EstimatorError::BadVariance`] where the result has no meaning as a covariance.
    pub(crate) fn reduce_by(&mut self, whitened: MatRef<'_, f64>) -> Result<(), EstimatorError> {
        subtract_gram(&mut self.matrix, whitened);
        for index in 0..self.dim() {
            let value = self.matrix[(index, index)];
            if !(value.is_finite() && value >= 0.0) {
                return Err(EstimatorError::BadVariance { index, value });
            }
        }
        Ok(())
    }
}
