//! The planner's objective, eqs. (6), (7): the trace of the covariance that an action would leave.

use adslam_models::{
    Control, FeatureId, POSE_DIM, Pose, State, feature_measurement_jacobians, feature_offset,
    motion_jacobian, predicted_pose,
};
use faer::Mat;
use nalgebra::{Matrix3, Matrix6, SMatrix, Vector3, Vector6};

use crate::ekf::{check_feature, check_motion};
use crate::linear_algebra::{cholesky, solve_lower, squared_norm};
use crate::structure_update::PairRoot;
use crate::{Belief, Covariance, EstimatorError, FilterNoise};

/// trace(Pₙ₊₁) for one action after another from the same belief, exactly as Algorithm 1 gives it with
/// zero innovation, eq. (7).
///
/// Structure measurements touch the features only and an action moves the robot only, so conditioning
/// on them commutes with the motion: they are applied once here, not for each action. For an
/// action only the rows of the measured features are formed; the trace falls by ‖L⁻¹HP‖².
#[derive(Debug)]
pub struct PosteriorTrace {
    predicted_features: State,
    /// Features propagated and conditioned on the structure; the pose not yet moved.
    covariance: Covariance,
    noise: FilterNoise,
    features_trace: f64,
}

impl PosteriorTrace {
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
        noise.validate()?;
        check_motion(belief, &Control::default(), feature_motion)?;
        let mut predicted_features = belief.state.clone();
        predicted_features.move_features(feature_motion);
        let mut covariance = belief.covariance.clone();
        // The robot stands still here; its own motion and noise come with each action.
        let features_only = FilterNoise {
            rotation_sigma: 0.0,
            translation_sigma: 0.0,
            ..*noise
        };
        covariance.propagate(&Matrix6::identity(), &features_only);
        let count = predicted_features.features.len();
        if with_structure && count > 1 {
            let sigma = noise.structure_measurement_sigma;
            PairRoot::all_pairs(count, 1.0 / (sigma * sigma)).condition(&mut covariance)?;
        }
        let features_trace = (POSE_DIM..covariance.dim())
            .map(|i| covariance.entry(i, i))
            .sum();
        Ok(Self {
            predicted_features,
            covariance,
            noise: *noise,
            features_trace,
        })
    }

    /// The predicted pose after `control`.
    #[must_use]
    pub fn predicted_pose(&self, control: &Control) -> Pose {
        predicted_pose(&self.predicted_features.pose, control)
    }

    /// trace(Pₙ₊₁), rad² + cm², if `control` is taken and the features in `visible` are measured.
    ///
    /// # Errors
    /// An unknown feature, or an innovation covariance that is not positive definite.
    pub fn after(&self, control: &Control, visible: &[FeatureId]) -> Result<f64, EstimatorError> {
        let jacobian = motion_jacobian(&self.predicted_features.pose, control);
        let mut pose_covariance = jacobian * self.covariance.pose() * jacobian.transpose();
        for k in 0..3 {
            pose_covariance[(k, k)] += self.noise.rotation_sigma.powi(2);
            pose_covariance[(3 + k, 3 + k)] += self.noise.translation_sigma.powi(2);
        }
        let prior = pose_covariance.trace() + self.features_trace;
        if visible.is_empty() {
            return Ok(prior);
        }
        let (rows, mut s) = self.measured_rows(control, &jacobian, &pose_covariance, visible)?;
        cholesky(
            s.as_mut(),
            "innovation covariance of the feature measurements",
        )?;
        let mut whitened = rows;
        solve_lower(s.as_ref(), whitened.as_mut());
        Ok(prior - squared_norm(whitened.as_ref()))
    }

    /// HP, 3k × n, and S, 3k × 3k. The rows are turned into the world, which for isotropic noise
    /// changes neither S's eigenvalues nor the trace and makes the feature's Jacobian the identity.
    fn measured_rows(
        &self,
        control: &Control,
        jacobian: &Matrix6<f64>,
        pose_covariance: &Matrix6<f64>,
        visible: &[FeatureId],
    ) -> Result<(Mat<f64>, Mat<f64>), EstimatorError> {
        let p = self.covariance.matrix();
        let pose = self.predicted_pose(control);
        let world_from_body = pose.orientation.rotation().into_inner();
        let mut hp = Mat::<f64>::zeros(3 * visible.len(), p.ncols());
        let mut blocks = Vec::with_capacity(visible.len());
        for (m, &feature) in visible.iter().enumerate() {
            check_feature(feature, self.predicted_features.features.len())?;
            let point = &self.predicted_features.features[feature.0];
            let of_pose = world_from_body * feature_measurement_jacobians(&pose, point).pose;
            let moved = of_pose * jacobian;
            let offset = feature_offset(feature);
            let cross = SMatrix::<f64, 3, 6>::from_fn(|a, k| p[(offset + a, k)]);
            let pose_columns = of_pose * pose_covariance + cross * jacobian.transpose();
            for k in 0..POSE_DIM {
                for a in 0..3 {
                    hp[(3 * m + a, k)] = pose_columns[(a, k)];
                }
            }
            for j in POSE_DIM..p.ncols() {
                let column = Vector6::from_fn(|k, _| p[(k, j)]);
                let product = moved * column;
                for a in 0..3 {
                    hp[(3 * m + a, j)] = product[a] + p[(offset + a, j)];
                }
            }
            blocks.push((of_pose, offset));
        }
        let variance = self.noise.feature_measurement_sigma.powi(2);
        let mut s = Mat::<f64>::zeros(hp.nrows(), hp.nrows());
        for i in 0..visible.len() {
            let rows_of_pose = SMatrix::<f64, 3, 6>::from_fn(|a, k| hp[(3 * i + a, k)]);
            for (j, (of_pose, offset)) in blocks.iter().enumerate().take(i + 1) {
                let of_feature = Matrix3::from_fn(|a, b| hp[(3 * i + a, offset + b)]);
                let block = rows_of_pose * of_pose.transpose() + of_feature;
                for b in 0..3 {
                    for a in 0..3 {
                        s[(3 * i + a, 3 * j + b)] = block[(a, b)];
                    }
                }
            }
            for a in 0..3 {
                s[(3 * i + a, 3 * i + a)] += variance;
            }
        }
        Ok((hp, s))
    }
}
