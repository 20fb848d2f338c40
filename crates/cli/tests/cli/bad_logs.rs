//! Logs that cannot be used: the message has the line, what is wrong with it and what to write.

use std::fs;

use serde_json::{Value, json};

use super::support::{Place, lines, log};

const FILTER: &str = "filter log.jsonl --out estimates.jsonl";

/// A place with this log, and estimates from earlier.
fn place(log: &str) -> Place {
    Place::new(&[("log.jsonl", log), ("estimates.jsonl", "earlier\n")])
}

#[track_caller]
fn refused(log: &str, line: usize, words: &[&str]) {
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
fn refused_with(line: usize, pointer: &str, value: Option<Value>, words: &[&str]) {
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
fn headers_with_missing_keys() {
    for (pointer, key) in [
        ("/format", "format"),
        ("/noise", "noise"),
        ("/initial/pose", "pose"),
        ("/noise/rotation_sigma", "rotation_sigma"),
    ] {
        let said = format!("the key `{key}` is missing");
        refused_with(1, pointer, None, &[&said, "docs/log.md"]);
    }
    let steps_only = lines(&log()[1..]);
    refused(
        &steps_only,
        1,
        &["is no valid header", "unknown key `", "is its header"],
    );
}

#[test]
fn headers_that_say_what_cannot_be() {
    let cases: [(&str, Value, [&str; 2]); 7] = [
        (
            "/length_unit",
            json!("inch"),
            ["the length unit \"inch\"", "write mm, cm or m"],
        ),
        (
            "/format",
            json!("rosbag"),
            ["the format \"rosbag\"", "\"adslam-log\""],
        ),
        ("/version", json!(2), ["has version 2", "reads version 1"]),
        ("/features", json!(0), ["0 features", "at least one"]),
        (
            "/features",
            json!(1_000_000),
            ["1000000 features", "up to 2000"],
        ),
        (
            "/noise/structure_measurement_sigma",
            json!(1e-200),
            ["the structure measurements is 1e-200", "a number above 0"],
        ),
        (
            "/initial/pose_covariance/0/0",
            json!(-1),
            ["the variance -1", "0 or more"],
        ),
    ];
    for (pointer, value, words) in cases {
        let mut log = log();
        *log[0].pointer_mut(pointer).unwrap() = value;
        let said = place(&lines(&log)).refuses(FILTER, &words);
        assert!(said.err.contains("log.jsonl: line 1"), "{}", said.err);
        assert!(said.err.contains("help:"), "{}", said.err);
    }
    let words = [
        "1 in pose_covariance[1][0] and 0 in pose_covariance[0][1]",
        "symmetric",
    ];
    refused_with(1, "/initial/pose_covariance/1/0", Some(json!(1.0)), &words);
}

#[test]
fn negative_sigmas_and_exact_measurements() {
    let measurements = ["feature_measurement_sigma", "structure_measurement_sigma"];
    let motions = [
        "rotation_sigma",
        "translation_sigma",
        "feature_motion_sigma",
    ];
    for key in measurements {
        for value in [-0.1, 0.0] {
            let said = format!("has {value} in noise.{key}");
            let pointer = format!("/noise/{key}");
            refused_with(
                1,
                &pointer,
                Some(json!(value)),
                &[&said, "a number above 0"],
            );
        }
    }
    for key in motions {
        let said = format!("has -0.1 in noise.{key}");
        let pointer = format!("/noise/{key}");
        refused_with(1, &pointer, Some(json!(-0.1)), &[&said, "0 or more"]);
    }
    let words = ["has -2 in initial.feature_sigma", "0 or more"];
    refused_with(1, "/initial/feature_sigma", Some(json!(-2.0)), &words);
}

#[test]
fn covariances_that_no_pose_has() {
    let with = |entries: &[(usize, usize, f64)]| {
        let mut log = log();
        for &(i, j, value) in entries {
            for (i, j) in [(i, j), (j, i)] {
                log[0]["initial"]["pose_covariance"][i][j] = json!(value);
            }
        }
        lines(&log)
    };
    let ones = [(0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0)];
    let pair = with(&[&ones[..], &[(0, 1, 2.0)]].concat());
    let words = [
        "log.jsonl: line 1",
        "has 2 between roll and pitch (entries 0 and 1)",
        "help:",
    ];
    place(&pair).refuses(FILTER, &words);
    // Each pair is right, all three together are not.
    let three = [(0, 1, -0.6), (0, 2, -0.6), (1, 2, -0.6)];
    let three = with(&[&ones[..], &three].concat());
    let words = [
        "log.jsonl: line 1",
        "not positive semidefinite",
        "eigenvalue -0.2",
        "help:",
    ];
    place(&three).refuses(FILTER, &words);
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

#[test]
fn truths_and_filters_that_cannot_be() {
    let truth = json!({"pose": [0, 0, 0, 0, 0, 0], "features": [[0, 0, 0]]});
    for line in [1, 3] {
        let words = [
            "true positions of 1 features, and the log has 4",
            "truth.features",
        ];
        refused_with(line, "/truth", Some(truth.clone()), &words);
    }
    let far = json!({"pose": [0, 0, 0, 0, 0, 0], "features": [[1e300, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]]});
    refused_with(3, "/truth", Some(far), &["the error is not finite"]);
    let words = [
        "no estimator is called \"so3_efk\"",
        "did you mean so3_ekf?",
        "--estimator",
    ];
    refused_with(1, "/filter", Some(json!({"estimator": "so3_efk"})), &words);
    for probability in [0.0, 1.0, -2.0] {
        let filter = json!({"gate_probability": probability});
        refused_with(
            1,
            "/filter",
            Some(filter),
            &["gate probability", "above 0 and below 1"],
        );
    }
    refused_with(
        1,
        "/filter",
        Some(json!({"gate": 0.9})),
        &["unknown key `gate`"],
    );
}
