//! The numbers of a run by name.

use serde_json::{Map, Value};

use crate::metrics::RunSummary;

/// The keys of a summary that are no numbers of their own: the seed; times, which differ from run to run; and the
/// table of faults.
const NO_METRICS: [&str; 3] = ["seed", "decision_ms", "faults"];

/// The metrics of a run by the names that they have in summary.json, in the same order: numbers, or null where a
/// run has none.
pub(super) fn metrics(summary: &RunSummary) -> Map<String, Value> {
    let Ok(Value::Object(mut keys)) = serde_json::to_value(summary) else {
        return Map::new();
    };
    keys.retain(|key, value| {
        !NO_METRICS.contains(&key.as_str()) && (value.is_number() || value.is_null())
    });
    // Points at which nothing can go wrong have the same columns as those at which much does.
    let faults = serde_json::to_value(summary.faults.unwrap_or_default());
    if let Ok(Value::Object(faults)) = faults {
        keys.extend(faults);
    }
    keys
}
