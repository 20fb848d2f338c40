//! The objective by one dense update for each action.

use adslam_models::{
    Control, FeatureId, Pose, feature_measurement_jacobians, feature_offset, motion_jacobian,
    predicted_pose,
};
use faer::Mat;
use nalgebra::{Matrix3, Vector3};

use super::prior::DecisionPrior;
use crate::ekf::check_feature;
use crate::linear_algebra::{cholesky, solve_lower};
use crate::{Belief, EstimatorError, FilterNoise};

/// A measurement that is expected after an action.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedMeasurement {
    /// Of which feature.
    pub feature: FeatureId,
    /// The covariance of its noise, cm², body frame: any symmetric positive definite matrix, so
    /// noise may depend on the range and differ between the axes.
    pub covariance: Matrix3<f64>,
}

impl PlannedMeasurement {
    /// With the same `sigma`, cm, on each axis.
    #[must_use]
    pub fn isotropic(feature: FeatureId, sigma: f64) -> Self {
        Self {
            feature,
            covariance: Matrix3::identity() * (sigma * sigma),
        }
    }
}

/// trace(Pₙ₊₁) for one action after another, each by one dense update that forms the whole posterior
/// covariance: the path for noise that is not isotropic.
#[derive(Clone, Debug)]
pub struct DirectTrace {
    prior: DecisionPrior,
}

impl DirectTrace {
    /// Prepares the decision: the belief at step n, what is known of the features' motion to step
    /// n + 1 (cm, world), the noise to assume, and whether all pairs of features will be measured.
    ///
    /// # Errors
    /// Inputs that do not fit the belief, or a covariance that has broken down.
    pub fn new(
        belief: &Belief,
        feature_motion: &[Vector3<f64>],
        noise: &FilterNoise,
        with_structure: bool,
    ) -> Result<Self, EstimatorError> {
        let prior = DecisionPrior::new(belief, feature_motion, noise, with_structure)?;
        Ok(Self { prior })
    }

    /// The predicted pose after `control`.
    #[must_use]
    pub fn predicted_pose(&self, control: &Control) -> Pose {
        predicted_pose(&self.prior.pose, control)
    }

    /// trace(Pₙ₊₁), rad² + cm², if `control` is taken and `measurements` are made.
    ///
    /// # Errors
    /// An unknown feature, or an innovation covariance that is not positive definite.
    pub fn after(
        &self,
        control: &Control,
        measurements: &[PlannedMeasurement],
    ) -> Result<f64, EstimatorError> {
        let prior = &self.prior;
        let robot_only = FilterNoise {
            feature_motion_sigma: 0.0,
            ..prior.noise
        };
        let mut covariance = prior.covariance.clone();
        covariance.propagate(&motion_jacobian(&prior.pose, control), &robot_only);
        if measurements.is_empty() {
            return Ok(covariance.trace());
        }
        let pose = self.predicted_pose(control);
        let rows = 3 * measurements.len();
        let mut h = Mat::<f64>::zeros(rows, covariance.dim());
        for (m, measurement) in measurements.iter().enumerate() {
            check_feature(measurement.feature, prior.features.len())?;
            let point = &prior.features[measurement.feature.0];
            let jacobian = feature_measurement_jacobians(&pose, point);
            let offset = feature_offset(measurement.feature);
            for a in 0..3 {
                for k in 0..6 {
                    h[(3 * m + a, k)] = jacobian.pose[(a, k)];
                }
                for b in 0..3 {
                    h[(3 * m + a, offset + b)] = jacobian.feature[(a, b)];
                }
            }
        }
        let mut hp = &h * covariance.matrix();
        let mut s = &hp * h.transpose();
        for (m, measurement) in measurements.iter().enumerate() {
            for a in 0..3 {
                for b in 0..3 {
                    s[(3 * m + a, 3 * m + b)] += measurement.covariance[(a, b)];
                }
            }
        }
        cholesky(
            s.as_mut(),
            "innovation covariance of the feature measurements",
        )?;
        solve_lower(s.as_ref(), hp.as_mut());
        covariance.reduce_by(hp.as_ref())?;
        Ok(covariance.trace())
    }
}
