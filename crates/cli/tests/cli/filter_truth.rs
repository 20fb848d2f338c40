//! `adslam run --log`, and `adslam filter` over logs with a truth.

use serde_json::{Value, json};

use super::support::{Place, STEPS, documented, lines, log, polygon, repository};

fn answered(place: &Place, arguments: &str) -> Value {
    let output = place
        .command(&format!("{arguments} --json"))
        .output()
        .unwrap();
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn a_run_comes_out_of_its_log_again() {
    let gate = "[filter]\nestimator = \"so3_ekf\"\ngate_probability = 0.9\n\n[noise]";
    let place = Place::new(&[("polygon.toml", &polygon(&[("[noise]", gate)]))]);
    let said = place.succeeds("run polygon.toml --planner combined --seed 2 --out run --log");
    assert!(said.out.contains("log.jsonl"), "{said:?}");
    let answer = answered(&place, "filter run/log.jsonl --out run/estimates.jsonl");
    assert_eq!(answer["estimator"], "so3_ekf");
    assert_eq!(answer["gate_probability"], 0.9);
    let summary = place.json("run/summary.json");
    let numbers = answer["summary"].as_object().unwrap();
    assert_eq!(numbers.len(), 16);
    for (name, number) in numbers {
        assert_eq!(number, &summary[name], "{name}");
    }
    let estimates = place.read("run/estimates.jsonl");
    assert_eq!(estimates.lines().count(), STEPS - 1);
    let document = std::fs::read_to_string(repository("docs/log.md")).unwrap();
    let mut documented = documented(&document.replace("\n### ", "\n## "), "## Errors");
    documented.sort();
    for line in estimates.lines() {
        let line: Value = serde_json::from_str(line).unwrap();
        let mut keys: Vec<&String> = line["errors"].as_object().unwrap().keys().collect();
        keys.sort();
        assert_eq!(keys, documented.iter().collect::<Vec<_>>());
    }
    let said = place.succeeds("filter run/log.jsonl --out run/estimates.jsonl");
    for word in [
        "(so3_ekf, gate 0.9)",
        "against the truth: mean pose error",
        "mean NEES: pose",
    ] {
        assert!(said.out.contains(word), "{said:?}");
    }
    let answer = answered(
        &place,
        "filter run/log.jsonl --estimator euler_ekf --gate none --out other.jsonl",
    );
    assert_eq!(answer["estimator"], "euler_ekf");
    assert_eq!(answer["gate_probability"], Value::Null);
    assert_ne!(place.read("other.jsonl"), estimates);
}

/// A truth may be known at some steps only; only those count.
#[test]
fn a_truth_at_one_step() {
    let mut steps = log();
    steps[2]["truth"] = json!({
        "pose": [0.0, 0.0, 0.2, 0.2, 0.0, 0.0],
        "features": [[1.2, 0.0, 0.0], [2.2, 0.0, 0.0], [1.2, 1.0, 0.0], [1.2, 0.0, 1.0]],
    });
    let place = Place::new(&[("log.jsonl", &lines(&steps))]);
    let answer = answered(&place, "filter log.jsonl --out e.jsonl");
    let estimates = place.read("e.jsonl");
    let lines: Vec<Value> = estimates
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let with = |i: usize| lines[i].get("errors");
    assert!(with(0).is_none() && with(2).is_none());
    let (pose, truth) = (&lines[1]["pose"], &steps[2]["truth"]["pose"]);
    let off = |i: usize| pose[i].as_f64().unwrap() - truth[i].as_f64().unwrap();
    let expected = (0..6).map(|i| off(i).powi(2)).sum::<f64>().sqrt();
    let errors = with(1).unwrap();
    let pose_error = errors["pose_error"].as_f64().unwrap();
    assert!((pose_error - expected).abs() < 1e-12 && expected > 1e-6);
    assert_eq!(answer["summary"]["pose_error_mean"], errors["pose_error"]);
    assert_eq!(
        answer["summary"]["feature_error_max"],
        errors["feature_error_max"]
    );
    assert_eq!(answer["summary"]["pose_nees_mean"], errors["pose_nees"]);
    // Without any, there are none.
    let place = Place::new(&[("log.jsonl", &super::support::lines(&log()))]);
    let answer = answered(&place, "filter log.jsonl --out e.jsonl");
    let numbers = answer["summary"].as_object().unwrap();
    assert_eq!(numbers.len(), 3, "{numbers:?}");
    assert!(!place.read("e.jsonl").contains("errors"));
}

/// All pairs listed and all pairs summed say the same.
#[test]
fn sums_say_what_pairs_do() {
    let mut listed = log();
    let mut summed = log();
    for (listed, summed) in listed[1..].iter_mut().zip(&mut summed[1..]) {
        let (mut pairs, mut sums) = (Vec::new(), [[0.0; 3]; 4]);
        for to in 0..4_usize {
            for from in 0..to {
                let z: [f64; 3] = std::array::from_fn(|k| ((from + 2 * to + 3 * k) as f64).sin());
                for k in 0..3 {
                    sums[to][k] += z[k];
                    sums[from][k] -= z[k];
                }
                pairs.push(json!({"from": from, "to": to, "z": z}));
            }
        }
        listed["structure_measurements"] = json!(pairs);
        summed
            .as_object_mut()
            .unwrap()
            .remove("structure_measurements");
        summed["structure_sums"] = json!(sums);
    }
    let place = Place::new(&[
        ("listed.jsonl", &lines(&listed)),
        ("summed.jsonl", &lines(&summed)),
    ]);
    for name in ["listed", "summed"] {
        place.succeeds(&format!("filter {name}.jsonl --out {name}-estimates.jsonl"));
    }
    let numbers = |name: &str| -> Vec<f64> {
        let text = place.read(name);
        let lines = text
            .lines()
            .map(|line| serde_json::from_str::<Value>(line).unwrap());
        lines
            .flat_map(|line| {
                let all = [
                    &line["pose"],
                    &line["covariance_diagonal"],
                    &line["structure_nis"],
                ];
                let all = all.map(|list| list.as_array().unwrap().clone()).concat();
                all.into_iter().map(|x| x.as_f64().unwrap())
            })
            .collect()
    };
    let [a, b] = ["listed", "summed"].map(|name| numbers(&format!("{name}-estimates.jsonl")));
    assert!(a.len() == b.len() && a.len() > 80);
    for (a, b) in a.iter().zip(&b) {
        assert!((a - b).abs() < 1e-9 * a.abs().max(1e-3), "{a}, {b}");
    }
}
