//! What is known before the robot moves: features propagated and conditioned on the structure.

use adslam_models::{Control, Pose};
use nalgebra::{Matrix6, Point3, Vector3};

use crate::input::check_motion;
use crate::structure_update::condition_on_all_pairs;
use crate::workspace::Workspace;
use crate::{Belief, Covariance, EstimatorError, FilterNoise, Parallelism};

/// The belief of a decision with everything applied that no action changes.
#[derive(Clone, Debug)]
pub(super) struct DecisionPrior {
    /// The estimated pose, not yet moved.
    pub(super) pose: Pose,
    /// The features after their known motion, cm.
    pub(super) features: Vec<Point3<f64>>,
    /// Features propagated and conditioned on the structure; the pose not yet moved. The lower triangle
    /// counts.
    pub(super) covariance: Covariance,
    /// The noise assumed; none where nothing is prepared.
    noise: Option<FilterNoise>,
}

impl Default for DecisionPrior {
    fn default() -> Self {
        Self {
            pose: Pose::default(),
            features: Vec::new(),
            covariance: Covariance::empty(),
            noise: None,
        }
    }
}

impl DecisionPrior {
    /// Takes the belief at step n, what is known of the features' motion to step n + 1 (cm, world), the
    /// noise to assume, and whether all pairs of features will be measured. After an error nothing is
    /// prepared.
    pub(super) fn prepare(
        &mut self,
        belief: &Belief,
        feature_motion: &[Vector3<f64>],
        noise: &FilterNoise,
        with_structure: bool,
        workspace: &mut Workspace,
    ) -> Result<(), EstimatorError> {
        self.forget();
        noise.validate()?;
        check_motion(belief, &Control::default(), feature_motion)?;
        self.pose = belief.state.pose;
        self.features.clear();
        let moved = belief.state.features.iter().zip(feature_motion);
        self.features.extend(moved.map(|(p, motion)| p + motion));
        self.covariance.copy_lower(&belief.covariance);
        // The robot stands still here; its own motion and noise come with each action.
        let features_only = FilterNoise {
            rotation_sigma: 0.0,
            translation_sigma: 0.0,
            ..*noise
        };
        self.covariance
            .propagate(&Matrix6::identity(), &features_only);
        if with_structure {
            condition_on_all_pairs(
                &mut self.covariance,
                &[],
                noise.structure_measurement_sigma,
                workspace,
                Parallelism::Sequential,
            )?;
        }
        self.covariance.check_variances()?;
        self.noise = Some(*noise);
        Ok(())
    }

    /// From here on nothing is prepared.
    pub(super) fn forget(&mut self) {
        self.noise = None;
    }

    /// The noise assumed.
    ///
    /// # Errors
    /// [`EstimatorError::NotPrepared`] where nothing is.
    pub(super) fn noise(&self) -> Result<&FilterNoise, EstimatorError> {
        self.noise.as_ref().ok_or(EstimatorError::NotPrepared)
    }
}
