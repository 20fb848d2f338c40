//! Every example does what its header says.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use assert_cmd::assert::OutputAssertExt;
use serde_json::Value;

fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// What the example prints, started in the folder `at`.
fn printed(command: &mut Command, at: &Path) -> String {
    let output = command
        .current_dir(at)
        .assert()
        .success()
        .get_output()
        .clone();
    text(&output.stdout)
}

/// A scenario of few steps, in which the planner of the example has a key.
fn short_scenario(folder: &Path, more: &str) -> PathBuf {
    let whole = fs::read_to_string(repository("scenarios/polygon.toml")).unwrap();
    let path = folder.join("short.toml");
    fs::write(&path, whole.replacen("steps = 100", "steps = 6", 1) + more).unwrap();
    path
}

#[test]
fn a_planner_of_ones_own_enters_runs_tables_and_replays() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let command = || Command::new(env!("CARGO_BIN_EXE_own_planner"));
    short_scenario(at, "\n[planners.curious]\nlaziness_per_cm = 0.5\n");
    let run = [
        "run",
        "short.toml",
        "--planner",
        "curious",
        "--out",
        "run",
        "--html",
    ];
    assert!(printed(command().args(run), at).contains("curious, seed 1"));
    let history: Value =
        serde_json::from_slice(&fs::read(at.join("run/history.json")).unwrap()).unwrap();
    assert_eq!(history["planner"], "curious");
    assert_eq!(history["planner_look"]["label"], "Curious");
    let page = fs::read_to_string(at.join("run/replay.html")).unwrap();
    assert!(page.contains("polygon, Curious, seed 1"));
    let as_run = fs::read_to_string(at.join("run/scenario.toml")).unwrap();
    assert!(
        as_run.contains("[planners.curious]\nlaziness_per_cm = 0.5"),
        "{as_run}"
    );
    let config = "title = \"own\"\n[[experiments]]\nscenario = \"short.toml\"\nplanners = [\"curious\", \"local\"]\n";
    fs::write(at.join("own.toml"), config).unwrap();
    printed(
        command().args([
            "tables", "own.toml", "--runs", "2", "--out", "tables", "--html",
        ]),
        at,
    );
    let tables = fs::read_to_string(at.join("tables/tables.md")).unwrap();
    assert!(tables.contains("curious"), "{tables}");
    let report = fs::read_to_string(at.join("tables/report.html")).unwrap();
    assert!(report.contains("curious"));
}

#[test]
fn the_keys_and_the_name_of_ones_own_planner_are_checked() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    short_scenario(at, "\n[planners.curious]\nlazyness_per_cm = 0.5\n");
    let own = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_own_planner"));
        let output = command.args(arguments).current_dir(at).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        text(&output.stderr)
    };
    let said = own(&["check", "short.toml"]);
    assert!(said.contains("unknown key `lazyness_per_cm`"), "{said}");
    assert!(said.contains("did you mean `laziness_per_cm`"), "{said}");
    let said = own(&["run", "short.toml", "--planner", "curios", "--out", "run"]);
    assert!(said.contains("did you mean curious?"), "{said}");
    let schema = printed(
        Command::new(env!("CARGO_BIN_EXE_own_planner")).args(["schema", "scenario"]),
        at,
    );
    assert!(schema.contains("laziness_per_cm"));
}

#[test]
fn an_episode_can_be_stepped_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = short_scenario(folder.path(), "");
    let mut command = Command::new(env!("CARGO_BIN_EXE_episode"));
    assert!(printed(command.arg(scenario), folder.path()).contains("mean pose error"));
}

#[test]
fn a_live_loop_answers_every_step() {
    let log = File::open(repository("samples/polygon.log.jsonl")).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_live_loop"));
    let said = printed(command.stdin(log), Path::new("."));
    let lines: Vec<Value> = said
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let steps = fs::read_to_string(repository("samples/polygon.log.jsonl"))
        .unwrap()
        .lines()
        .count()
        - 1;
    assert_eq!(lines.len(), steps);
    assert!(
        lines
            .iter()
            .all(|line| line["sigma"][3].as_f64().unwrap() > 0.0)
    );
}

#[test]
fn every_estimator_goes_through_a_recorded_log() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_recorded_log"));
    let said = printed(
        command.arg(repository("samples/polygon.log.jsonl")),
        Path::new("."),
    );
    assert_eq!(said.lines().count(), 3);
    assert!(said.contains("right_invariant_ekf"), "{said}");
}

#[test]
fn two_planners_are_compared_from_code() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = short_scenario(folder.path(), "");
    let mut command = Command::new(env!("CARGO_BIN_EXE_study_from_code"));
    let said = printed(command.arg(scenario).arg("3"), folder.path());
    assert!(said.starts_with("local - global: "), "{said}");
}
