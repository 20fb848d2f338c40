//! What a file claims takes no memory: that grows with its bytes alone, and what is refused is told with its
//! limit.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

use std::fs;
use std::path::Path;

use adslam_diagnostics::InputError;
use adslam_experiment::tables::TablePlan;
use adslam_names::PlannerName;
use adslam_record::log::LogReader;
use adslam_record::{HistoryRecorder, RunHistory};
use adslam_scenario::Scenario;
use adslam_scenario::config::{Config, MOST_RUNS_IN_ALL, Published, Selection};
use adslam_setup::Setup;
use allocation_counter::measure;
use serde_json::{Value, json};

const MIB: u64 = 1 << 20;

/// What is read is refused, with `limit` in what is said, and takes little memory.
#[track_caller]
fn refused<T>(read: impl Fn() -> Result<T, InputError>, limit: &str) {
    let mut said = String::new();
    let memory = measure(|| {
        let error = read().err().unwrap();
        said = format!(
            "{}; {}",
            error.message(),
            error.remedy().unwrap_or_default()
        );
    });
    assert!(said.contains(limit), "{said}");
    assert!(memory.bytes_max < 16 * MIB, "{said}: {memory:?}");
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
    let heart = fs::read_to_string(repository("scenarios/heart.toml")).unwrap();
    let heart = heart.replacen("features = 50", "features = 1000000000", 1);
    refused(
        || Scenario::parse(&heart, Path::new("a.toml")),
        "from 4 to 2000",
    );
    let more: String = (0..2000).map(|i| format!("[{i}, 9, 1],\n")).collect();
    refused(
        || scenario("positions_cm = [\n", &format!("positions_cm = [\n{more}")),
        "2014 features are too many; give from 4 to 2000",
    );
    let documented = fs::read_to_string(repository("docs/log.md")).unwrap();
    let header = documented
        .lines()
        .find(|line| line.starts_with('{'))
        .unwrap();
    let log = |features: u64| {
        let text = header.replacen("\"features\": 2", &format!("\"features\": {features}"), 1);
        move || LogReader::new(text.as_bytes(), Path::new("a.jsonl")).map(drop)
    };
    refused(log(1_000_000_000), "up to 2000");
    refused(log(u64::MAX), "up to 2000");
    refused(
        log(2000),
        "2000 features, and gives the first positions of 2",
    );
}

#[test]
fn steps_that_are_yet_to_be_done() {
    let longest = scenario("steps = 100", "steps = 1000000").unwrap();
    let setup = Setup::new(&longest).unwrap();
    let memory = measure(|| drop(HistoryRecorder::new(&setup.model, PlannerName::GLOBAL, 1)));
    assert!(memory.bytes_max < MIB, "{memory:?}");
}

#[test]
fn values_within_values_without_end() {
    let within =
        |open: &str, close: &str, n: usize| format!("a = {}1{}\n", open.repeat(n), close.repeat(n));
    for n in [100, 10_000, 50_000] {
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
        || TablePlan::new(runs.clone(), &Selection::default()),
        &in_all,
    );
}

/// Each step of a hundred says that a trillion actions were scored.
#[test]
fn a_history() {
    let text = fs::read_to_string(repository("fuzz/corpus/history/local")).unwrap();
    let mut history: Value = serde_json::from_str(&text).unwrap();
    let mut step = history["steps"][1].clone();
    step["decision"]["scored"] = json!([0, 1_000_000_000_000_u64]);
    let steps = history["steps"].as_array_mut().unwrap();
    steps.truncate(1);
    steps.extend(vec![step; 100]);
    let text = history.to_string();
    let parse = || RunHistory::parse(Path::new("history.json"), &text);
    refused(parse, "traces, expected 1000000000000");
}
