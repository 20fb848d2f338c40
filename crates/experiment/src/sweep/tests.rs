//! Tests of sweeps: the points of a file, what is said about wrong ones, and the tables of made-up records.

use std::fs;
use std::path::PathBuf;

use serde_json::{Value, json};
use tempfile::TempDir;

use super::{Sweep, SweepPlan, SweepRecord, SweepResults};
use crate::config::{Config, check_file};
use crate::diagnostics::{FileKind, InputError};
use crate::metrics::{DecisionTimes, RunSummary};
use crate::scenario::Scenario;
use crate::scenario::tests::{POLYGON, assert_error, miette_report, repository};

const HEAD: &str = "title = \"t\"\nruns = 3\nscenario = \"polygon.toml\"\n\
    planners = [\"local\", \"global\"]\n";

/// A folder with the polygon and one sweep.
struct Folder(TempDir);

impl Folder {
    fn with(rest: &str) -> Self {
        let folder = Self(tempfile::tempdir().expect("a folder"));
        fs::write(folder.path("polygon.toml"), POLYGON).expect("a file");
        fs::write(folder.path("sweep.toml"), format!("{HEAD}{rest}\n")).expect("a file");
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
}

fn loaded(rest: &str) -> Result<Sweep, InputError> {
    Sweep::load(&Folder::with(rest).path("sweep.toml"))
}

/// The sweep is refused, and blamed itself.
#[track_caller]
fn refused(rest: &str, message: &str, pointed_at: &str, remedy: &str) {
    let result = loaded(rest);
    let path = result.as_ref().expect_err("an error").path();
    assert!(path.ends_with("sweep.toml"), "{}", path.display());
    assert_error(result, message, pointed_at, remedy);
}

#[test]
fn the_last_key_of_the_grid_varies_fastest_and_listed_points_come_after() {
    let sweep = loaded(
        "[set]\nsteps = 7\n[grid]\n\"sensor.range_cm\" = [2.0, 4]\n\
         \"noise.deformation_noise\" = [\"fresh\", \"accumulating\"]\n\
         [[points]]\nlabel = \"calm\"\nset = { \"noise.rotation_sigma_rad\" = 0.0, steps = 9 }\n",
    )
    .unwrap();
    let varied = [
        "sensor.range_cm",
        "noise.deformation_noise",
        "noise.rotation_sigma_rad",
        "steps",
    ];
    assert_eq!(sweep.varied, varied);
    let values: Vec<Vec<Option<Value>>> = sweep
        .points
        .iter()
        .map(|point| point.values.clone())
        .collect();
    // What a point leaves alone is the scenario's; what that leaves out is nothing.
    let expected = [
        json!([2.0, "fresh", 0.02, 7]),
        json!([2.0, "accumulating", 0.02, 7]),
        json!([4, "fresh", 0.02, 7]),
        json!([4, "accumulating", 0.02, 7]),
        json!([3.0, null, 0.0, 9]),
    ];
    assert_eq!(json!(values), json!(expected));
    assert_eq!(*sweep.points[2].scenario.sensor.range_cm, 4.0);
    assert_eq!(sweep.points[4].label.as_deref(), Some("calm"));
    assert_eq!(sweep.points[4].scenario.steps.get(), 9);
    assert_eq!(sweep.points[3].scenario.steps.get(), 7);
    assert_eq!(json!(sweep.points[0].overrides)["steps"], 7);
    assert_eq!((sweep.runs_in_all(3), sweep.first_seed), (Some(30), 1));
}

#[test]
fn whole_tables_and_elements_of_lists_are_varied_too() {
    let sweep = loaded(
        "[grid]\n\"planners.combined\" = [{ nearest_count = 3 }, { nearest_fraction = 0.5 }]\n\
         \"object.points.positions_cm[13]\" = [[1.5, 0.0, 5.0], [1.5, 0.0, 6.0]]\n",
    )
    .unwrap();
    assert_eq!(sweep.points.len(), 4);
    assert_eq!(
        sweep.points[3].values[0],
        Some(json!({"nearest_fraction": 0.5}))
    );
    assert_eq!(sweep.points[1].values[1], Some(json!([1.5, 0.0, 6.0])));
}

#[test]
fn a_wrong_value_is_shown_where_it_stands() {
    refused(
        "[grid]\n\"noise.rotation_sigma_rad\" = [0.1, -1.0]",
        "-1 is below 0",
        "-1.0",
        "0 or a number",
    );
    refused(
        "[grid]\n\"noise.rotatoin_sigma_rad\" = [0.1]",
        "unknown key `rotatoin_sigma_rad`",
        "\"noise.rotatoin_sigma_rad\"",
        "did you mean `rotation_sigma_rad`?",
    );
    refused(
        "[set]\n\"sensor.range_cm\" = \"far\"\n[grid]\nsteps = [5, 6]",
        "\"far\" cannot stand here",
        "\"far\"",
        "number",
    );
    refused(
        "[[points]]\n[points.set]\n\"steps\" = 5\n[[points]]\n[points.set]\n\"steps\" = 0",
        "0 is too small",
        "0",
        "whole number",
    );
    refused(
        "[grid]\n\"sensor.min_range_cm\" = [0.1, 4.0]\nsteps = [5, 6]",
        "with this override, the sensor sees from 4 cm",
        "4.0",
        "above 4",
    );
    refused(
        "[grid]\n\"steps.of.run\" = [1]",
        "there is no `steps.of.run`",
        "\"steps.of.run\"",
        "`steps` in",
    );
    refused(
        "[grid]\n\"motion.deformation.anchored.anchor\" = [0, 20]",
        "no feature 20",
        "20",
        "0 to 13",
    );
}

#[test]
fn what_is_no_sweep_is_explained() {
    refused("", "nothing is varied", "", "add a [grid]");
    refused("[set]\nsteps = 5", "nothing is varied", "", "[[points]]");
    refused(
        "[grid]\nsteps = 5",
        "`steps` has one value",
        "5",
        "belongs into [set]",
    );
    refused(
        "[grid]\nsteps = []",
        "this list has 0 values",
        "[]",
        "at least one",
    );
    refused(
        "[grid]\nsteps = [5, 6, 5]",
        "5 is listed twice",
        "5",
        "raise `runs`",
    );
    refused(
        "[grid]\nnoise.x = [5]",
        "is not in quotes",
        "noise",
        "\"noise.…\"",
    );
    refused(
        "[[points]]\nset.noise.x = 5",
        "is not in quotes",
        "noise",
        "in quotes",
    );
    refused(
        "[set]\nsteps = 5\n[grid]\nsteps = [6, 7]",
        "`steps` is varied in [grid] too",
        "steps = 5",
        "in one of the two",
    );
    let twice = "[[points]]\nlabel = \"a\"\n[[points]]\nlabel = \"a\"";
    refused(twice, "two points are called \"a\"", "\"a\"", "\"a-2\"");
    refused(
        "[[points]]\ncolour = 1",
        "unknown key `colour`",
        "colour",
        "`label`",
    );
    refused(
        "[girds]\nsteps = [5]",
        "unknown key `girds`",
        "girds",
        "`grid`",
    );
}

#[test]
fn more_than_can_be_run_is_refused() {
    let numbers = |count: u32| (1..=count).map(|n| format!("{n}, ")).collect::<String>();
    let wide = format!(
        "[grid]\nsteps = [{}]\n\"planners.global.samples\" = [{}]",
        numbers(200),
        numbers(100)
    );
    refused(
        &wide,
        "the grid has 200 · 100 points",
        "[grid]",
        "up to 10000 points",
    );
    let many = "[[points]]\nset = { steps = 5 }\n".repeat(1001);
    refused(
        &many,
        "1001 points are listed",
        "[[points]]",
        "list up to 1000",
    );
    let folder = Folder::with("[grid]\nsteps = [5, 6, 7, 8, 9, 10]");
    let path = folder.path("sweep.toml");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("runs = 3", "runs = 100000")).unwrap();
    let message = "6 points with 2 planners and 100000 runs of each are more than 1000000 runs";
    assert_error(Sweep::load(&path), message, "100000", "lower `runs`");
    fs::write(&path, text).unwrap();
    for (runs, help) in [
        (0, "1 to 100000"),
        (200_000, "1 to 100000"),
        (90_000, "fewer"),
    ] {
        let error = SweepPlan::load(&path, Some(runs)).unwrap_err();
        assert!(error.remedy().unwrap().contains(help), "{error}");
    }
    assert_eq!(SweepPlan::load(&path, Some(2)).unwrap().total_runs(), 24);
}

#[test]
fn planners_and_the_scenario_are_looked_at() {
    let folder = Folder::with("[grid]\nsteps = [5]");
    let path = folder.path("sweep.toml");
    let text = fs::read_to_string(&path).unwrap();
    for (old, new, message, pointed_at) in [
        (
            "\"global\"",
            "\"local\"",
            "the planner local is listed twice",
            "\"local\"",
        ),
        (
            "polygon.toml",
            "absent.toml",
            "absent.toml does not exist",
            "\"absent.toml\"",
        ),
        (
            "\"global\"",
            "\"globe\"",
            "`globe` is not one of the choices",
            "\"globe\"",
        ),
    ] {
        fs::write(&path, text.replace(old, new)).unwrap();
        assert_error(Sweep::load(&path), message, pointed_at, "");
    }
}

#[test]
fn kinds_of_files_are_told_apart() {
    let folder = Folder::with("[grid]\nsteps = [5]");
    let (sweep, scenario) = (folder.path("sweep.toml"), folder.path("polygon.toml"));
    assert_eq!(check_file(&sweep).unwrap().kind, FileKind::Sweep);
    let error = Config::load(&sweep).unwrap_err();
    assert!(
        error
            .message()
            .ends_with("is a sweep, and a configuration is needed")
    );
    assert_eq!(error.remedy(), Some("`adslam sweep` runs a sweep"));
    let error = Scenario::load(&sweep).unwrap_err();
    assert!(
        error
            .message()
            .ends_with("is a sweep, and a scenario is needed")
    );
    let error = Sweep::load(&scenario).unwrap_err();
    assert!(
        error
            .message()
            .ends_with("is a scenario, and a sweep is needed")
    );
    let error = Sweep::load(&repository("configs/paper.toml")).unwrap_err();
    assert!(error.remedy().unwrap().contains("adslam tables"), "{error}");
}

#[test]
fn the_shipped_sweeps_can_be_run() {
    let entries = fs::read_dir(repository("sweeps")).unwrap();
    let paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    assert!(!paths.is_empty());
    for path in paths {
        let plan = SweepPlan::load(&path, None).unwrap();
        assert!(plan.total_runs() > 100, "{}", path.display());
        assert!(plan.warnings().is_empty(), "{:?}", plan.warnings());
    }
}

/// A run whose numbers follow from its seed and an offset.
fn record(seed: u64, offset: f64) -> SweepRecord {
    let value = offset + (seed * seed) as f64 / 64.0;
    let summary = RunSummary {
        seed,
        observed: 100,
        steps_to_full_coverage: (seed > 2).then_some(20),
        pose_error_mean: value,
        pose_error_max: value,
        feature_error_mean: value,
        feature_error_max: value,
        relative_pose_error_mean: value,
        relative_feature_error_mean: value,
        pose_nees_mean: None,
        feature_nees_mean: Some(3.0),
        steps_inside_object: 0,
        steps_below_clearance: 0,
        compromised_decisions: 0,
        decision_ms: DecisionTimes::default(),
    };
    let warnings = vec!["polygon: no viewpoint sees features 3".to_owned()];
    SweepRecord { summary, warnings }
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
    let records: Vec<Option<SweepRecord>> = of_planner(0.25, 1)
        .chain(of_planner(0.5, 1))
        .chain(of_planner(0.25, 3))
        .chain(of_planner(0.5, 1))
        .collect();
    let results = SweepResults::new(&plan, &records);
    assert_eq!((results.missing(), results.warnings().len()), (2, 1));
    let folder = tempfile::tempdir().unwrap();
    let files = results.write(folder.path()).unwrap();
    assert_eq!(files.len(), 7);

    let runs = lines(&folder, "runs.jsonl");
    assert_eq!(runs.len(), 30);
    assert_eq!(runs[16]["seed"], 3, "the first run that did not fail");
    assert_eq!(
        (&runs[16]["point"], &runs[16]["steps"]),
        (&json!(2), &json!(6))
    );
    assert!(runs[0].get("decision_ms").is_none(), "{}", runs[0]);
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
        "8 runs of each planner at each point of `polygon`, seeds 1 to 8.",
        "| point | `steps` |",
        "20.0 (20.0 to 20.0), 6 of 8 runs",
        "2 of 2 differences between planners have",
        "| 1     | 5       | local − global | -0.250 (-0.250 to -0.250) |  0.00781 |",
    ] {
        assert!(markdown.contains(part), "no {part:?} in {markdown}");
    }
}

#[test]
fn few_runs_are_remarked_on() {
    let place = Folder::with("[grid]\nsteps = [5]");
    let plan = SweepPlan::load(&place.path("sweep.toml"), Some(5)).unwrap();
    let records: Vec<_> = (0..10).map(|k| Some(record(k % 5 + 1, 0.0))).collect();
    let folder = tempfile::tempdir().unwrap();
    SweepResults::new(&plan, &records)
        .write(folder.path())
        .unwrap();
    let markdown = fs::read_to_string(folder.path().join("table.md")).unwrap();
    assert!(markdown.contains("5 runs are too few"), "{markdown}");
    assert!(markdown.contains("it takes 6."), "{markdown}");
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig {
        cases: 64, failure_persistence: None, ..Default::default()
    })]

    #[test]
    fn no_grid_panics(
        table in proptest::sample::select(vec!["[grid]", "[set]", "[[points]]\n[points.set]", "[points]"]),
        path in "[a-z_.\\[\\]0-9]{0,30}|(noise|object|motion|robot|steps)[a-z_.\\[\\]0-9]{0,20}",
        value in proptest::sample::select(vec!["1", "[]", "[1, 2]", "[[1], {}]", "{ a = [1] }", "[nan]"]),
    ) {
        let both = format!("{table}\n\"{path}\" = {value}\n");
        if let Err(error) = loaded(&both) {
            drop(miette_report(&error));
        }
    }
}
