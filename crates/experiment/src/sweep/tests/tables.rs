//! The tables of made-up records.

use std::fs;

use adslam_simulation::RunSummary;
use serde_json::{Value, json};
use tempfile::TempDir;

use super::Folder;
use crate::study::SummaryRecord;
use crate::sweep::{SweepPlan, SweepResults};

/// A run whose numbers follow from its seed and an offset.
fn record(seed: u64, offset: f64) -> SummaryRecord {
    let value = offset + (seed * seed) as f64 / 64.0;
    let summary = RunSummary {
        seed,
        observed: 100,
        steps_to_full_coverage: (seed > 2).then_some(20),
        pose_error_mean: value,
        drift_floor_mean: 0.1,
        geodesic_orientation_error_mean: Some(value),
        position_error_mean: Some(value),
        pose_error_max: value,
        feature_error_mean: value,
        feature_error_max: value,
        relative_pose_error_mean: value,
        relative_geodesic_orientation_error_mean: Some(value),
        relative_position_error_mean: Some(value),
        relative_feature_error_mean: value,
        pose_nees_mean: None,
        feature_nees_mean: Some(3.0),
        joint_nees_per_dof_mean: Some(1.0),
        feature_nis_per_dof: Some(1.0),
        structure_nis_per_dof: None,
        rejected_measurements: 0,
        faults: None,
        steps_inside_object: 0,
        steps_below_clearance: 0,
        compromised_decisions: 0,
        limits_waived_decisions: 0,
        abandoned_viewpoints: 0,
        decision_ms: None,
    };
    let warnings = vec!["polygon: no viewpoint sees features 3".to_owned()];
    SummaryRecord { summary, warnings }
}

/// The lines of a table as JSON.
fn lines(folder: &TempDir, name: &str) -> Vec<Value> {
    let text = fs::read_to_string(folder.path().join(name)).unwrap();
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

#[test]
fn the_tables_say_what_the_records_do() {
    let place = Folder::with("[grid]\nsteps = [5, 6]");
    let plan = SweepPlan::load(&place.path("sweep.toml"), Some(8)).unwrap();
    // At the second point the local planner fails at seeds 1 and 2.
    let of_planner = |offset: f64, first: u64| {
        (1..=8).map(move |seed| (seed >= first).then(|| record(seed, offset)))
    };
    let records: Vec<Option<SummaryRecord>> = of_planner(0.25, 1)
        .chain(of_planner(0.5, 1))
        .chain(of_planner(0.25, 3))
        .chain(of_planner(0.5, 1))
        .collect();
    let results = SweepResults::new(&plan, &records, Vec::new());
    assert_eq!((results.missing(), results.warnings().len()), (2, 1));
    let folder = tempfile::tempdir().unwrap();
    let files = results.write(folder.path()).unwrap();
    let formats = if cfg!(feature = "parquet") { 3 } else { 2 };
    assert_eq!(files.len(), 3 * formats + 1);

    let runs = lines(&folder, "runs.jsonl");
    assert_eq!(runs.len(), 30);
    assert_eq!(runs[16]["seed"], 3, "the first run that did not fail");
    assert_eq!(
        (&runs[16]["point"], &runs[16]["steps"]),
        (&json!(2), &json!(6))
    );
    for name in ["decision_ms", "faults"] {
        assert!(runs[0].get(name).is_none(), "{}", runs[0]);
    }
    assert_eq!(runs[0]["outliers"], 0);
    assert_eq!(runs[0]["steps_to_full_coverage"], Value::Null);

    let table = lines(&folder, "table.jsonl");
    assert_eq!(table.len(), 4);
    let mean = |row: &Value| row["pose_error_mean_mean"].as_f64().unwrap();
    assert_eq!(mean(&table[0]), 0.25 + 204.0 / 64.0 / 8.0);
    assert_eq!(mean(&table[2]), 0.25 + 199.0 / 64.0 / 6.0);
    assert_eq!(
        (&table[2]["runs"], &table[2]["failures"]),
        (&json!(6), &json!(2))
    );
    assert_eq!(table[0]["steps_to_full_coverage_count"], 6);
    assert_eq!(table[0]["pose_nees_mean_count"], 0);
    assert_eq!(table[0]["pose_nees_mean_mean"], Value::Null);

    let comparisons = lines(&folder, "comparisons.jsonl");
    let of_pose_error = |point: i32| {
        let mut rows = comparisons.iter();
        rows.find(|row| row["metric"] == "pose_error_mean" && row["point"] == point)
            .unwrap()
    };
    let row = of_pose_error(1);
    assert_eq!(
        (&row["planner"], &row["other"]),
        (&json!("local"), &json!("global"))
    );
    for name in ["difference_mean", "difference_low", "difference_high"] {
        assert_eq!(row[name], -0.25, "{row}");
    }
    assert_eq!(
        (&row["p"], &row["p_holm"]),
        (&json!(2.0 / 256.0), &json!(2.0 / 256.0))
    );
    // Only seeds that both have.
    let row = of_pose_error(2);
    assert_eq!((&row["pairs"], &row["p"]), (&json!(6), &json!(2.0 / 64.0)));

    let csv = fs::read_to_string(folder.path().join("table.csv")).unwrap();
    assert!(
        csv.starts_with("point,label,steps,planner,runs,failures,observed_count,observed_mean,")
    );
    assert_eq!(csv.lines().count(), 5);
    let markdown = fs::read_to_string(folder.path().join("table.md")).unwrap();
    for part in [
        "**Incomplete: 2 runs failed.**",
        "Each planner at each point of `polygon` with the seeds 1 to 8.",
        "| point | `steps` |",
        "20.0 (20.0 to 20.0), 2 of 8 never",
        "## Share of the runs that see all features",
        "0.75 (0.35 to 0.97)",
        "2 of 2 differences between planners have",
        "| 1     | 5       | local − global | -0.250 (-0.250 to -0.250) |  0.00781 |",
    ] {
        assert!(markdown.contains(part), "no {part:?} in {markdown}");
    }
}

/// The first planner is later where both see all, but the second fails to in most runs: the test says who is better,
/// and its share is told with an interval of its own.
#[test]
fn a_run_that_never_sees_all_is_last() {
    let place = Folder::with("[grid]\nsteps = [5]");
    let plan = SweepPlan::load(&place.path("sweep.toml"), Some(10)).unwrap();
    let with_steps = |seed: u64, steps: Option<usize>| {
        let mut record = record(seed, 0.0);
        record.summary.steps_to_full_coverage = steps;
        Some(record)
    };
    let local = (1..=10).map(|seed| with_steps(seed, Some(30)));
    let global = (1..=10).map(|seed| with_steps(seed, (seed == 1).then_some(20)));
    let records: Vec<_> = local.chain(global).collect();
    let folder = tempfile::tempdir().unwrap();
    SweepResults::new(&plan, &records, Vec::new())
        .write(folder.path())
        .unwrap();
    let comparisons = lines(&folder, "comparisons.jsonl");
    let of = |metric: &str| {
        let mut rows = comparisons.iter();
        rows.find(|row| row["metric"] == metric).unwrap()
    };
    let steps = of("steps_to_full_coverage");
    assert_eq!(
        [&steps["pairs"], &steps["smaller"], &steps["larger"]],
        [&json!(10), &json!(9), &json!(1)]
    );
    assert_eq!(
        (&steps["difference_count"], &steps["difference_mean"]),
        (&json!(1), &json!(10.0)),
        "of the pair in which both see all"
    );
    assert!(steps["p"].as_f64().unwrap() < 0.02, "{steps}");
    assert_eq!(of("sees_all")["difference_mean"], 0.9);
    let table = lines(&folder, "table.jsonl");
    let share = |name: &str| table[1][&format!("sees_all_{name}")].as_f64().unwrap();
    assert_eq!((share("mean"), share("count")), (0.1, 10.0));
    assert!((share("low") - 0.002_529).abs() < 1e-6 && (share("high") - 0.445_016).abs() < 1e-6);
    let markdown = fs::read_to_string(folder.path().join("table.md")).unwrap();
    for part in ["9 of 10 never", " 9, 1, 0 |", "0.10 (0.00 to 0.45)"] {
        assert!(markdown.contains(part), "no {part:?} in {markdown}");
    }
}

#[test]
fn few_runs_are_remarked_on() {
    let place = Folder::with("[grid]\nsteps = [5]");
    let plan = SweepPlan::load(&place.path("sweep.toml"), Some(5)).unwrap();
    let records: Vec<_> = (0..10).map(|k| Some(record(k % 5 + 1, 0.0))).collect();
    let folder = tempfile::tempdir().unwrap();
    SweepResults::new(&plan, &records, Vec::new())
        .write(folder.path())
        .unwrap();
    let markdown = fs::read_to_string(folder.path().join("table.md")).unwrap();
    assert!(markdown.contains("5 is too few runs"), "{markdown}");
    assert!(markdown.contains("it takes 6."), "{markdown}");
}

#[test]
fn points_that_all_have_labels_are_told_by_them() {
    let place = Folder::with(
        "[[points]]\nlabel = \"as-is\"\n[[points]]\nlabel = \"short\"\nset = { steps = 6 }",
    );
    let plan = SweepPlan::load(&place.path("sweep.toml"), Some(1)).unwrap();
    let records: Vec<Option<SummaryRecord>> = (0..4).map(|_| Some(record(1, 0.0))).collect();
    let folder = tempfile::tempdir().unwrap();
    SweepResults::new(&plan, &records, Vec::new())
        .write(folder.path())
        .unwrap();
    let text = fs::read_to_string(folder.path().join("table.md")).unwrap();
    assert!(
        text.contains("1. as-is: as the scenario\n2. short: `steps` = 6\n"),
        "{text}"
    );
    assert!(
        !text.contains("| `steps` "),
        "the key has no column: {text}"
    );
}
