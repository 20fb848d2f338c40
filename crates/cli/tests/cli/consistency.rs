//! `adslam consistency`

use serde_json::Value;

use super::failures::breaking;
use super::support::{FAILURE, Place, polygon};
use super::tables::config;

fn place(runs: usize) -> Place {
    Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("config.toml", &config(runs, &["predetermined", "local"])),
    ])
}

const TABLES: [&str; 8] = [
    "consistency.md",
    "consistency.json",
    "verdicts.csv",
    "verdicts.jsonl",
    "steps.csv",
    "steps.jsonl",
    "features.csv",
    "features.jsonl",
];

#[test]
fn every_estimator_and_planner_is_judged() {
    let place = place(2);
    let said = place.succeeds("consistency config.toml --out out");
    for name in ["euler_ekf", "so3_ekf", "right_invariant_ekf"] {
        let line = format!("polygon, {name}, local: pose NEES ");
        assert!(said.out.contains(&line), "{said:?}");
    }
    let json = place.json("out/consistency.json");
    let cells = json["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 3 * 2);
    for cell in cells {
        assert_eq!(cell["runs"], 2);
        let judged = cell["judgements"].as_array().unwrap();
        let measures: Vec<&str> = judged
            .iter()
            .map(|j| j["measure"].as_str().unwrap())
            .collect();
        let expected = [
            "pose_nees",
            "feature_nees",
            "joint_nees",
            "feature_nis",
            "structure_nis",
        ];
        assert_eq!(measures, expected);
        for judgement in judged {
            let mean = judgement["mean"].as_f64().unwrap();
            assert!(mean > 0.1 && mean < 10.0, "{mean}");
        }
    }
    let rows = place.read("out/verdicts.jsonl");
    let rows: Vec<Value> = rows
        .lines()
        .map(|row| serde_json::from_str(row).unwrap())
        .collect();
    assert_eq!(rows.len(), cells.len() * 5);
    let features = place.read("out/features.jsonl");
    assert_eq!(features.lines().count(), cells.len() * 14);
    for name in ["polygon-pose-nees", "polygon-feature-nis"] {
        assert!(
            place
                .read(&format!("out/figures/{name}.svg"))
                .contains("Right-invariant EKF")
        );
        assert!(place.path(&format!("out/figures/{name}.png")).is_file());
    }
}

#[test]
fn it_goes_on_where_it_was_stopped_and_ends_the_same() {
    let place = place(2);
    place.succeeds("consistency config.toml --estimator so3_ekf --out whole");
    place.succeeds("consistency config.toml --estimator so3_ekf --out out");
    let record = place
        .path("out/records")
        .read_dir()
        .unwrap()
        .next()
        .unwrap()
        .unwrap();
    std::fs::remove_file(record.path()).unwrap();
    let said = place.succeeds("consistency config.toml --estimator so3_ekf --out out");
    assert!(
        said.out.contains("3 of 4 runs were there already"),
        "{said:?}"
    );
    for table in TABLES {
        let [whole, resumed] = ["whole", "out"].map(|out| place.read(&format!("{out}/{table}")));
        // The one number that differs is how long decisions took, which no table holds.
        assert_eq!(whole, resumed, "{table}");
    }
    let words = [
        "holds another study",
        "`filter.estimator` is \"so3_ekf\" there and \"euler_ekf\" here",
    ];
    place.refuses(
        "consistency config.toml --estimator euler_ekf --out out",
        &words,
    );
    // Another estimator beside it, and more runs, are growth.
    let both = "--estimator euler_ekf --estimator so3_ekf --runs 3";
    let said = place.succeeds(&format!("consistency config.toml {both} --out out"));
    assert!(
        said.out.contains("4 of 12 runs were there already"),
        "{said:?}"
    );
    place.succeeds(&format!("consistency config.toml {both} --out whole-too"));
    for table in TABLES {
        let [grown, whole] = ["out", "whole-too"].map(|out| place.read(&format!("{out}/{table}")));
        assert_eq!(grown, whole, "{table}");
    }
}

#[test]
fn machines_are_told_what_people_are() {
    let place = place(1);
    let twice = "--estimator so3_ekf --estimator so3_ekf";
    let said = place.succeeds(&format!("consistency config.toml {twice} --out out --json"));
    let answer: Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!(answer["title"], "A few runs");
    assert_eq!(
        (&answer["complete"], &answer["runs"]),
        (&true.into(), &2.into())
    );
    let cells = answer["cells"].as_array().unwrap();
    assert_eq!(
        cells.len(),
        2,
        "an estimator that is named twice counts once"
    );
    assert_eq!(answer["cells"], place.json("out/consistency.json")["cells"]);
    for file in answer["files"].as_array().unwrap() {
        assert!(place.path(file.as_str().unwrap()).is_file(), "{file}");
    }
}

#[test]
fn runs_that_fail_leave_their_cell_empty() {
    let config = config(1, &["predetermined"])
        + "\n[[experiments]]\nlabel = \"breaking\"\nscenario = \"breaking.toml\"\n\
           planners = [\"predetermined\"]\n";
    let place = Place::new(&[
        ("polygon.toml", &polygon(&[])),
        ("breaking.toml", &breaking()),
        ("config.toml", &config),
    ]);
    let said = place.adslam("consistency config.toml --out out");
    assert_eq!(said.code, Some(FAILURE), "{said:?}");
    for word in [
        "3 of the runs failed",
        "the other runs were finished and written",
    ] {
        assert!(said.err.contains(word), "{said:?}");
    }
    let text = place.read("out/partial/consistency.md");
    assert!(text.contains("Incomplete: 3 runs failed"), "{text}");
    assert!(!text.contains("NaN"), "{text}");
    let cells = place.json("out/partial/consistency.json")["cells"].clone();
    assert_eq!(
        (&cells[0]["runs"], &cells[3]["runs"]),
        (&1.into(), &0.into())
    );
    assert_eq!(cells[3]["pose_error"], Value::Null);
}

#[test]
fn what_cannot_be_asked_for() {
    let place = place(1);
    let words = ["no estimator is called", "did you mean euler_ekf?"];
    place.refuses(
        "consistency config.toml --estimator euler_efk --out out",
        &words,
    );
    let words = ["no experiment called \"heart\"", "polygon"];
    place.refuses("consistency config.toml --only heart --out out", &words);
    place.refuses(
        "consistency config.toml --runs 0 --out out",
        &["0 runs", "--runs"],
    );
}
