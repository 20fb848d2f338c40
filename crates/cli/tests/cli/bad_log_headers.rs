//! Logs whose header, first belief or truth cannot be used.

use serde_json::{Value, json};

use super::bad_logs::{FILTER, place, refused, refused_with};
use super::support::{lines, log};

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
