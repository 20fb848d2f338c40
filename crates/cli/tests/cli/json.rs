//! `--json`: one object on the standard output, whatever happens.

use serde_json::{Value, json};

use super::support::{BAD_INPUT, Place, lines, log, polygon};
use super::tables::config;

/// Runs the command with `--json`; returns the exit code and the object.
fn answered(place: &Place, arguments: &str) -> (Option<i32>, Value) {
    let output = place
        .command(&format!("{arguments} --json"))
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(text.lines().count(), 1, "{text}");
    (output.status.code(), serde_json::from_str(&text).unwrap())
}

#[test]
fn a_run_and_its_page() {
    let place = Place::new(&[("polygon.toml", &polygon(&[]))]);
    let (code, answer) = answered(
        &place,
        "run polygon.toml --planner local --seed 4 --out run",
    );
    assert_eq!((code, &answer["ok"]), (Some(0), &json!(true)));
    assert_eq!(answer["planner"], "local");
    assert_eq!(answer["summary"]["seed"], 4);
    assert_eq!(
        answer["summary"],
        place.json("run/summary.json"),
        "{answer}"
    );
    let files = answer["files"].as_array().unwrap();
    assert!(files.contains(&json!("run/steps.csv")), "{files:?}");
    for file in files {
        assert!(place.path(file.as_str().unwrap()).is_file(), "{file}");
    }
    let (code, answer) = answered(&place, "replay run --out page.html");
    assert_eq!((code, &answer["files"]), (Some(0), &json!(["page.html"])));
}

#[test]
fn tables_and_a_log() {
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("config.toml", &config(2, &["predetermined"])),
        ("log.jsonl", &lines(&log())),
    ]);
    let (code, answer) = answered(&place, "tables config.toml --out tables");
    assert_eq!((code, &answer["complete"]), (Some(0), &json!(true)));
    assert_eq!(
        answer["files"],
        json!(["tables/tables.md", "tables/tables.json"])
    );
    let (code, answer) = answered(&place, "filter log.jsonl --out estimates.jsonl");
    assert_eq!((code, &answer["steps"]), (Some(0), &json!(4)));
    let (code, answer) = answered(&place, "new scenario");
    assert_eq!(
        (code, &answer["files"]),
        (Some(0), &json!(["scenario.toml"]))
    );
}

#[test]
fn a_wrong_file_is_told_with_its_place() {
    let place = Place::new(&[
        ("good.toml", &polygon(&[])),
        (
            "typo.toml",
            &polygon(&[("range_cm = 3.0", "rang_cm = 3.0")]),
        ),
    ]);
    let (code, answer) = answered(&place, "check good.toml typo.toml absent.toml");
    assert_eq!((code, &answer["ok"]), (Some(BAD_INPUT), &json!(false)));
    assert_eq!(answer["exit_code"], BAD_INPUT);
    let checked = answer["checked"].as_array().unwrap();
    assert_eq!(
        checked[0],
        json!({"file": "good.toml", "valid": true, "kind": "scenario", "warnings": []})
    );
    let typo = &checked[1]["error"];
    assert_eq!(typo["message"], "unknown key `rang_cm`");
    assert!(
        typo["help"]
            .as_str()
            .unwrap()
            .contains("did you mean `range_cm`?")
    );
    let text = place.read("typo.toml");
    let line = text
        .lines()
        .position(|line| line.starts_with("rang_cm"))
        .unwrap()
        + 1;
    assert_eq!((&typo["line"], &typo["column"]), (&json!(line), &json!(1)));
    assert_eq!(checked[2]["error"]["line"], Value::Null);

    let (code, answer) = answered(&place, "run typo.toml --planner local --out run");
    assert_eq!(code, Some(BAD_INPUT));
    assert_eq!(answer["error"], *typo);
}

#[test]
fn a_failure_is_told_too() {
    let place = Place::new(&[("polygon.toml", &polygon(&[])), ("file", "")]);
    let (code, answer) = answered(&place, "run polygon.toml --planner local --out file/run");
    assert_eq!((code, &answer["ok"]), (Some(BAD_INPUT), &json!(false)));
    assert!(answer["error"]["help"].is_string(), "{answer}");
    assert!(
        answer["error"]["message"]
            .as_str()
            .unwrap()
            .contains("file/run"),
        "{answer}"
    );
}
