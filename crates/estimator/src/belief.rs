//! What the filter believes.

use adslam_models::{Pose, State};
use nalgebra::{Matrix6, Point3};

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
    /// Non-finite numbers, a negative variance, or a negative sigma.
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
        if !(feature_sigma.is_finite() && feature_sigma >= 0.0) {
            return Err(EstimatorError::BadSigma {
                what: "the first feature positions",
                value: feature_sigma,
                requirement: "finite and not negative",
            });
        }
        if let Some(index) = (0..6).find(|&i| pose_covariance[(i, i)] < 0.0) {
            let value = pose_covariance[(index, index)];
            return Err(EstimatorError::BadVariance { index, value });
        }
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
