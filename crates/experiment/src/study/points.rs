//! What is said of the points of a study before it runs.

use std::collections::HashSet;

use adslam_names::PlannerName;

use super::StudyPoint;

/// What the user should know before running, each once: of the setups, then of the planners' deadlines.
pub(crate) fn warnings<'a>(points: impl Iterator<Item = StudyPoint<'a>> + Clone) -> Vec<String> {
    let of_setups = points.clone().flat_map(|point| &point.setup.warnings);
    let of_deadlines = points.flat_map(
        |StudyPoint {
             setup, planners, ..
         }| {
            let warning = |planner: &PlannerName| setup.deadline_warning(*planner);
            planners.iter().filter_map(warning)
        },
    );
    distinct(of_setups.cloned().chain(of_deadlines))
}

/// Each text once, in order.
pub(crate) fn distinct(texts: impl Iterator<Item = String>) -> Vec<String> {
    let mut seen = HashSet::new();
    texts.filter(|text| seen.insert(text.clone())).collect()
}
