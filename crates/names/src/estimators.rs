//! The estimators' names.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Named;

/// The estimators. They differ in what they take for the error of a state.
#[derive(
    Debug,
    Clone,
    Copy,
    Default,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    Serialize,
    Deserialize,
    JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum EstimatorName {
    /// The paper's EKF: differences of Euler angles and of positions.
    #[default]
    EulerEkf,
    /// The error-state EKF with the orientation's error on SO(3).
    So3Ekf,
    /// The right-invariant EKF: one error of robot and features together, which takes no more of where
    /// everything is and heads for known than was measured.
    RightInvariantEkf,
}

impl Named for EstimatorName {
    const KIND: &'static str = "estimator";
    const ALL: &'static [Self] = &[Self::EulerEkf, Self::So3Ekf, Self::RightInvariantEkf];

    fn as_str(self) -> &'static str {
        match self {
            Self::EulerEkf => "euler_ekf",
            Self::So3Ekf => "so3_ekf",
            Self::RightInvariantEkf => "right_invariant_ekf",
        }
    }
}

impl fmt::Display for EstimatorName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}
