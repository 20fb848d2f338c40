//! What a user is told that cannot have been meant: in the terminal, under `--json` and in summary.json alike.

use super::support::{Ended, Place, polygon, repository};
use serde_json::Value;

fn warnings(answer: &Value) -> Vec<&str> {
    let list = answer["warnings"].as_array().map_or(&[][..], Vec::as_slice);
    list.iter().map(|text| text.as_str().unwrap()).collect()
}

/// Runs the scenario and returns its warnings, which are the same wherever they are told.
fn of_run(scenario: &str, planner: &str) -> Vec<String> {
    let place = Place::new(&[("world.toml", scenario)]);
    let run = format!("run world.toml --planner {planner} --seed 60 --out run");
    let said = place.succeeds(&run);
    let summary = place.json("run/summary.json");
    let told = warnings(&summary);
    assert_eq!(
        said.err.matches("warning: ").count(),
        told.len(),
        "{said:?}"
    );
    for text in &told {
        assert!(
            said.err.contains(&format!("warning: {text}")),
            "{text}, {said:?}"
        );
    }
    let Ended { out, .. } = place.succeeds(&format!("{run} --json"));
    let answer: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(warnings(&answer), told);
    told.into_iter().map(str::to_owned).collect()
}

#[track_caller]
fn assert_one(warnings: &[String], words: &[&str]) {
    let [warning] = warnings else {
        panic!("one warning: {warnings:?}")
    };
    for word in words {
        assert!(warning.contains(word), "no {word:?} in {warning:?}");
    }
}

#[test]
fn a_run_without_a_fault_has_none() {
    for planner in ["predetermined", "local", "global", "combined"] {
        assert!(of_run(&polygon(&[]), planner).is_empty(), "{planner}");
    }
    // Five features are in sight at the one step there is.
    assert!(of_run(&polygon(&[("steps = 5", "steps = 1")]), "local").is_empty());
}

#[test]
fn viewpoints_given_up_are_told_of() {
    let never_reached = polygon(&[
        ("steps = 5", "steps = 60"),
        ("reached_within_cm = 0.3", "reached_within_cm = 0.02"),
    ]);
    let told = of_run(&never_reached, "combined");
    assert_one(
        &told,
        &[
            "polygon, combined: viewpoints were given up",
            "the first at step",
        ],
    );
    let stubborn = never_reached.replace("samples = 5", "samples = 5\ngive_up_after_steps = 1000");
    let told = of_run(&stubborn, "combined");
    assert_one(
        &told,
        &[
            "to the end the robot headed for a viewpoint",
            "number 0 of the path",
        ],
    );
}

#[test]
fn limits_that_are_waived_are_told_of_and_foreseen() {
    let beyond = polygon(&[("roll_deg = [0.0]", "roll_deg = [31.0]")]);
    let told = of_run(&beyond, "local");
    let [foreseen, waived] = &told[..] else {
        panic!("two warnings: {told:?}")
    };
    assert!(foreseen.contains("no action keeps the limits of roll and pitch from the start"));
    assert!(
        waived.ends_with("(in 4 of 4 decisions, the first at step 1)"),
        "{waived}"
    );

    let place = Place::new(&[("beyond.toml", &beyond)]);
    let said = place.succeeds("check beyond.toml --json");
    let answer: Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!(warnings(&answer["checked"][0]), [foreseen]);
    assert!(said.err.contains(foreseen), "{said:?}");
}

#[test]
fn viewpoints_that_cannot_be_reached_are_told_of() {
    let near = polygon(&[("clearance_cm = 0.3", "clearance_cm = 1.4")]);
    let told = of_run(&near, "global");
    let left_out = "polygon: viewpoint candidates are left out, as a robot that keeps its clearance of 1.4 cm does not \
        come within 0.3 cm of them (";
    assert!(
        told[0].starts_with(left_out) && told[0].ends_with(" of 396)"),
        "{told:?}"
    );
    let (from, to) = (
        near.find("[viewpoints.sampled]").unwrap(),
        near.find("[planners.predetermined]").unwrap(),
    );
    let fixed = "[viewpoints.fixed]\npositions_cm = [[-0.5, 0.0, 2.0], [0.5, 0.0, 2.0]]\n\n";
    let fixed = near[..from].to_owned() + fixed + &near[to..];
    let place = Place::new(&[("fixed.toml", &fixed)]);
    let said = place.succeeds("check fixed.toml");
    assert!(
        said.err.contains("polygon: viewpoints 1 cannot be reached"),
        "{said:?}"
    );
    let far = polygon(&[
        ("clearance_cm = 0.3", "clearance_cm = 30.0"),
        ("reached_within_cm = 0.3", "reached_within_cm = 3.0"),
    ]);
    let place = Place::new(&[("far.toml", &far)]);
    place.refuses(
        "check far.toml",
        &[
            "none of the 396 viewpoint candidates can be reached",
            "far.toml:",
        ],
    );
}

#[test]
fn a_gate_that_closes_for_good_is_told_of() {
    let log = repository("tests/fixtures/cases/gate_rejects_all.log.jsonl");
    let place = Place::new(&[]);
    let filter = format!(
        "filter {} --gate 0.999 --out estimates.jsonl",
        log.display()
    );
    let words = [
        "the gate rejected every feature measurement",
        "(from step 21 on, 246 measurements)",
    ];
    let said = place.succeeds(&filter);
    let answer: Value =
        serde_json::from_str(&place.succeeds(&format!("{filter} --json")).out).unwrap();
    let [told] = &warnings(&answer)[..] else {
        panic!("one warning: {answer}")
    };
    assert!(said.err.contains(told), "{said:?}");
    for word in words {
        assert!(told.contains(word), "no {word:?} in {told:?}");
    }
    // Without the gate there is nothing to say.
    let said = place.succeeds(&filter.replace(" --gate 0.999", ""));
    assert!(!said.err.contains("warning"), "{said:?}");

    // In a run the robot starts far from where it believes to be.
    let closed = polygon(&[
        ("steps = 5", "steps = 12"),
        (
            "feature_measurement_sigma_cm = 0.02",
            "feature_measurement_sigma_cm = 0.9",
        ),
        (
            "[sensor]",
            "[filter]\ngate_probability = 0.5\nfeature_measurement_sigma_cm = 0.00001\n[sensor]",
        ),
    ]);
    let told = of_run(&closed, "predetermined");
    assert_one(
        &told,
        &["polygon, predetermined: from some step to the end the gate rejected"],
    );
}

/// Studies tell a warning once, with the number of runs.
#[test]
fn tables_tell_each_once() {
    let beyond = polygon(&[("roll_deg = [0.0]", "roll_deg = [31.0]")]);
    let config = "title = \"t\"\nruns = 3\n\n[[experiments]]\nscenario = \"beyond.toml\"\nplanners = [\"local\"]\n";
    let place = Place::new(&[("beyond.toml", &beyond), ("config.toml", config)]);
    let said = place.succeeds("tables config.toml --out results");
    assert_eq!(
        said.err.matches("so that they were waived").count(),
        1,
        "{said:?}"
    );
    assert!(
        said.err.contains("so that they were waived (in 3 runs)"),
        "{said:?}"
    );
}
