//! Logs whose steps cannot be used: the message has the line, what is wrong with it and what to write.

use std::fs;

use serde_json::{Value, json};

use super::support::{Place, lines, log};

pub(super) const FILTER: &str = "filter log.jsonl --out estimates.jsonl";

/// A place with this log, and estimates from earlier.
pub(super) fn place(log: &str) -> Place {
    Place::new(&[("log.jsonl", log), ("estimates.jsonl", "earlier\n")])
}

#[track_caller]
pub(super) fn refused(log: &str, line: usize, words: &[&str]) {
    let place = place(log);
    let shown = format!("log.jsonl: line {line} ");
    let said = place.refuses(FILTER, &[words, &[&shown, "help:"]].concat());
    assert!(
        !said.err.contains("usize") && !said.err.contains("f64"),
        "{}",
        said.err
    );
}

/// Filters the log with the value at `pointer` of a line replaced, or taken out.
#[track_caller]
pub(super) fn refused_with(line: usize, pointer: &str, value: Option<Value>, words: &[&str]) {
    let mut log = log();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = log[line - 1].pointer_mut(parent).unwrap();
    match (parent, value) {
        (Value::Object(map), Some(value)) => drop(map.insert(key.to_owned(), value)),
        (Value::Object(map), None) => drop(map.remove(key).unwrap()),
        (Value::Array(list), Some(value)) => list[key.parse::<usize>().unwrap()] = value,
        _ => panic!("{pointer}"),
    }
    refused(&lines(&log), line, words);
}

/// Filters the log with a text on line 3 replaced: for what serde_json would not write.
#[track_caller]
fn refused_text(old: &str, new: &str, words: &[&str]) {
    let log = lines(&log());
    let at: usize = log.lines().take(2).map(|line| line.len() + 1).sum();
    assert!(log[at..].contains(old));
    refused(
        &(log[..at].to_owned() + &log[at..].replacen(old, new, 1)),
        3,
        words,
    );
}

#[test]
fn unknown_features() {
    let words = [
        "(step 3) measures the unknown feature 4",
        "the log has features 0 to 3",
    ];
    refused_with(3, "/feature_measurements/0/id", Some(json!(4)), &words);
    let words = ["-1` cannot stand here", "write a whole number from 0"];
    refused_with(3, "/feature_measurements/0/id", Some(json!(-1)), &words);
    let words = [
        "(step 3) measures the unknown pair 0 to 9",
        "the log has features 0 to 3",
    ];
    refused_with(3, "/structure_measurements/0/to", Some(json!(9)), &words);
}

#[test]
fn a_feature_measured_twice() {
    let words = [
        "(step 3) measures feature 3 twice",
        "one measurement of each feature",
    ];
    refused_with(3, "/feature_measurements/0/id", Some(json!(3)), &words);
}

#[test]
fn a_pair_the_wrong_way_round() {
    for to in [0, 1] {
        let pair = json!({"from": 1, "to": to, "z": [0.0, 0.0, 0.0]});
        let said = format!("(step 3) measures a pair from 1 to {to}");
        let words = [&*said, "from < to"];
        refused_with(3, "/structure_measurements/0", Some(pair), &words);
    }
}

#[test]
fn wrong_sizes() {
    let words = [
        "(step 3) gives the motion of 2 features, and the log has 4",
        "one [x, y, z]",
    ];
    refused_with(
        3,
        "/feature_motion",
        Some(json!([[0, 0, 0], [0, 0, 0]])),
        &words,
    );
    let words = ["a list has 2 elements, and 3 belong into it", "docs/log.md"];
    refused_with(3, "/feature_measurements/0/z", Some(json!([1, 2])), &words);
    let words = ["more than belongs here", "docs/log.md"];
    refused_with(
        3,
        "/feature_measurements/0/z",
        Some(json!([1, 2, 3, 4])),
        &words,
    );
    let words = [
        "5 features, and gives the first positions of 4",
        "make the two agree",
    ];
    refused_with(1, "/features", Some(json!(5)), &words);
    let words = ["a list has 1 elements, and 6 belong into it", "docs/log.md"];
    refused_with(1, "/initial/pose_covariance/2", Some(json!([1])), &words);
}

#[test]
fn numbers_that_are_none() {
    let number = "\"translation\":[0.1,";
    for (wrong, said) in [
        ("NaN", "NaN is not a number in JSON"),
        ("-Infinity", "-Infinity is not a number in JSON"),
        ("1e999", "1e999 is too large"),
        ("null", "null cannot stand here"),
        ("\"0.1\"", "string \"0.1\" cannot stand here"),
    ] {
        let words = [said, "finite", "near `"];
        refused_text(number, &format!("\"translation\":[{wrong},"), &words);
    }
}

#[test]
fn steps_out_of_order() {
    let mut backward = log();
    backward[1..].reverse();
    let words = ["is step 4 after step 5", "sort or complete the log"];
    refused(&lines(&backward), 3, &words);
    let mut gap = log();
    gap.remove(2);
    refused(&lines(&gap), 3, &["is step 4 after step 2", "without gaps"]);
    let mut twice = log();
    twice[3] = twice[2].clone();
    refused(&lines(&twice), 4, &["is step 3 after step 3"]);
}

#[test]
fn a_broken_last_line() {
    let broken = lines(&log()) + "{\"step\":6,\"control\":{\"rot";
    refused(
        &broken,
        6,
        &["ends in the middle of the step", "--keep-complete"],
    );
}

#[test]
fn garbage_at_the_end() {
    let text = lines(&log()) + "\0\u{1}garbage\n";
    refused(
        &text,
        6,
        &["is no valid step", "this is not JSON", "docs/log.md"],
    );
}

#[test]
fn empty_files() {
    for text in ["", "\n\n  \n"] {
        place(text).refuses(
            FILTER,
            &[
                "log.jsonl is empty",
                "the first line of a log is its header",
            ],
        );
    }
}

#[test]
fn binary_garbage() {
    let place = place("");
    let bytes: Vec<u8> = (0..=255).cycle().take(5000).collect();
    for offset in [0, 1, 10, 34, 128] {
        fs::write(place.path("log.jsonl"), &bytes[offset..]).unwrap();
        place.refuses(FILTER, &["log.jsonl: line ", "help:"]);
    }
}

#[test]
fn unknown_keys() {
    let words = ["unknown key `contrl`", "did you mean `control`?"];
    refused_with(3, "/contrl", Some(json!(1)), &words);
    let text = "\"step\":3";
    refused_text(
        text,
        "\"step\":3,\"step\":3",
        &["the key `step` is given twice", "keep one"],
    );
}

#[test]
fn sums_that_cannot_be() {
    let with = |sums: Value, words: &[&str]| {
        let mut log = log();
        log[2]
            .as_object_mut()
            .unwrap()
            .remove("structure_measurements");
        log[2]["structure_sums"] = sums;
        refused(&lines(&log), 3, words);
    };
    with(
        json!([[0, 0, 0]]),
        &["has 1 structure_sums", "the log has 4 features"],
    );
    let off = json!([[1, 0, 0], [-1, 0, 0], [0, 2, 0], [0, -1, 0]]);
    with(
        off,
        &[
            "structure_sums that add up to 1, not 0",
            "each pair goes into two sums",
        ],
    );
    with(
        json!([[1e308, 0, 0], [1e308, 0, 0], [0, 0, 0], [0, 0, 0]]),
        &["add up to inf"],
    );
    let zero = json!([[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]]);
    let words = [
        "structure_sums and structure_measurements",
        "give one of the two",
    ];
    refused_with(3, "/structure_sums", Some(zero), &words);
}
