//! The names of planners and estimators.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde::{Serialize, Serializer};

use crate::short_name::{BadName, ShortName, name};

name!(
    /// The name of a planner in files, on the command line and in results: letters, digits, `_` and `-`, a letter first,
    /// 31 at most.
    ///
    /// Any program may have planners of its own, so that a name by itself says only how a planner is called; which there
    /// are is known by a registry.
    PlannerName, "a planner", "PlannerName",
    /// The paper's, in the order of its tables.
    PAPER: [
        /// The same control at every step.
        PREDETERMINED = "predetermined",
        /// Greedy: the smallest trace of the covariance, section III-B.
        LOCAL = "local",
        /// Through viewpoints that see everything, section III-C.
        GLOBAL = "global",
        /// Both, section III-D.
        COMBINED = "combined",
    ]
);

name!(
    /// The name of an estimator, as [`PlannerName`] is that of a planner.
    EstimatorName, "an estimator", "EstimatorName",
    /// Ours.
    OURS: [
        /// The paper's EKF: differences of Euler angles and of positions.
        EULER_EKF = "euler_ekf",
        /// The error-state EKF with the orientation's error on SO(3).
        SO3_EKF = "so3_ekf",
        /// The right-invariant EKF: one error of robot and features together.
        RIGHT_INVARIANT_EKF = "right_invariant_ekf",
    ]
);

/// The paper's.
impl Default for EstimatorName {
    fn default() -> Self {
        Self::EULER_EKF
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_kept_as_it_is_given() {
        for text in ["local", "a", "tour_2", "Next-best", &"x".repeat(31)] {
            assert_eq!(PlannerName::new(text).unwrap().to_string(), text);
            let json = serde_json::to_string(&PlannerName::new(text).unwrap()).unwrap();
            assert_eq!(json, format!("{text:?}"));
            let read: PlannerName = serde_json::from_str(&json).unwrap();
            assert_eq!(read.as_str(), text);
        }
        for text in ["", "2nd", "a.b", "a b", "σ", &"x".repeat(32)] {
            assert!(PlannerName::new(text).is_err(), "{text}");
            assert!(serde_json::from_str::<PlannerName>(&format!("{text:?}")).is_err());
        }
    }

    #[test]
    fn the_papers_planners_come_first() {
        let mut names = [
            "tour",
            "combined",
            "abc",
            "predetermined",
            "global",
            "local",
        ]
        .map(PlannerName::literal);
        names.sort();
        let sorted = names.map(|name| name.to_string());
        assert_eq!(
            sorted,
            [
                "predetermined",
                "local",
                "global",
                "combined",
                "abc",
                "tour"
            ]
        );
    }
}
