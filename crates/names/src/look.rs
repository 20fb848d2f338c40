//! What planners and estimators look like in results.

use serde::{Deserialize, Serialize};

use crate::{EstimatorName, PlannerName};

/// How something with a name is shown in figures, replays and pages.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Look {
    /// What it is called there.
    pub label: String,
    /// Its colour: red, green, blue.
    pub colour: [u8; 3],
}

/// That of what nobody gave a colour.
const OF_OTHERS: [u8; 3] = [0xcc, 0x79, 0xa7];

impl Look {
    /// With a label and a colour.
    #[must_use]
    pub fn new(label: &str, colour: [u8; 3]) -> Self {
        Self {
            label: label.to_owned(),
            colour,
        }
    }

    /// That of a planner of which nothing but the name is known. The paper's have colours of Okabe and Ito, which can be
    /// distinguished without colour vision.
    #[must_use]
    pub fn of_planner(name: PlannerName) -> Self {
        let (label, colour) = match name {
            PlannerName::PREDETERMINED => ("Predetermined", [0x99, 0x99, 0x99]),
            PlannerName::LOCAL => ("Local", [0xd5, 0x5e, 0x00]),
            PlannerName::GLOBAL => ("Global", [0x00, 0x72, 0xb2]),
            PlannerName::COMBINED => ("Combined", [0x00, 0x9e, 0x73]),
            _ => (name.as_str(), OF_OTHERS),
        };
        Self::new(label, colour)
    }

    /// That of an estimator of which nothing but the name is known: ours have colours that no method has.
    #[must_use]
    pub fn of_estimator(name: EstimatorName) -> Self {
        let (label, colour) = match name {
            EstimatorName::EULER_EKF => ("Euler EKF", [0xe6, 0x9f, 0x00]),
            EstimatorName::SO3_EKF => ("SO(3) EKF", OF_OTHERS),
            EstimatorName::RIGHT_INVARIANT_EKF => ("Right-invariant EKF", [0x00, 0x00, 0x00]),
            _ => (name.as_str(), [0x56, 0xb4, 0xe9]),
        };
        Self::new(label, colour)
    }
}
