//! Runs and logs that fail on the way: the message names them and the step, and what is finished is
//! kept.

use serde_json::json;

use super::support::{FAILURE, Place, lines, log, polygon};

/// A filter that believes in motion noise and measurement noise fifteen orders of magnitude apart: no
/// covariance of doubles holds both.
pub fn breaking() -> String {
    let filter = "[filter]\nrotation_sigma_rad = 3.0\ntranslation_sigma_cm = 1e6\n\
        feature_measurement_sigma_cm = 1e-9\nstructure_measurement_sigma_cm = 1e-9\n\n[sensor]";
    polygon(&[("[sensor]", filter)])
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
        let said = place.ends_badly(&run, FAILURE, &[&said, "fewer than 6 right"]);
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
    assert!(!place.path("tables/tables.json").exists(), "they lie apart");
    let json = place.json("tables/partial/tables.json");
    assert_eq!(json["complete"], false);
    let runs = |label: &str, planner: &str| {
        json["scenarios"][label]["planners"][planner]
            .as_array()
            .unwrap()
            .len()
    };
    assert_eq!(runs("polygon", "predetermined"), 2);
    assert_eq!(runs("breaking", "local"), 0);
    assert!(
        place
            .read("tables/partial/tables.md")
            .contains("Incomplete")
    );
}

/// Noises of motion and measurement that no covariance of doubles holds together.
#[test]
fn a_covariance_that_breaks_down_names_the_step() {
    let mut log = log();
    for (key, sigma) in [
        ("translation_sigma", 1e6),
        ("rotation_sigma", 3.0),
        ("feature_measurement_sigma", 1e-9),
        ("structure_measurement_sigma", 1e-9),
    ] {
        log[0]["noise"][key] = json!(sigma);
    }
    let words = ["the filter failed at step 2", "fewer than 6 right"];
    Place::new(&[("log.jsonl", &lines(&log))]).ends_badly(
        "filter log.jsonl --out estimates.jsonl",
        FAILURE,
        &words,
    );
}

/// Features known exactly from a robot that is not: no covariance of doubles holds both.
#[test]
fn vanishing_measurement_noise_is_refused_with_what_to_change() {
    let mut log = log();
    for key in ["feature_measurement_sigma", "structure_measurement_sigma"] {
        log[0]["noise"][key] = json!(1e-150);
    }
    let place = Place::new(&[("log.jsonl", &lines(&log))]);
    let words = [
        "the filter failed at step 2",
        "too precise",
        "Make the sigma of the feature measurements larger",
    ];
    place.ends_badly("filter log.jsonl --out estimates.jsonl", FAILURE, &words);
}
