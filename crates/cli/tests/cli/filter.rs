//! `adslam filter`

use std::fs;

use serde_json::{Value, json};

use super::support::{Place, documented, lines, log, repository};

fn estimates(place: &Place, name: &str) -> Vec<Value> {
    let text = place.read(name);
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

/// The reference of the format shows a log that can be filtered as it stands.
#[test]
fn the_log_in_the_documentation() {
    let document = fs::read_to_string(repository("docs/log.md")).unwrap();
    let example = document.split("```jsonl\n").nth(1).unwrap();
    let example = example.split("```").next().unwrap();
    let place = Place::new(&[("log.jsonl", example)]);
    let said = place.succeeds("filter log.jsonl --out new/folder/estimates.jsonl");
    assert!(
        said.out.starts_with("filtered 2 steps with 2 features"),
        "{said:?}"
    );
    let lines = estimates(&place, "new/folder/estimates.jsonl");
    assert_eq!(lines.len(), 2);
    for (line, n) in lines.iter().zip(2..) {
        assert_eq!(line["step"], n);
        let mut keys: Vec<&str> = line.as_object().unwrap().keys().map(|key| &**key).collect();
        keys.sort_unstable();
        let expected = [
            "covariance_diagonal",
            "feature_nis",
            "features",
            "pose",
            "pose_covariance",
            "rejected_features",
            "step",
            "structure_nis",
            "trace",
        ];
        assert_eq!(keys, expected);
        let length = |key: &str| line[key].as_array().unwrap().len();
        let lengths = ["pose", "pose_covariance", "features", "covariance_diagonal"].map(length);
        assert_eq!(lengths, [6, 6, 2, 12]);
        let variances = line["covariance_diagonal"].as_array().unwrap();
        let sum: f64 = variances.iter().map(|v| v.as_f64().unwrap()).sum();
        assert!((sum / line["trace"].as_f64().unwrap() - 1.0).abs() < 1e-14);
        // Those two are where a log has a time and a truth.
        for key in documented(&document.replace("\n### ", "\n## "), "## Estimates") {
            let is_there = line.get(&key).is_some() || ["time", "errors"].contains(&&*key);
            assert!(is_there, "{key} is documented");
        }
    }
}

/// Every key of a header is in the reference, and the other way round.
#[test]
fn the_documented_keys_of_the_header() {
    let document = fs::read_to_string(repository("docs/log.md")).unwrap();
    let mut documented = documented(&document, "## Header");
    let mut written = Vec::new();
    let mut header = log().remove(0);
    header["time"] = json!(0.5);
    header["truth"] = json!([]);
    header["filter"] = json!({"estimator": "so3_ekf", "gate_probability": 0.9});
    header["source"] = json!("a test");
    for (key, value) in header.as_object().unwrap() {
        match value.as_object() {
            Some(part) => written.extend(part.keys().map(|inner| format!("{key}.{inner}"))),
            None => written.push(key.clone()),
        }
    }
    documented.sort();
    written.sort();
    assert_eq!(documented, written);
}

#[test]
fn blank_lines_and_line_ends_do_not_matter() {
    let text = lines(&log());
    let windows = text.replace('\n', "\r\n\r\n");
    let place = Place::new(&[("log.jsonl", &text), ("windows.jsonl", windows.trim_end())]);
    place.succeeds("filter log.jsonl --out estimates.jsonl");
    place.succeeds("filter windows.jsonl --out other.jsonl");
    assert_eq!(place.read("estimates.jsonl"), place.read("other.jsonl"));
}

#[test]
fn keep_complete_keeps_what_is_before_a_broken_line() {
    let whole = lines(&log());
    let broken = format!("{whole}{{\"step\":6,\"control\":{{\"rot");
    let place = Place::new(&[("whole.jsonl", &whole), ("broken.jsonl", &broken)]);
    place.succeeds("filter whole.jsonl --out whole-estimates.jsonl");
    let said = place.succeeds("filter broken.jsonl --out estimates.jsonl --keep-complete");
    for word in [
        "warning: broken.jsonl: line 6 ends in the middle",
        "kept the 4 steps before",
    ] {
        assert!(said.err.contains(word), "{said:?}");
    }
    assert_eq!(
        place.read("whole-estimates.jsonl"),
        place.read("estimates.jsonl")
    );
}

/// One estimator after the other over the same log: they agree at first, and are not the same filter.
#[test]
fn the_estimators_differ() {
    let place = Place::new(&[("log.jsonl", &lines(&log()))]);
    let of = |name: &str| {
        place.succeeds(&format!(
            "filter log.jsonl --estimator {name} --out {name}.jsonl"
        ));
        estimates(&place, &format!("{name}.jsonl"))
    };
    let [euler, so3, invariant] = ["euler_ekf", "so3_ekf", "right_invariant_ekf"].map(of);
    let x = |line: &Value| line["pose"][3].as_f64().unwrap();
    for (a, b) in [(&euler, &so3), (&so3, &invariant)] {
        assert_eq!(a.len(), b.len());
        assert!((x(&a[0]) - x(&b[0])).abs() < 0.05);
        assert_ne!(a, b);
    }
    place.succeeds("filter log.jsonl --out default.jsonl");
    assert_eq!(estimates(&place, "default.jsonl"), euler);
    let words = ["no estimator is called", "did you mean so3_ekf?"];
    place.refuses("filter log.jsonl --estimator so3_efk --out x.jsonl", &words);
}

#[test]
fn the_gate_keeps_out_a_measurement_that_cannot_be() {
    let mut steps = log();
    steps[1]["feature_measurements"][0]["z"] = serde_json::json!([50.0, 0.0, 0.0]);
    let place = Place::new(&[("log.jsonl", &lines(&steps))]);
    let id = &steps[1]["feature_measurements"][0]["id"];
    let said = place.succeeds("filter log.jsonl --gate 0.999 --out gated.jsonl");
    assert!(
        said.out.contains("the gate kept out 1 feature measurement"),
        "{said:?}"
    );
    let gated = estimates(&place, "gated.jsonl");
    assert_eq!(gated[0]["rejected_features"], serde_json::json!([id]));
    place.succeeds("filter log.jsonl --out open.jsonl");
    let open = estimates(&place, "open.jsonl");
    assert_eq!(open[0]["rejected_features"], serde_json::json!([]));
    let x = |line: &Value| line["pose"][3].as_f64().unwrap().abs();
    assert!(
        x(&open[0]) > 1.0 && x(&gated[0]) < 1.0,
        "it would have led far away"
    );
    for gate in ["0", "1", "nan", "much"] {
        let arguments = format!("filter log.jsonl --gate {gate} --out x.jsonl");
        place.refuses(&arguments, &["write a number above 0 and below 1"]);
    }
}
