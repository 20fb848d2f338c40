//! Scenarios that cannot be used: the message has the file, the line, what is wrong and what to write.

use super::support::{Place, polygon};

/// Runs a scenario with a part replaced. The error must point at the line of `at` and say `words`.
#[track_caller]
fn refused(replacement: (&str, &str), at: &str, words: &[&str]) {
    refused_text(&polygon(&[replacement]), at, words);
}

#[track_caller]
fn refused_text(text: &str, at: &str, words: &[&str]) {
    let line = 1 + text.lines().position(|line| line.contains(at)).unwrap();
    let place = Place::new(&[("wrong.toml", text)]);
    let said = place.refuses("run wrong.toml --planner local --out run", words);
    let shown = format!("[wrong.toml:{line}:");
    assert!(said.err.contains(&shown), "no {shown} in {}", said.err);
    assert!(said.err.contains("help:"), "no remedy in {}", said.err);
    assert!(!place.path("run").exists());
}

/// The polygon with other features and no faces.
fn with_features(positions: &str) -> String {
    let text = polygon(&[]);
    let from = text.find("positions_cm = [").unwrap();
    let to = text.find("[motion.translation").unwrap();
    format!(
        "{}positions_cm = {positions}\n{}",
        &text[..from],
        &text[to..]
    )
}

#[test]
fn an_unknown_key() {
    let words = ["unknown key `rang_cm`", "did you mean `range_cm`?"];
    refused(("range_cm = 3.0", "rang_cm = 3.0"), "rang_cm", &words);
}

#[test]
fn a_missing_key() {
    let words = ["the key `range_cm` is missing", "add `range_cm = …`"];
    refused(("range_cm = 3.0", ""), "[sensor]", &words);
}

#[test]
fn a_mistyped_value() {
    let words = ["string \"3\" cannot stand here", "write a number above 0"];
    refused(("range_cm = 3.0", "range_cm = \"3\""), "range_cm", &words);
}

#[test]
fn a_negative_number() {
    let words = ["-3 is not above 0", "write a number above 0"];
    refused(("range_cm = 3.0", "range_cm = -3.0"), "range_cm", &words);
}

#[test]
fn not_a_number() {
    let words = ["nan is not a number", "write a number"];
    refused(("range_cm = 3.0", "range_cm = nan"), "range_cm", &words);
}

#[test]
fn an_infinite_number() {
    let words = ["inf is not a finite number", "write a number"];
    refused(("range_cm = 3.0", "range_cm = inf"), "range_cm", &words);
}

#[test]
fn what_is_not_toml() {
    for wrong in ["three", "3 cm", "[1.0"] {
        let written = format!("range_cm = {wrong}");
        // A list that is not closed is missed on the line below.
        let at = if wrong == "[1.0" {
            "[robot]"
        } else {
            "range_cm"
        };
        refused(("range_cm = 3.0", &written), at, &[]);
    }
    let words = [
        "neither a number nor a text in quotes",
        "write numbers like 3.0",
    ];
    refused(("range_cm = 3.0", "range_cm = three"), "range_cm", &words);
    let words = ["duplicate key", "keep one of the two"];
    let twice = "range_cm = 3.0\nrange_cm = 2.0";
    refused(("range_cm = 3.0", twice), "range_cm = 2.0", &words);
}

#[test]
fn no_features() {
    let words = ["the list is empty", "at least one"];
    refused_text(&with_features("[]"), "positions_cm = []", &words);
}

#[test]
fn repeated_features() {
    let words = [
        "features 1 and 3 are at the same place",
        "every feature needs its own place",
    ];
    refused(
        ("[2.0, 0.5, 1.0], # 3", "[1.5, -1.0, 1.0], # 3"),
        "# 3",
        &words,
    );
}

#[test]
fn features_in_one_plane() {
    let flat = "[[0, 0, 1], [1, 0, 2], [0, 1, 3], [1, 1, 4], [0.5, 0.2, 1.9]]";
    let words = [
        "the features all lie in one plane",
        "add one outside the plane",
    ];
    refused_text(&with_features(flat), flat, &words);
}

#[test]
fn faces_that_do_not_close_up() {
    let words = ["the surface is not closed", "fill the holes"];
    refused(("[0, 2, 1], ", ""), "faces = [", &words);
}

#[test]
fn a_robot_inside_the_object() {
    let start = "start_cm = [1.5, 0.0, 2.0]";
    let words = [
        "the robot starts 0.500 cm inside the object",
        "move the start",
    ];
    refused(("[robot] ", &format!("[robot]\n{start}\n")), start, &words);
}

#[test]
fn no_viewpoint_outside_the_object() {
    let text = polygon(&[
        ("min_cm = [-1.5, -3.0, -2.0]", "min_cm = [1.5, 0.0, 2.0]"),
        ("max_cm = [4.5, 3.0, 6.0]", "max_cm = [1.5, 0.0, 2.0]"),
        ("excluded_min_cm = [0.5, -1.0, 0.0]\n", ""),
        ("excluded_max_cm = [2.5, 1.0, 4.0]\n", ""),
    ]);
    let words = [
        "none of the 1 viewpoint candidates lies outside the object",
        "widen the grid",
    ];
    refused_text(&text, "[viewpoints.sampled]", &words);
}

#[test]
fn a_configuration_is_not_a_scenario() {
    let config = "title = \"t\"\nruns = 2\n[[experiments]]\nscenario = \"polygon.toml\"\n\
                  planners = [\"local\"]\n";
    let place = Place::new(&[("config.toml", config)]);
    place.refuses(
        "run config.toml --planner local --out run",
        &[
            "config.toml is a configuration, and a scenario is needed",
            "`adslam tables`",
        ],
    );
    assert!(!place.path("run").exists());
}

#[test]
fn a_file_that_is_not_there() {
    let words = ["cannot read absent.toml", "No such file", "check the path"];
    Place::new(&[]).refuses("run absent.toml --planner local --out run", &words);
}
