//! Overrides: what they change, and what is said about wrong ones.

use adslam_diagnostics::InputError;

use super::{ONE, loaded};
use crate::config::Config;
use crate::tests::{assert_error, miette_report};
use crate::{Object, Structure, Viewpoints};
use adslam_planning::Nearest;

/// One experiment on the polygon with these overrides.
fn overridden(set: &str) -> Result<Config, InputError> {
    loaded(&format!("{ONE}[experiments.set]\n{set}\n"))
}

/// The polygon with these overrides is refused, and the configuration blamed.
#[track_caller]
fn refused(set: &str, message: &str, pointed_at: &str, remedy: &str) {
    let result = overridden(set);
    let error = result.as_ref().expect_err("an error");
    assert!(
        error.path().ends_with("config.toml"),
        "{}",
        error.path().display()
    );
    assert_error(result, message, pointed_at, remedy);
}

#[test]
fn an_override_changes_one_key() {
    let config = overridden("\"planners.combined.nearest_fraction\" = 0.2\nsteps = 7").unwrap();
    let scenario = &config.experiments[0].scenario;
    assert_eq!(scenario.planners.combined.nearest(), Nearest::Fraction(0.2));
    assert_eq!(scenario.steps.get(), 7);
    assert_eq!(*scenario.sensor.range_cm, 3.0);
}

#[test]
fn an_override_reaches_into_lists_and_makes_missing_tables() {
    let set = "\"object.points.positions_cm[13]\" = [1.5, 0, 5]\n\"filter.structure\" = \"none\"";
    let config = overridden(set).unwrap();
    let scenario = &config.experiments[0].scenario;
    assert_eq!(scenario.filter.structure, Structure::None);
    let Object::Points(points) = &scenario.object else {
        panic!("no points")
    };
    assert_eq!(points.positions_cm[13].z, 5.0);
}

#[test]
fn an_override_of_a_choice_chooses_anew() {
    for set in [
        "\"viewpoints\" = { fixed = { positions_cm = [[1, 2, 3]] } }",
        "\"viewpoints.fixed\" = { positions_cm = [[1, 2, 3]] }",
        "\"viewpoints.fixed.positions_cm\" = [[1, 2, 3]]",
    ] {
        let config = overridden(set).unwrap();
        let Viewpoints::Fixed(fixed) = &config.experiments[0].scenario.viewpoints else {
            panic!("{set}")
        };
        assert_eq!(fixed.positions_cm.len(), 1);
    }
    let count = "\"planners.combined\" = { nearest_count = 1 }";
    let scenario = &overridden(count).unwrap().experiments[0].scenario;
    assert_eq!(scenario.planners.combined.nearest(), Nearest::Count(1));
    let phantom = overridden("\"object.phantom\" = {}").unwrap();
    assert_eq!(phantom.experiments[0].scenario.object.feature_count(), 50);
}

#[test]
fn a_wrong_override_is_shown_in_the_configuration() {
    refused(
        "\"noise.rotatoin_sigma_rad\" = 0.1",
        "unknown key `rotatoin_sigma_rad`",
        "\"noise.rotatoin_sigma_rad\"",
        "did you mean `rotation_sigma_rad`?",
    );
    refused(
        "\"noisy.x\" = 0.1",
        "unknown key `noisy`",
        "\"noisy.x\"",
        "did you mean `noise`?",
    );
    refused(
        "\"noise.rotation_sigma_rad\" = -1.0",
        "-1 is below 0",
        "-1.0",
        "0 or a number",
    );
    refused(
        "\"steps.of.run\" = 1",
        "there is no `steps.of.run`",
        "\"steps.of.run\"",
        "`steps` in",
    );
    refused(
        "\"robot.start_cm[0]\" = 1",
        "there is no `robot.start_cm[0]`",
        "\"robot.start_cm[0]\"",
        "no such part",
    );
}

#[test]
fn an_override_that_clashes_with_the_scenario_is_blamed() {
    refused(
        "\"sensor.min_range_cm\" = 4.0\nsteps = 5",
        "with this override, the sensor sees from 4 cm",
        "\"sensor.min_range_cm\" = 4.0",
        "above 4",
    );
    refused(
        "\"planners.combined.nearest_count\" = 3",
        "both",
        "3",
        "keep one",
    );
    refused(
        "\"motion.deformation.anchored.anchor\" = 20",
        "no feature 20",
        "20",
        "0 to 13",
    );
    refused(
        "noise.rotation_sigma_rad = 0.1",
        "not in quotes",
        "noise",
        "in quotes",
    );
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig {
        cases: 128, failure_persistence: None, ..Default::default()
    })]

    #[test]
    fn no_override_panics(
        path in "[a-z_.\\[\\]0-9]{0,30}|(noise|object|motion|robot|steps)[a-z_.\\[\\]0-9]{0,20}",
        value in proptest::sample::select(vec!["1", "{}", "[]", "\"x\"", "{ a = [1] }", "nan"]),
    ) {
        let config = format!("{ONE}[experiments.set]\n\"{path}\" = {value}\n");
        if let Err(error) = loaded(&config) {
            drop(miette_report(&error));
        }
    }
}
