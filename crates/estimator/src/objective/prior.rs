//! What is known before the robot moves: features propagated and conditioned on the structure.

use adslam_models::{Control, Pose};
use nalgebra::{Matrix6, Point3, Vector3};

use crate::ekf::check_motion;
use crate::structure_update::PairRoot;
use crate::{Belief, Covariance, EstimatorError, FilterNoise};

/// The belief of a decision with everything applied that no action changes.
#[derive(Clone, Debug)]
pub(super) struct DecisionPrior {
    /// The estimated pose, not yet moved.
    pub(super) pose: Pose,
    /// The features after their known motion, cm.
    pub(super) features: Vec<Point3<f64>>,
    /// Features propagated and conditioned on the structure; the pose not yet moved.
    pub(super) covariance: Covariance,
    /// The noise assumed.
    pub(super) noise: FilterNoise,
}

impl DecisionPrior {
    /// The belief at step n, what is known of the features' motion to step n + 1 (cm, world), the
    /// noise to assume, and whether all pairs of features will be measured.
    pub(super) fn new(
        belief: &Belief,
        feature_motion: &[Vector3<f64>],
        noise: &FilterNoise,
        with_structure: bool,
    ) -> Result<Self, EstimatorError> {
        noise.validate()?;
        check_motion(belief, &Control::default(), feature_motion)?;
        let mut state = belief.state.clone();
        state.move_features(feature_motion);
        let mut covariance = belief.covariance.clone();
        // The robot stands still here; its own motion and noise come with each action.
        let features_only = FilterNoise {
            rotation_sigma: 0.0,
            translation_sigma: 0.0,
            ..*noise
        };
        covariance.propagate(&Matrix6::identity(), &features_only);
        let count = state.features.len();
        if with_structure && count > 1 {
            let sigma = noise.structure_measurement_sigma;
            PairRoot::all_pairs(count, 1.0 / (sigma * sigma)).condition(&mut covariance)?;
        }
        Ok(Self {
            pose: state.pose,
            features: state.features,
            covariance,
            noise: *noise,
        })
    }
}
