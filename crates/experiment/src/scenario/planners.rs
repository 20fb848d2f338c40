//! `[planners]`: the parameters that each planner has in this world, and the planners' names.

use std::fmt;
use std::str::FromStr;

use serde::Deserialize;
use thiserror::Error;

use super::values::{Fraction, Many, NonNegative, Positive, Vec3};
use crate::diagnostics::nearest;

/// Parameters of every planner, so that all can be compared in this world.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Planners {
    /// The predetermined path.
    pub predetermined: Predetermined,
    /// The local planner, section III-B; has defaults.
    #[serde(default)]
    pub local: Local,
    /// The global planner, section III-C.
    pub global: Global,
    /// The combined planner, section III-D.
    pub combined: Combined,
}

/// `[planners.predetermined]`: the same control at every step.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Predetermined {
    /// Ω: change of roll, pitch and yaw.
    pub rotation_deg: Vec3,
    /// v: translation in the frame of the body before it turns (cm).
    pub translation_cm: Vec3,
}

/// `[planners.local]`
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Local {
    /// The feature measurement's sigma assumed in planning; default the filter's.
    pub feature_measurement_sigma_cm: Option<Positive>,
    /// Time for a decision; default as long as it takes. When it is up the best action scored so far
    /// is taken, so that runs depend on the machine.
    pub deadline_ms: Option<Positive>,
}

/// `[planners.global]`: how the path through viewpoints is found and followed; the combined
/// planner does it in the same way.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Global {
    /// K of Algorithm 2: sets of viewpoints drawn, of which the best is kept; default 50. Without
    /// meaning for fixed viewpoints.
    #[serde(default = "samples")]
    pub samples: Many,
    /// Added to the cost, eq. (8), for each leg that crosses the object; default 1.
    #[serde(default = "crossing_penalty")]
    pub crossing_penalty_cm: NonNegative,
    /// A viewpoint counts as visited when the estimated position is this near to it.
    pub reached_within_cm: Positive,
}

/// `[planners.combined]`
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Combined {
    /// n_u as a fraction of the safe actions (at least one); exactly one of the two is given.
    pub nearest_fraction: Option<Fraction>,
    /// n_u as a number.
    pub nearest_count: Option<Many>,
    /// The feature measurement's sigma assumed in planning; default the filter's.
    pub feature_measurement_sigma_cm: Option<Positive>,
    /// Time for a decision; default as long as it takes. When it is up the best action scored so far
    /// is taken, so that runs depend on the machine.
    pub deadline_ms: Option<Positive>,
}

/// n_u of section III-D: how many of the safe actions, those nearest to the goal, are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Nearest {
    /// This part of them, and at least one.
    Fraction(f64),
    /// This many of them, or all there are.
    Count(usize),
}

impl Combined {
    /// n_u. Where, against the rule, both are set the count holds, where none is, all are compared.
    pub fn nearest(&self) -> Nearest {
        match (self.nearest_count, self.nearest_fraction) {
            (Some(count), _) => Nearest::Count(count.get()),
            (None, Some(fraction)) => Nearest::Fraction(*fraction),
            (None, None) => Nearest::Fraction(1.0),
        }
    }
}

/// The planners, in the order of the paper's tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
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

    /// The name used in files and on the command line.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Predetermined => "predetermined",
            Self::Local => "local",
            Self::Global => "global",
            Self::Combined => "combined",
        }
    }
}

impl fmt::Display for PlannerName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

/// A name that no planner has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("no planner is called {given:?}; {}", self.advice())]
pub struct UnknownPlanner {
    given: String,
}

impl UnknownPlanner {
    fn advice(&self) -> String {
        let names = PlannerName::ALL.map(PlannerName::as_str);
        match nearest(&self.given, names) {
            Some(near) => format!("did you mean {near}? There are {}", names.join(", ")),
            None => format!("there are {}", names.join(", ")),
        }
    }
}

impl FromStr for PlannerName {
    type Err = UnknownPlanner;

    fn from_str(given: &str) -> Result<Self, UnknownPlanner> {
        Self::ALL
            .into_iter()
            .find(|name| name.as_str() == given)
            .ok_or_else(|| UnknownPlanner {
                given: given.to_owned(),
            })
    }
}

fn samples() -> Many {
    Many::default_of(50)
}

fn crossing_penalty() -> NonNegative {
    NonNegative::default_of(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_go_there_and_back() {
        for name in PlannerName::ALL {
            assert_eq!(name.to_string().parse(), Ok(name));
        }
    }

    #[test]
    fn an_unknown_name_is_answered_with_the_known_ones() {
        let error = "combind".parse::<PlannerName>().unwrap_err().to_string();
        assert!(error.contains("did you mean combined?"), "{error}");
        assert!(
            error.contains("predetermined, local, global, combined"),
            "{error}"
        );
    }
}
