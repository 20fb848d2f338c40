//! The planners' names.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Named;

/// The planners, in the order of the paper's tables.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum PlannerName {
    /// The same control at every step.
    Predetermined,
    /// Greedy: the smallest trace of the covariance, section III-B.
    Local,
    /// Through viewpoints that see everything, section III-C.
    Global,
    /// Both, section III-D.
    Combined,
}

impl PlannerName {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::Predetermined,
        Self::Local,
        Self::Global,
        Self::Combined,
    ];
}

impl fmt::Display for PlannerName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

impl Named for PlannerName {
    const KIND: &'static str = "planner";
    const ALL: &'static [Self] = &PlannerName::ALL;

    fn as_str(self) -> &'static str {
        match self {
            Self::Predetermined => "predetermined",
            Self::Local => "local",
            Self::Global => "global",
            Self::Combined => "combined",
        }
    }
}
