//! Runs and logs that fail on the way: the message names them and the step, and what is finished is
//! kept.

use serde_json::json;

use super::support::{FAILURE, Place, lines, log, polygon};

/// Motion noise and measurement noise fifteen orders of magnitude apart: no covariance of doubles
/// holds both.
pub fn breaking() -> String {
    polygon(&[
        ("rotation_sigma_rad = 0.02", "rotation_sigma_rad = 3.0"),
        (
            "translation_sigma_cm = 0.03",
            "translation_sigma_cm = 1000000.0",
        ),
        (
            "feature_measurement_sigma_cm = 0.02",
            "feature_measurement_sigma_cm = 1e-9",
        ),
        (
            "structure_measurement_sigma_cm = 0.5",
            "structure_measurement_sigma_cm = 1e-9",
        ),
    ])
}

#[test]
fn a_run_names_itself_and_the_step() {
    let place = Place::new(&[("breaking.toml", &breaking())]);
    for (planner, failed) in [
        ("predetermined", "the filter failed at step 2"),
        ("local", "the planner failed at step 1"),
    ] {
        let run = format!("run breaking.toml --planner {planner} --seed 7 --out run");
        let said = format!("polygon, {planner}, seed 7: {failed}: the ");
        let said = place.ends_badly(&run, FAILURE, &[&said, "the covariance has broken down"]);
        assert!(said.out.is_empty(), "{said:?}");
    }
}

#[test]
fn tables_keep_the_runs_that_did_not_fail() {
    let config = "title = \"t\"\nruns = 2\n\
        [[experiments]]\nscenario = \"good.toml\"\nplanners = [\"predetermined\"]\n\
        [[experiments]]\nlabel = \"breaking\"\nscenario = \"breaking.toml\"\nplanners = [\"local\"]\n";
    let place = Place::new(&[
        ("good.toml", &polygon(&[])),
        ("breaking.toml", &breaking()),
        ("config.toml", config),
    ]);
    let said = place.adslam("tables config.toml --out tables");
    assert_eq!(said.code, Some(FAILURE), "{said:?}");
    for word in [
        "2 of the runs failed",
        "[breaking] polygon, local, seed 1: the planner failed at step 1",
        "[breaking] polygon, local, seed 2: the planner failed at step 1",
        "the other runs were finished and written",
    ] {
        assert!(said.err.contains(word), "{said:?}");
    }
    let json = place.json("tables/tables.json");
    assert_eq!(json["complete"], false);
    let runs = |label: &str, planner: &str| {
        json["scenarios"][label]["planners"][planner]
            .as_array()
            .unwrap()
            .len()
    };
    assert_eq!(runs("polygon", "predetermined"), 2);
    assert_eq!(runs("breaking", "local"), 0);
    assert!(place.read("tables/tables.md").contains("Incomplete"));
}

/// The first covariance is not positive semidefinite, which shows in the filter.
#[test]
fn an_indefinite_covariance_names_the_step() {
    let mut log = log();
    for pointer in [
        "/initial/pose_covariance/0/1",
        "/initial/pose_covariance/1/0",
    ] {
        *log[0].pointer_mut(pointer).unwrap() = json!(5.0);
    }
    let place = Place::new(&[("log.jsonl", &lines(&log))]);
    let words = [
        "log.jsonl, line 2: the filter failed at step 2",
        "not positive definite",
    ];
    let said = place.ends_badly("filter log.jsonl --out estimates.jsonl", FAILURE, &words);
    assert_eq!(
        said.err.matches("not positive definite").count(),
        1,
        "said once"
    );
}

/// Sigmas so small that their squares vanish.
#[test]
fn a_covariance_that_breaks_down_names_the_step() {
    let mut log = log();
    for key in ["feature_measurement_sigma", "structure_measurement_sigma"] {
        log[0]["noise"][key] = json!(1e-150);
    }
    let words = ["the filter failed at step 3", "Check that the noise sigmas"];
    Place::new(&[("log.jsonl", &lines(&log))]).ends_badly(
        "filter log.jsonl --out estimates.jsonl",
        FAILURE,
        &words,
    );
}
