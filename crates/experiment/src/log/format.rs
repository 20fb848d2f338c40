//! The lines of a log and of the estimates made from it.

use adslam_estimator::{Belief, EstimatorError, FilterNoise, UpdateReport};
use adslam_models::{FeatureId, Pose};
use nalgebra::{Matrix6, Point3, Vector6};
use serde::{Deserialize, Serialize};

/// The value of `format` in a header.
pub const FORMAT: &str = "adslam-log";
/// The version of the format that is read and written here.
pub const VERSION: u64 = 1;

/// Line 1: what the filter starts from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogHeader {
    /// [`FORMAT`].
    pub format: String,
    /// [`VERSION`].
    pub version: u64,
    /// Unit of every length in the log and in the estimates; the filter does not convert it.
    pub length_unit: String,
    /// M.
    pub features: usize,
    /// The first estimate.
    pub initial: InitialEstimate,
    /// The noise that the filter is to assume.
    pub noise: LogNoise,
}

/// χ̂₁ and P₁.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InitialEstimate {
    /// Roll, pitch, yaw (rad), x, y, z.
    pub pose: [f64; 6],
    /// Positions in the world.
    pub features: Vec<[f64; 3]>,
    /// Covariance of the pose.
    pub pose_covariance: [[f64; 6]; 6],
    /// Sigma of each axis of each feature.
    pub feature_sigma: f64,
}

/// Standard deviations; see [`FilterNoise`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogNoise {
    /// Of each angle, rad a step.
    pub rotation_sigma: f64,
    /// Of each axis of the robot's motion, a step.
    pub translation_sigma: f64,
    /// Of each axis of a feature's motion, a step.
    pub feature_motion_sigma: f64,
    /// Of each axis of a feature measurement.
    pub feature_measurement_sigma: f64,
    /// Of each axis of a structure measurement.
    pub structure_measurement_sigma: f64,
}

/// Every later line: the motion to step n and what was measured there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogStep {
    /// n.
    pub step: u64,
    /// u from step n − 1 to n.
    pub control: LogControl,
    /// The known motion of each feature from step n − 1 to n, r_t t + r_d d, world.
    pub feature_motion: Vec<[f64; 3]>,
    /// What the robot's sensor saw.
    #[serde(default)]
    pub feature_measurements: Vec<LogFeature>,
    /// Measured relative positions of features.
    #[serde(default)]
    pub structure_measurements: Vec<LogPair>,
}

/// u = [Ω, v].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogControl {
    /// Ω, rad.
    pub rotation: [f64; 3],
    /// v, body frame before the motion.
    pub translation: [f64; 3],
}

/// zᶠ of one feature.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogFeature {
    /// Which, from 0.
    pub id: usize,
    /// Body frame.
    pub z: [f64; 3],
}

/// zᶜ of one pair, from < to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogPair {
    /// Where it starts, from 0.
    pub from: usize,
    /// Where it ends.
    pub to: usize,
    /// `p_to` − `p_from`, world.
    pub z: [f64; 3],
}

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
}

impl InitialEstimate {
    /// As a belief.
    ///
    /// # Errors
    /// Numbers that make no covariance.
    pub fn belief(&self) -> Result<Belief, EstimatorError> {
        let pose = Pose::from_vector(&Vector6::from(self.pose));
        let features = self.features.iter().copied().map(Point3::from).collect();
        let covariance = Matrix6::from_fn(|i, j| self.pose_covariance[i][j]);
        Belief::initial(pose, features, &covariance, self.feature_sigma)
    }
}

impl From<LogNoise> for FilterNoise {
    fn from(noise: LogNoise) -> Self {
        Self {
            rotation_sigma: noise.rotation_sigma,
            translation_sigma: noise.translation_sigma,
            feature_motion_sigma: noise.feature_motion_sigma,
            feature_measurement_sigma: noise.feature_measurement_sigma,
            structure_measurement_sigma: noise.structure_measurement_sigma,
        }
    }
}

impl EstimateLine {
    /// The belief at a step, after an update that reported so.
    #[must_use]
    pub fn of(step: u64, belief: &Belief, report: &UpdateReport, rejected: &[FeatureId]) -> Self {
        let covariance = belief.covariance.pose();
        Self {
            step,
            pose: belief.state.pose.to_vector().into(),
            pose_covariance: std::array::from_fn(|i| std::array::from_fn(|j| covariance[(i, j)])),
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
        }
    }
}
