//! The lines of a log.

use adslam_estimator::{Belief, EstimatorError, FilterNoise, PairMeasurement};
use adslam_models::{Pose, State};
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
    /// When the start was, seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[serde(alias = "stamp", alias = "timestamp")]
    pub time: Option<f64>,
    /// Where robot and features really were at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub truth: Option<LogTruth>,
    /// Which filter the recorded run had; it is taken where nothing else is asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filter: Option<LogFilter>,
    /// Where the log comes from, for people.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
}

/// Where everything really was, as far as someone knows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogTruth {
    /// Roll, pitch, yaw (rad), x, y, z.
    pub pose: [f64; 6],
    /// Positions in the world.
    pub features: Vec<[f64; 3]>,
}

/// The filter of a recorded run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogFilter {
    /// Its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub estimator: Option<String>,
    /// The part of good feature measurements that pass its gate; absent where it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gate_probability: Option<f64>,
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
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub structure_measurements: Vec<LogPair>,
    /// All pairs measured at once: for each feature i the sum over all j of the measured p_i − p_j, world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub structure_sums: Option<Vec<[f64; 3]>>,
    /// When it was, seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[serde(alias = "stamp", alias = "timestamp")]
    pub time: Option<f64>,
    /// Where robot and features really were then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub truth: Option<LogTruth>,
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

impl From<&PairMeasurement> for LogPair {
    fn from(pair: &PairMeasurement) -> Self {
        Self {
            from: pair.from.0,
            to: pair.to.0,
            z: pair.z.into(),
        }
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

impl LogTruth {
    /// The truth as numbers of a log.
    #[must_use]
    pub fn of(state: &State) -> Self {
        Self {
            pose: state.pose.to_vector().into(),
            features: state.features.iter().map(|p| p.coords.into()).collect(),
        }
    }

    /// As a state.
    #[must_use]
    pub fn state(&self) -> State {
        State {
            pose: Pose::from_vector(&Vector6::from(self.pose)),
            features: self.features.iter().copied().map(Point3::from).collect(),
        }
    }
}

/// A matrix as lists of its rows.
pub(super) fn rows(matrix: &Matrix6<f64>) -> [[f64; 6]; 6] {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]))
}
