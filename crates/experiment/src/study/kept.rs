//! plan.json: the study that a folder holds, and how another plan grows from it.

use std::collections::{HashMap, VecDeque};

use adslam_names::PlannerName;
use crc32fast::Hasher;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::content::Content;
use super::{StudyPlan, StudyUnit, refusal};
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
    hashers: Vec<Hasher>,
}

/// A plan as its folder is to hold it.
#[derive(Debug)]
pub(super) struct Grown {
    pub(super) plan: KeptPlan,
    /// The number of each of the plan's points, from 1.
    pub(super) numbers: Vec<usize>,
    hashers: Vec<Hasher>,
}

impl KeptPlan {
    /// Without points yet.
    fn begun(plan: &StudyPlan<'_>, build: &Build) -> Self {
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
    fn asked(&self, plan: &StudyPlan<'_>) -> Asked {
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

    fn last_seed(&self) -> u64 {
        self.first_seed.saturating_add(self.runs as u64 - 1)
    }
}

impl KeptPoint {
    /// What it is distinguished by.
    fn key(&self) -> String {
        let set = Value::Object(self.set.clone());
        format!("{} {set}", self.object_crc32)
    }
}

impl Grown {
    /// `plan` as the folder is to hold it that holds `kept`, if anything.
    ///
    /// # Errors
    /// Where `kept` has runs that are not in `plan`: what differs.
    pub(super) fn from(
        kept: Option<&KeptPlan>,
        plan: &StudyPlan<'_>,
        build: &Build,
    ) -> Result<Self, Vec<String>> {
        let mut grown = kept.cloned();
        let grown = grown.get_or_insert_with(|| KeptPlan::begun(plan, build));
        let asked = grown.asked(plan);
        let mut known: HashMap<String, VecDeque<usize>> = HashMap::new();
        for (index, point) in grown.points.iter().enumerate() {
            known.entry(point.key()).or_default().push_back(index);
        }
        let places: Vec<Option<usize>> = asked
            .points
            .iter()
            .map(|point| known.get_mut(&point.key())?.pop_front())
            .collect();
        let mut missing: Vec<usize> = known.into_values().flatten().collect();
        missing.sort_unstable();
        let here = KeptPlan::begun(plan, build);
        let fewer_planners = places.iter().zip(&asked.points).any(|(place, point)| {
            let there = place.map(|place| &grown.points[place].planners);
            there.is_some_and(|there| there.iter().any(|one| !point.planners.contains(one)))
        });
        let fewer_seeds =
            here.first_seed > grown.first_seed || here.last_seed() < grown.last_seed();
        if here.kind != grown.kind || !missing.is_empty() || fewer_planners || fewer_seeds {
            return Err(refusal::differences(
                grown, &here, &asked, &places, &missing,
            ));
        }
        let mut numbers = Vec::with_capacity(places.len());
        for (place, point) in places.into_iter().zip(asked.points) {
            let Some(place) = place else {
                grown.points.push(point);
                numbers.push(grown.points.len());
                continue;
            };
            let planners = &mut grown.points[place].planners;
            for planner in point.planners {
                if !planners.contains(&planner) {
                    planners.push(planner);
                }
            }
            numbers.push(place + 1);
        }
        grown.first_seed = here.first_seed;
        grown.runs = here.runs;
        Ok(Self {
            plan: grown.clone(),
            numbers,
            hashers: asked.hashers,
        })
    }

    /// What a unit's record must be of.
    pub(super) fn identity(&self, unit: &StudyUnit<'_>) -> String {
        let mut hasher = self.hashers[unit.point].clone();
        hasher.update(format!("{} {}", unit.planner, unit.seed).as_bytes());
        format!("{:08x}", hasher.finalize())
    }
}
