//! Why a folder does not hold what a plan asks for, in words.

use adslam_names::PlannerName;
use serde_json::Value;

use super::content::Content;
use super::difference::differs_optionally;
use super::kept::{Asked, KeptPlan, KeptPoint};
use super::points::distinct;

/// More differences than these are only counted.
const MOST_NAMED: usize = 6;

/// All that differs between the study that is `there` and the one that is asked for `here`: kind, seeds, planners
/// and keys. `places` says where each point that is asked for is there, `missing` which points there are not asked
/// for.
pub(super) fn differences(
    there: &KeptPlan,
    here: &KeptPlan,
    asked: &Asked,
    places: &[Option<usize>],
    missing: &[usize],
) -> Vec<String> {
    if there.kind != here.kind {
        return vec![format!("a {} there and a {} here", there.kind, here.kind)];
    }
    let mut said = Vec::new();
    let seeds = (seeds(there), seeds(here));
    if seeds.0 != seeds.1 {
        said.push(format!("seeds {} there and {} here", seeds.0, seeds.1));
    }
    let new: Vec<&KeptPoint> = places
        .iter()
        .zip(&asked.points)
        .filter_map(|(place, point)| place.is_none().then_some(point))
        .collect();
    let both = places
        .iter()
        .zip(&asked.points)
        .filter_map(|(place, point)| Some((&there.points[(*place)?], point)));
    let paired = missing.iter().zip(&new);
    let paired = paired.map(|(&missing, new)| (&there.points[missing], *new));
    said.extend(both.chain(paired.clone()).filter_map(|(there, here)| {
        let (there, here) = (names(&there.planners), names(&here.planners));
        (there != here).then(|| format!("planners {there} there and {here} here"))
    }));
    let base = Content::of(&there.scenario);
    said.extend(paired.flat_map(|(there, here)| keys(&base, there, here)));
    let unpaired = missing.iter().skip(new.len());
    said.extend(unpaired.map(|&point| {
        let described = described(&there.points[point]);
        format!("the point with {described} there is not here")
    }));
    let mut said = distinct(said.into_iter());
    if said.len() > MOST_NAMED {
        let more = said.len() - MOST_NAMED;
        said.truncate(MOST_NAMED);
        said.push(format!("{more} more differences"));
    }
    said
}

/// The seeds of a plan, such as "1–20".
fn seeds(plan: &KeptPlan) -> String {
    match plan.runs {
        1 => plan.first_seed.to_string(),
        runs => {
            let last = plan.first_seed.saturating_add(runs as u64 - 1);
            format!("{}–{last}", plan.first_seed)
        }
    }
}

/// In one order, as theirs says nothing.
fn names(planners: &[PlannerName]) -> String {
    let mut planners = planners.to_vec();
    planners.sort_unstable();
    let names: Vec<String> = planners.iter().map(ToString::to_string).collect();
    names.join(", ")
}

/// The keys in which two points differ.
fn keys(base: &Content, there: &KeptPoint, here: &KeptPoint) -> Vec<String> {
    let value = |point: &KeptPoint, key: &str| {
        let value = point.set.get(key).or_else(|| base.get(key)).cloned();
        value.filter(|value| !value.is_null())
    };
    let all = there.set.keys().chain(here.set.keys());
    let mut said: Vec<String> = distinct(all.cloned())
        .into_iter()
        .filter_map(|key| {
            let (there, here) = (value(there, &key), value(here, &key));
            differs_optionally(&key, there.as_ref(), here.as_ref())
        })
        .collect();
    // The object follows from the keys, unless a mesh's file has changed.
    if said.is_empty() {
        let (there, here) = (&there.object_crc32, &here.object_crc32);
        said.push(format!(
            "the object, by its checksum, is {there} there and {here} here"
        ));
    }
    said
}

/// A point by what it sets.
fn described(point: &KeptPoint) -> String {
    const SHOWN: usize = 3;
    let set = point.set.iter().filter(|(_, value)| !value.is_null());
    let set: Vec<String> = set
        .take(SHOWN)
        .map(|(key, value): (&String, &Value)| format!("`{key}` = {value}"))
        .collect();
    match set.as_slice() {
        [] => "the scenario as it is".to_owned(),
        some => some.join(", "),
    }
}
