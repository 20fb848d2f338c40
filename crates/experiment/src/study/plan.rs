//! What a study does, and how it is told from others.

use serde_json::{Map, Value, json};

use crate::run::Setup;
use crate::scenario::PlannerName;

/// One run of a study.
#[derive(Clone, Copy, Debug)]
pub struct StudyUnit<'a> {
    /// The number, from 0, of what is varied over the study: a point of a sweep, say.
    pub point: usize,
    /// Where.
    pub setup: &'a Setup,
    /// By which planner.
    pub planner: PlannerName,
    /// With which noise.
    pub seed: u64,
}

impl StudyUnit<'_> {
    /// What its record is called: the number of its point from 1, planner and seed, such as
    /// `0007-combined-seed3`.
    #[must_use]
    pub fn key(&self) -> String {
        format!("{:04}-{}-seed{}", self.point + 1, self.planner, self.seed)
    }
}

/// What a study does.
#[derive(Clone, Debug)]
pub struct StudyPlan<'a> {
    /// What kind of study it is, in a word, such as "sweep".
    pub kind: &'static str,
    /// All that the records depend on, by name. A folder whose study differs in any of it is refused, and the
    /// difference named, so the names should be those that the user knows. An object may change while its
    /// file keeps its name: see [`Setup::object_checksum`].
    pub identity: Map<String, Value>,
    /// The runs. No two may have the same point, planner and seed.
    pub units: Vec<StudyUnit<'a>>,
}

impl StudyPlan<'_> {
    /// The content of plan.json.
    pub(super) fn to_json(&self) -> Value {
        let mut plan = json!({
            "format": FORMAT,
            "version": 1,
            "program": concat!("adslam ", env!("CARGO_PKG_VERSION")),
            "kind": self.kind,
            "units": self.units.len(),
        });
        if let Value::Object(plan) = &mut plan {
            plan.extend(self.identity.clone());
        }
        plan
    }
}

/// What plan.json says it is.
pub(super) const FORMAT: &str = "adslam-study";
