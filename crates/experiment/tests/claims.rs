//! What a file claims takes no memory: that grows with its bytes alone, and what is refused is told with its
//! limit.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

use std::fs;
use std::path::Path;

use adslam_experiment::config::{Config, MOST_RUNS_IN_ALL, Published};
use adslam_experiment::diagnostics::InputError;
use adslam_experiment::log::LogReader;
use adslam_experiment::run::{HistoryRecorder, RunHistory, Setup};
use adslam_experiment::scenario::{PlannerName, Scenario};
use adslam_experiment::tables::{TablePlan, TablesOptions};
use allocation_counter::measure;
use serde_json::{Value, json};

const MIB: u64 = 1 << 20;

/// What is read is refused, with `limit` in what is said, and takes little memory.
#[track_caller]
fn refused<T>(read: impl Fn() -> Result<T, InputError>, limit: &str) {
    let mut said = String::new();
    let memory = measure(|| {
        let error = read().err().unwrap();
        said = format!("{error}; {}", error.remedy().unwrap_or_default());
    });
    assert!(said.contains(limit), "{said}");
    assert!(memory.bytes_max < 4 * MIB, "{said}: {memory:?}");
}

fn repository(path: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

fn polygon() -> String {
    fs::read_to_string(repository("scenarios/polygon.toml")).unwrap()
}

fn scenario(from: &str, to: &str) -> Result<Scenario, InputError> {
    let polygon = polygon();
    assert!(polygon.contains(from), "no {from}");
    Scenario::parse(&polygon.replacen(from, to, 1), Path::new("a.toml"))
}

#[test]
fn counts_in_scenarios() {
    let most = "from 1 to 1000000";
    refused(|| scenario("steps = 100", "steps = 1000000000"), most);
    refused(
        || scenario("samples = 50", "samples = 9223372036854775807"),
        most,
    );
    let grid = |spacing| scenario("spacing_cm = 1.0", spacing);
    refused(|| grid("spacing_cm = 1e-9"), "at most 100000");
    refused(|| grid("spacing_cm = 0.01"), "at most 100000");
    let far = "max_cm = [1e6, 1e6, 1e6]";
    refused(
        || scenario("max_cm = [4.5, 3.0, 6.0]", far),
        "at most 100000",
    );
    let thousand = (0..1000)
        .map(|i| i.to_string())
        .collect::<Vec<_>>()
        .join(", ");
    let yaw = format!("yaw_deg = [{thousand}]");
    let wide = || scenario("yaw_deg = [-45.0, -22.5, 0.0, 22.5, 45.0]", &yaw);
    refused(wide, "135000 actions; shorten them to 100000");
}

#[test]
fn features_that_no_memory_holds() {
    let phantom = "[object.phantom]\nfeatures = 1000000000\n[object.unused]";
    refused(|| scenario("[object.points]", phantom), "from 4 to 2000");
    let more: String = (0..2000)
        .map(|i| format!("[{i}, 9, {}],\n", i * i))
        .collect();
    refused(
        || scenario("positions_cm = [\n", &format!("positions_cm = [\n{more}")),
        "2014 features are too many; give from 4 to 2000",
    );
    let header = |features: u64| {
        json!({
            "format": "adslam-log", "version": 1, "length_unit": "cm", "features": features,
            "initial": {
                "pose": [0; 6], "features": [[0, 0, 0]],
                "pose_covariance": [[0; 6], [0; 6], [0; 6], [0; 6], [0; 6], [0; 6]],
                "feature_sigma": 0.1,
            },
            "noise": {
                "rotation_sigma": 0.1, "translation_sigma": 0.1, "feature_motion_sigma": 0.1,
                "feature_measurement_sigma": 0.1, "structure_measurement_sigma": 0.1,
            },
        })
        .to_string()
    };
    let log = |features| {
        let text = header(features);
        move || LogReader::new(text.as_bytes(), Path::new("a.jsonl")).map(drop)
    };
    refused(log(1_000_000_000), "up to 2000");
    refused(log(u64::MAX), "up to 2000");
    refused(
        log(2000),
        "2000 features, and gives the first positions of 1",
    );
}

#[test]
fn steps_that_are_yet_to_be_done() {
    let longest = scenario("steps = 100", "steps = 1000000").unwrap();
    let setup = Setup::new(&longest).unwrap();
    let memory = measure(|| drop(HistoryRecorder::new(&setup, PlannerName::Global, 1)));
    assert!(memory.bytes_max < MIB, "{memory:?}");
}

#[test]
fn values_within_values_without_end() {
    let within =
        |open: &str, close: &str, n: usize| format!("a = {}1{}\n", open.repeat(n), close.repeat(n));
    for n in [100, 10_000, 100_000] {
        for text in [within("[", "]", n), within("{a=", "}", n)] {
            refused(|| Scenario::parse(&text, Path::new("a.toml")), "TOML");
            refused(|| Published::parse(&text, Path::new("a.toml")), "TOML");
        }
        for text in ["[".repeat(n), "{\"a\":".repeat(n)] {
            let file = Path::new("history.json");
            refused(|| RunHistory::parse(file, &text), "history");
            refused(|| LogReader::new(text.as_bytes(), file).map(drop), "header");
        }
    }
    let dotted = format!("{} = 1\n", vec!["a"; 50_000].join("."));
    refused(|| Scenario::parse(&dotted, Path::new("a.toml")), "TOML");
    let heads = format!("[{}]\n", vec!["a"; 50_000].join("."));
    refused(|| Scenario::parse(&heads, Path::new("a.toml")), "TOML");
}

const EXPERIMENT: &str =
    "[[experiments]]\nscenario = \"../scenarios/polygon.toml\"\nplanners = [\"global\"]\n";

fn config(text: &str) -> Result<Config, InputError> {
    Config::parse(text, &repository("configs/test.toml"))
}

#[test]
fn overrides_that_lead_nowhere() {
    let set = |key: &str| format!("title = \"t\"\n{EXPERIMENT}set = {{ \"{key}\" = 1 }}\n");
    let longest = set(&vec!["a"; 50_000].join("."));
    refused(|| config(&longest), "has no such part");
    let longest = set(&format!("robot.actions.yaw_deg{}", "[0]".repeat(50_000)));
    refused(|| config(&longest), "has no such part");
    refused(
        || config(&set("robot.actions.yaw_deg[1000000000]")),
        "has no such part",
    );
}

#[test]
fn experiments_and_runs_and_overrides_without_end() {
    let many = format!("title = \"t\"\n{}", EXPERIMENT.repeat(1001));
    refused(|| config(&many), "1001 experiments; write at most 1000");
    let keys: Vec<String> = (0..1001).map(|i| format!("\"a{i}\" = 1")).collect();
    let set = format!(
        "title = \"t\"\n{EXPERIMENT}set = {{ {} }}\n",
        keys.join(", ")
    );
    refused(|| config(&set), "1001 overrides; write at most 1000");

    let labelled: String = (0..11)
        .map(|i| format!("{EXPERIMENT}label = \"e{i}\"\n"))
        .collect();
    let runs = config(&format!("title = \"t\"\nruns = 100000\n{labelled}")).unwrap();
    let in_all = format!(
        "1100000 runs to do in all; ask for fewer of each planner, or for fewer \
                          experiments with --only: at most {MOST_RUNS_IN_ALL} runs"
    );
    refused(
        || TablePlan::new(runs.clone(), &TablesOptions::default()),
        &in_all,
    );
}

#[test]
fn a_history() {
    let setup = Setup::new(&scenario("steps = 100", "steps = 2").unwrap()).unwrap();
    let history = HistoryRecorder::new(&setup, PlannerName::Global, 1).into_history();
    let mut claims = serde_json::to_value(&history).unwrap();
    let decision = |scored: Value| {
        json!({
            "control": [0; 6], "action": null, "goal": null, "admissible": 0, "safe": 0,
            "compromised": false, "predicted_trace": null, "milliseconds": 0, "scored": scored,
            "traces": [],
        })
    };
    let step = |decision: Value| {
        json!({
            "pose": [0; 6], "estimated_pose": [0; 6], "pose_sigma": [0; 6], "features": [[0; 3]],
            "estimated_features": [[0; 3]], "feature_covariances": [[0; 6]], "visible": [],
            "object": { "base_cm": [0; 3], "r_d": [0; 9], "amounts": [] }, "decision": decision,
            "metrics": {
                "pose_error": 0, "orientation_error_rad": 0, "position_error_cm": 0,
                "relative_pose_error": 0, "feature_error_mean_cm": 0, "feature_error_max_cm": 0,
                "relative_feature_error_cm": 0, "pose_nees": null, "feature_nees": null, "trace": 0,
                "covered": 0, "surface_distance_cm": 0,
            },
        })
    };
    claims["topology"] = json!([]);
    let scored = decision(json!([0, 1_000_000_000_000_u64]));
    let mut steps = vec![step(Value::Null)];
    steps.extend((0..100).map(|_| step(scored.clone())));
    claims["steps"] = steps.into();
    let text = claims.to_string();
    let parse = || RunHistory::parse(Path::new("history.json"), &text);
    refused(parse, "step 2: 0 traces, expected 1000000000000");
}
