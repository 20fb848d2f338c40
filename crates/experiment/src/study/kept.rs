//! plan.json: the study that a folder holds.

use adslam_names::PlannerName;
use crc32fast::Hasher;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::StudyPlan;
use super::content::Content;
use crate::provenance::Build;

/// What plan.json says it is.
pub(super) const FORMAT: &str = "adslam-study";
pub(super) const VERSION: u32 = 2;

/// The content of plan.json.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct KeptPlan {
    pub(super) format: String,
    pub(super) version: u32,
    pub(super) kind: String,
    /// What may add records: the build that began the study, and those that the user accepted since.
    pub(super) builds: Vec<Build>,
    pub(super) first_seed: u64,
    pub(super) runs: usize,
    /// The scenario of the first point, every key with the value that holds.
    pub(super) scenario: Value,
    /// In the order in which they came; a point's place here is its number in the names of records.
    pub(super) points: Vec<KeptPoint>,
}

/// A point in plan.json.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct KeptPoint {
    /// Where its scenario differs from that of the first point.
    pub(super) set: Map<String, Value>,
    pub(super) object_crc32: String,
    pub(super) planners: Vec<PlannerName>,
}

/// What a plan asks for, in the terms of plan.json.
pub(super) struct Asked {
    pub(super) points: Vec<KeptPoint>,
    pub(super) hashers: Vec<Hasher>,
}

impl KeptPlan {
    /// Without points yet.
    pub(super) fn begun(plan: &StudyPlan<'_>, build: &Build) -> Self {
        let first = plan.points.first();
        Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            kind: plan.kind.to_owned(),
            builds: vec![build.clone()],
            first_seed: plan.first_seed,
            runs: plan.runs,
            scenario: first
                .map(|point| point.setup.scenario.effective())
                .unwrap_or_default(),
            points: Vec::new(),
        }
    }

    /// What `plan` asks for.
    pub(super) fn asked(&self, plan: &StudyPlan<'_>) -> Asked {
        let base = Content::of(&self.scenario);
        let of = plan.points.par_iter().map(|point| {
            let content = Content::of(&point.setup.scenario.effective());
            let object_crc32 = point.setup.object_checksum();
            let hasher = content.hasher(plan.kind, &object_crc32);
            let kept = KeptPoint {
                set: content.set_in(&base),
                object_crc32,
                planners: point.planners.to_vec(),
            };
            (kept, hasher)
        });
        let (points, hashers) = of.unzip();
        Asked { points, hashers }
    }

    pub(super) fn last_seed(&self) -> u64 {
        self.first_seed.saturating_add(self.runs as u64 - 1)
    }
}

impl KeptPoint {
    /// What it is distinguished by.
    pub(super) fn key(&self) -> String {
        let set = Value::Object(self.set.clone());
        format!("{} {set}", self.object_crc32)
    }
}
