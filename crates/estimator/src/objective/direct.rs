//! The objective by one dense update for each action.

use adslam_models::{Control, FeatureId, Pose, motion_jacobian, predicted_pose};
use nalgebra::{Matrix3, Vector3};

use super::prior::DecisionPrior;
use crate::digits::check_motion_resolved;
use crate::feature_update::{Sighting, condition_on_features};
use crate::input::check_feature;
use crate::noise::{Zero, check_sigma};
use crate::workspace::Workspace;
use crate::{Belief, Covariance, EstimatorError, FilterNoise, Parallelism};

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
    ///
    /// # Errors
    /// [`EstimatorError::BadSigma`] if it is not above 0.
    pub fn isotropic(feature: FeatureId, sigma: f64) -> Result<Self, EstimatorError> {
        check_sigma("a planned measurement", sigma, Zero::Refused)?;
        Ok(Self {
            feature,
            covariance: Matrix3::identity() * (sigma * sigma),
        })
    }
}

/// trace(Pₙ₊₁) for one action after another, each by one dense update that forms the whole posterior
/// covariance: the path for noise that is not isotropic.
///
/// It is the filter's own update with features: for k of them and n entries of the state about 3n²k
/// multiplications and additions an action. It keeps its memory from decision to decision.
#[derive(Clone, Debug)]
pub struct DirectTrace {
    prior: DecisionPrior,
    /// Of the action asked for last; the lower triangle counts.
    posterior: Covariance,
    sightings: Vec<Sighting>,
    workspace: Workspace,
}

/// With no decision prepared.
impl Default for DirectTrace {
    fn default() -> Self {
        Self {
            prior: DecisionPrior::default(),
            posterior: Covariance::empty(),
            sightings: Vec::new(),
            workspace: Workspace::default(),
        }
    }
}

impl DirectTrace {
    /// The objective of one decision, see [`Self::prepare`].
    ///
    /// # Errors
    /// Those of [`Self::prepare`].
    pub fn new(
        belief: &Belief,
        feature_motion: &[Vector3<f64>],
        noise: &FilterNoise,
        with_structure: bool,
    ) -> Result<Self, EstimatorError> {
        let mut objective = Self::default();
        objective.prepare(belief, feature_motion, noise, with_structure)?;
        Ok(objective)
    }

    /// Starts a decision: the belief at step n, what is known of the features' motion to step n + 1
    /// (cm, world), the noise to assume, and whether all pairs of features will be measured. What was
    /// prepared before is forgotten, its memory kept.
    ///
    /// # Errors
    /// Inputs that do not fit the belief, or a covariance that has broken down; nothing is prepared then.
    pub fn prepare(
        &mut self,
        belief: &Belief,
        feature_motion: &[Vector3<f64>],
        noise: &FilterNoise,
        with_structure: bool,
    ) -> Result<(), EstimatorError> {
        let workspace = &mut self.workspace;
        self.prior
            .prepare(belief, feature_motion, noise, with_structure, workspace)
    }

    /// The predicted pose after `control`.
    #[must_use]
    pub fn predicted_pose(&self, control: &Control) -> Pose {
        predicted_pose(&self.prior.pose, control)
    }

    /// trace(Pₙ₊₁), rad² + cm², if `control` is taken and `measurements` are made.
    ///
    /// # Errors
    /// No decision prepared, an unknown feature, or an innovation covariance that is not positive
    /// definite.
    pub fn after(
        &mut self,
        control: &Control,
        measurements: &[PlannedMeasurement],
    ) -> Result<f64, EstimatorError> {
        let prior = &self.prior;
        let robot_only = FilterNoise {
            feature_motion_sigma: 0.0,
            ..*prior.noise()?
        };
        let pose = self.predicted_pose(control);
        self.sightings.clear();
        for PlannedMeasurement {
            feature,
            covariance,
        } in measurements
        {
            check_feature(*feature, prior.features.len())?;
            let point = &prior.features[feature.0];
            self.sightings
                .push(Sighting::new(&pose, *feature, point, *covariance, None));
        }
        self.posterior.copy_lower(&prior.covariance);
        self.posterior
            .propagate(&motion_jacobian(&prior.pose, control), &robot_only);
        check_motion_resolved(
            &prior.covariance.pose(),
            &self.posterior.pose(),
            robot_only.translation_sigma,
        )?;
        condition_on_features(
            &mut self.posterior,
            &self.sightings,
            &mut self.workspace,
            Parallelism::Sequential,
        )?;
        self.posterior.check_variances()?;
        Ok(self.posterior.trace())
    }
}
