//! How a study grows to another plan, if it does.

use std::collections::{HashMap, VecDeque};

use crc32fast::Hasher;

use super::kept::KeptPlan;
use super::{StudyPlan, StudyUnit, refusal};
use crate::provenance::Build;

/// A plan as its folder is to hold it.
#[derive(Debug)]
pub(super) struct Grown {
    pub(super) plan: KeptPlan,
    /// The number of each of the plan's points, from 1.
    pub(super) numbers: Vec<usize>,
    hashers: Vec<Hasher>,
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
