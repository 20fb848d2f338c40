//! The lines of estimates that are made from a log.

use adslam_estimator::{Belief, UpdateReport};
use adslam_models::FeatureId;
use adslam_simulation::StepMetrics;
use adslam_statistics::mean;
use serde::{Deserialize, Serialize};

use super::format::rows;

/// A line of the estimates. Numbers are written with as many digits, at most 17, as it takes to read the
/// same number back.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EstimateLine {
    /// n.
    pub step: u64,
    /// Roll, pitch, yaw (rad), x, y, z.
    pub pose: [f64; 6],
    /// Covariance of the pose.
    pub pose_covariance: [[f64; 6]; 6],
    /// Positions in the world.
    pub features: Vec<[f64; 3]>,
    /// All variances, in the order of the state.
    pub covariance_diagonal: Vec<f64>,
    /// Their sum.
    pub trace: f64,
    /// NIS of the feature measurements that were used, and how many numbers they are.
    #[serde(default)]
    pub feature_nis: (f64, usize),
    /// NIS of the structure measurements given those, and how many independent numbers they are.
    #[serde(default)]
    pub structure_nis: (f64, usize),
    /// Features whose measurements the gate kept out.
    #[serde(default)]
    pub rejected_features: Vec<usize>,
    /// When it was, seconds, where the log says so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// How far that is from the truth, where the log has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub errors: Option<EstimateErrors>,
}

/// The errors of a line of estimates, in the log's unit of length; NEES are absent while the covariance that
/// they need is singular.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EstimateErrors {
    /// Eq. (11), radians and lengths together.
    pub pose_error: f64,
    /// The orientation's part of it, rad.
    pub orientation_error: f64,
    /// The position's part of it.
    pub position_error: f64,
    /// Eq. (11) relative to the object.
    pub relative_pose_error: f64,
    /// Mean of eq. (12) over the features.
    pub feature_error_mean: f64,
    /// Maximum of eq. (12).
    pub feature_error_max: f64,
    /// Mean of eq. (12) relative to the object.
    pub relative_feature_error_mean: f64,
    /// NEES of the pose, 6 degrees of freedom.
    pub pose_nees: Option<f64>,
    /// Mean over the features of their NEES, 3 degrees of freedom each.
    pub feature_nees: Option<f64>,
    /// NEES of the whole state, divided by its dimension.
    pub joint_nees_per_dof: Option<f64>,
}

impl EstimateErrors {
    /// Whether they can be written as JSON.
    pub(super) fn are_finite(&self) -> bool {
        let nees = [self.pose_nees, self.feature_nees, self.joint_nees_per_dof];
        let errors = [
            self.pose_error,
            self.orientation_error,
            self.position_error,
            self.relative_pose_error,
            self.feature_error_mean,
            self.feature_error_max,
            self.relative_feature_error_mean,
        ];
        let mut all = errors.into_iter().chain(nees.into_iter().flatten());
        all.all(f64::is_finite)
    }
}

impl From<&StepMetrics> for EstimateErrors {
    fn from(metrics: &StepMetrics) -> Self {
        let of_features = &metrics.feature_errors;
        Self {
            pose_error: metrics.pose_error,
            orientation_error: metrics.orientation_error,
            position_error: metrics.position_error,
            relative_pose_error: metrics.relative_pose_error,
            feature_error_mean: mean(of_features),
            feature_error_max: of_features.iter().copied().fold(0.0, f64::max),
            relative_feature_error_mean: metrics.relative_feature_error,
            pose_nees: metrics.pose_nees,
            feature_nees: metrics.feature_nees_mean(),
            joint_nees_per_dof: metrics.joint_nees_per_dof,
        }
    }
}

impl EstimateLine {
    /// The belief at a step, after an update that reported so.
    #[must_use]
    pub fn of(step: u64, belief: &Belief, report: &UpdateReport, rejected: &[FeatureId]) -> Self {
        Self {
            step,
            pose: belief.state.pose.to_vector().into(),
            pose_covariance: rows(&belief.covariance.pose()),
            features: belief
                .state
                .features
                .iter()
                .map(|p| p.coords.into())
                .collect(),
            covariance_diagonal: belief.covariance.variances(),
            trace: belief.covariance.trace(),
            feature_nis: (report.features.value, report.features.dof),
            structure_nis: (report.structure.value, report.structure.dof),
            rejected_features: rejected.iter().map(|feature| feature.0).collect(),
            time: None,
            errors: None,
        }
    }
}
