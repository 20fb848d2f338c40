//! Points of a study: a setup each, and the planners that run there.

use std::collections::HashSet;

use super::StudyUnit;
use crate::run::Setup;
use crate::scenario::PlannerName;

/// A point: where, and by which planners.
pub(crate) type Point<'a> = (&'a Setup, &'a [PlannerName]);

/// The runs: point by point, planner by planner, as many seeds as there are `runs`, counted up from the
/// first.
pub(crate) fn units<'a>(
    points: impl Iterator<Item = Point<'a>>,
    first_seed: u64,
    runs: usize,
) -> Vec<StudyUnit<'a>> {
    let of_point = |(point, (setup, planners)): (usize, Point<'a>)| {
        planners.iter().flat_map(move |&planner| {
            (0..runs as u64).map(move |run| StudyUnit {
                point,
                setup,
                planner,
                seed: first_seed.wrapping_add(run),
            })
        })
    };
    points.enumerate().flat_map(of_point).collect()
}

/// What the user should know before running, each once: of the setups, then of the planners' deadlines.
pub(crate) fn warnings<'a>(points: impl Iterator<Item = Point<'a>> + Clone) -> Vec<String> {
    let of_setups = points.clone().flat_map(|(setup, _)| &setup.warnings);
    let of_deadlines = points.flat_map(|(setup, planners)| {
        let warning = |planner: &PlannerName| setup.deadline_warning(*planner);
        planners.iter().filter_map(warning)
    });
    distinct(of_setups.cloned().chain(of_deadlines))
}

/// Each text once, in order.
pub(crate) fn distinct(texts: impl Iterator<Item = String>) -> Vec<String> {
    let mut seen = HashSet::new();
    texts.filter(|text| seen.insert(text.clone())).collect()
}
