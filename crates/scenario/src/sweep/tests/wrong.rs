//! What is said about wrong sweeps.

use std::fs;

use super::{Folder, loaded};
use crate::sweep::Sweep;
use crate::tests::{assert_error, miette_report};

/// The sweep is refused, and blamed itself.
#[track_caller]
fn refused(rest: &str, message: &str, pointed_at: &str, remedy: &str) {
    let result = loaded(rest);
    let path = result.as_ref().expect_err("an error").path();
    assert!(path.ends_with("sweep.toml"), "{}", path.display());
    assert_error(result, message, pointed_at, remedy);
}

#[test]
fn a_wrong_value_is_shown_where_it_stands() {
    refused(
        "[grid]\n\"noise.rotation_sigma_rad\" = [0.1, -1.0]",
        "-1 is below 0",
        "-1.0",
        "0 or a number",
    );
    refused(
        "[grid]\n\"noise.rotatoin_sigma_rad\" = [0.1]",
        "unknown key `rotatoin_sigma_rad`",
        "\"noise.rotatoin_sigma_rad\"",
        "did you mean `rotation_sigma_rad`?",
    );
    refused(
        "[set]\n\"sensor.range_cm\" = \"far\"\n[grid]\nsteps = [5, 6]",
        "\"far\" cannot stand here",
        "\"far\"",
        "number",
    );
    refused(
        "[[points]]\n[points.set]\n\"steps\" = 5\n[[points]]\n[points.set]\n\"steps\" = 0",
        "0 is too small",
        "0",
        "whole number",
    );
    refused(
        "[grid]\n\"sensor.min_range_cm\" = [0.1, 4.0]\nsteps = [5, 6]",
        "with this override, the sensor sees from 4 cm",
        "4.0",
        "above 4",
    );
    refused(
        "[grid]\n\"steps.of.run\" = [1]",
        "there is no `steps.of.run`",
        "\"steps.of.run\"",
        "`steps` in",
    );
    refused(
        "[grid]\n\"motion.deformation.anchored.anchor\" = [0, 20]",
        "no feature 20",
        "20",
        "0 to 13",
    );
}

#[test]
fn what_is_no_sweep_is_explained() {
    refused("", "nothing is varied", "", "add a [grid]");
    refused("[set]\nsteps = 5", "nothing is varied", "", "[[points]]");
    refused(
        "[grid]\nsteps = 5",
        "`steps` has one value",
        "5",
        "belongs into [set]",
    );
    refused(
        "[grid]\nsteps = []",
        "this list has 0 values",
        "[]",
        "at least one",
    );
    refused(
        "[grid]\nsteps = [5, 6, 5]",
        "5 is listed twice",
        "5",
        "raise `runs`",
    );
    refused(
        "[grid]\n\"sensor.range_cm\" = [2.0, 3, 2]",
        "2.0 and 2 are the same",
        "2",
        "list each value once",
    );
    refused(
        "[grid]\nnoise.x = [5]",
        "is not in quotes",
        "noise",
        "\"noise.…\"",
    );
    refused(
        "[[points]]\nset.noise.x = 5",
        "is not in quotes",
        "noise",
        "in quotes",
    );
    refused(
        "[set]\nsteps = 5\n[grid]\nsteps = [6, 7]",
        "`steps` is varied in [grid] too",
        "steps = 5",
        "in one of the two",
    );
    let twice = "[[points]]\nlabel = \"a\"\n[[points]]\nlabel = \"a\"";
    refused(twice, "two points are called \"a\"", "\"a\"", "\"a-2\"");
    refused(
        "[[points]]\ncolour = 1",
        "unknown key `colour`",
        "colour",
        "`label`",
    );
    refused(
        "[girds]\nsteps = [5]",
        "unknown key `girds`",
        "girds",
        "`grid`",
    );
}

#[test]
fn more_than_can_be_run_is_refused() {
    let numbers = |count: u32| (1..=count).map(|n| format!("{n}, ")).collect::<String>();
    let wide = format!(
        "[grid]\nsteps = [{}]\n\"planners.global.samples\" = [{}]",
        numbers(200),
        numbers(100)
    );
    refused(
        &wide,
        "the grid has 200 · 100 points",
        "[grid]",
        "up to 10000 points",
    );
    let many = "[[points]]\nset = { steps = 5 }\n".repeat(1001);
    refused(
        &many,
        "1001 points are listed",
        "[[points]]",
        "list up to 1000",
    );
    let folder = Folder::with("[grid]\nsteps = [5, 6, 7, 8, 9, 10]");
    let path = folder.path("sweep.toml");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("runs = 3", "runs = 100000")).unwrap();
    let message = "6 points with 2 planners and 100000 runs of each are more than 1000000 runs";
    assert_error(Sweep::load(&path), message, "100000", "lower `runs`");
}

#[test]
fn planners_and_the_scenario_are_looked_at() {
    let folder = Folder::with("[grid]\nsteps = [5]");
    let path = folder.path("sweep.toml");
    let text = fs::read_to_string(&path).unwrap();
    for (old, new, message, pointed_at) in [
        (
            "\"global\"",
            "\"local\"",
            "the planner local is listed twice",
            "\"local\"",
        ),
        (
            "polygon.toml",
            "absent.toml",
            "absent.toml does not exist",
            "\"absent.toml\"",
        ),
        (
            "\"global\"",
            "\"globe\"",
            "`globe` is not one of the choices",
            "\"globe\"",
        ),
    ] {
        fs::write(&path, text.replace(old, new)).unwrap();
        assert_error(Sweep::load(&path), message, pointed_at, "");
    }
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig {
        cases: 64, failure_persistence: None, ..Default::default()
    })]

    #[test]
    fn no_grid_panics(
        table in proptest::sample::select(vec!["[grid]", "[set]", "[[points]]\n[points.set]", "[points]"]),
        path in "[a-z_.\\[\\]0-9]{0,30}|(noise|object|motion|robot|steps)[a-z_.\\[\\]0-9]{0,20}",
        value in proptest::sample::select(vec!["1", "[]", "[1, 2]", "[[1], {}]", "{ a = [1] }", "[nan]"]),
    ) {
        let both = format!("{table}\n\"{path}\" = {value}\n");
        if let Err(error) = loaded(&both) {
            drop(miette_report(&error));
        }
    }
}
