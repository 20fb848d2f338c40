//! The numbers of a run by name.

use adslam_simulation::RunSummary;
use serde_json::{Map, Value};

/// The keys of a summary that are no numbers of their own: the seed; times, which differ from run to run; and the
/// table of faults.
const NO_METRICS: [&str; 3] = ["seed", "decision_ms", "faults"];

/// The metric that some runs never reach: null is not missing but never, and later than any step.
pub(super) const STEPS_TO_SEE_ALL: &str = "steps_to_full_coverage";
/// Whether a run reached it: 1 or 0, whose mean is the share of the runs that do.
pub(super) const SEES_ALL: &str = "sees_all";

/// The metrics of a run by the names that they have in summary.json, in the same order: numbers, or null where a
/// run has none.
pub(super) fn metrics(summary: &RunSummary) -> Map<String, Value> {
    let Ok(Value::Object(mut keys)) = serde_json::to_value(summary) else {
        return Map::new();
    };
    keys.retain(|key, value| {
        !NO_METRICS.contains(&key.as_str()) && (value.is_number() || value.is_null())
    });
    let sees_all = summary.steps_to_full_coverage.is_some();
    keys.insert(SEES_ALL.to_owned(), u8::from(sees_all).into());
    // Points at which nothing can go wrong have the same columns as those at which much does.
    let faults = serde_json::to_value(summary.faults.unwrap_or_default());
    if let Ok(Value::Object(faults)) = faults {
        keys.extend(faults);
    }
    keys
}
