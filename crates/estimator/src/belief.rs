//! What the filter believes.

use adslam_models::{Pose, State};
use nalgebra::{Matrix6, Point3};

use crate::noise::{Zero, check_sigma};
use crate::{Covariance, EstimatorError};

/// The estimate χ̂ₙ and its covariance Pₙ.
#[derive(Clone, Debug)]
pub struct Belief {
    /// χ̂, the estimated pose and features.
    pub state: State,
    /// P, the covariance of the error of `state`: of [`Estimator::error`](crate::Estimator::error).
    pub covariance: Covariance,
}

impl Belief {
    /// The belief at the start: a pose known to `pose_covariance` (rad², rad·cm, cm²; zero where
    /// it is exact) and features known independently to `feature_sigma`, cm, on each axis.
    ///
    /// # Errors
    /// Non-finite numbers, a negative sigma, or a pose covariance that is not positive semidefinite, rounding
    /// allowed for.
    pub fn initial(
        pose: Pose,
        features: Vec<Point3<f64>>,
        pose_covariance: &Matrix6<f64>,
        feature_sigma: f64,
    ) -> Result<Self, EstimatorError> {
        let finite = |what, ok| {
            if ok {
                Ok(())
            } else {
                Err(EstimatorError::NotFinite { what })
            }
        };
        finite("first pose", pose.to_vector().iter().all(|v| v.is_finite()))?;
        finite(
            "first covariance of the pose",
            pose_covariance.iter().all(|v| v.is_finite()),
        )?;
        let positions_finite = features
            .iter()
            .all(|p| p.coords.iter().all(|v| v.is_finite()));
        finite("first position of a feature", positions_finite)?;
        check_sigma("the first feature positions", feature_sigma, Zero::Allowed)?;
        check_covariance(pose_covariance)?;
        let covariance = Covariance::initial(pose_covariance, feature_sigma, features.len());
        Ok(Self {
            state: State { pose, features },
            covariance,
        })
    }

    /// State and covariance must be of the same features.
    pub(crate) fn check_sizes(&self) -> Result<(), EstimatorError> {
        if self.covariance.dim() == self.state.dim() {
            return Ok(());
        }
        Err(EstimatorError::WrongCount {
            what: "the covariance",
            found: self.covariance.feature_count(),
            expected: self.state.features.len(),
        })
    }
}

/// By how much rounding may carry a correlation beyond 1, or an eigenvalue of a correlation matrix below 0.
const BEYOND_SEMIDEFINITE: f64 = 1e-9;

/// A covariance of the pose must be positive semidefinite.
fn check_covariance(p: &Matrix6<f64>) -> Result<(), EstimatorError> {
    if let Some(index) = (0..6).find(|&i| p[(i, i)] < 0.0) {
        let value = p[(index, index)];
        return Err(EstimatorError::BadVariance { index, value });
    }
    let sigma = p.diagonal().map(f64::sqrt);
    for first in 0..6 {
        for second in first + 1..6 {
            let covariance = 0.5 * (p[(first, second)] + p[(second, first)]);
            let largest = sigma[first] * sigma[second];
            if covariance.abs() > largest * (1.0 + BEYOND_SEMIDEFINITE) {
                return Err(EstimatorError::BadCorrelation {
                    first,
                    second,
                    covariance,
                    largest,
                });
            }
        }
    }
    let correlations = Matrix6::from_fn(|i, j| {
        let scale = sigma[i] * sigma[j];
        let covariance = 0.5 * (p[(i, j)] + p[(j, i)]);
        if scale > 0.0 { covariance / scale } else { 0.0 }
    });
    let smallest = correlations.symmetric_eigenvalues().min();
    if smallest < -BEYOND_SEMIDEFINITE {
        return Err(EstimatorError::NotSemidefinite { smallest });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(entries: &[(usize, usize, f64)]) -> Result<(), EstimatorError> {
        let mut p = Matrix6::identity();
        for &(i, j, value) in entries {
            p[(i, j)] = value;
            p[(j, i)] = value;
        }
        Belief::initial(Pose::default(), Vec::new(), &p, 0.1).map(|_| ())
    }

    #[test]
    fn a_correlation_beyond_one_is_refused_by_name() {
        let error = checked(&[(4, 4, 4.0), (1, 4, 4.0)]).unwrap_err();
        assert_eq!(
            error,
            EstimatorError::BadCorrelation {
                first: 1,
                second: 4,
                covariance: 4.0,
                largest: 2.0,
            }
        );
        let said = error.to_string();
        assert!(said.contains("pitch and y (entries 1 and 4)"), "{said}");
        assert!(
            checked(&[(2, 2, 0.0), (0, 2, 1e-20)]).is_err(),
            "of an exact angle"
        );
    }

    #[test]
    fn what_only_the_whole_matrix_shows_is_refused() {
        let pairs = |c: f64| [(0, 1, c), (0, 2, c), (1, 2, -c)];
        // The eigenvalues are 1 + c, twice, and 1 − 2c.
        assert!(matches!(
            checked(&pairs(0.6)),
            Err(EstimatorError::NotSemidefinite { smallest }) if (smallest + 0.2).abs() < 1e-12
        ));
        assert_eq!(checked(&pairs(0.5)), Ok(()), "singular, but a covariance");
        assert_eq!(checked(&[(0, 1, 1.0)]), Ok(()));
        assert_eq!(checked(&[(0, 0, 0.0), (3, 3, 0.0)]), Ok(()));
    }

    #[test]
    fn a_negative_or_vast_sigma_is_refused() {
        for sigma in [-0.1, 1e200, 1e-200, f64::NAN] {
            let made = Belief::initial(Pose::default(), Vec::new(), &Matrix6::zeros(), sigma);
            assert!(
                matches!(made, Err(EstimatorError::BadSigma { .. })),
                "{sigma}"
            );
        }
    }
}
