//! A scenario that was written gives itself back.

use super::super::Scenario;
use super::{HEART, POLYGON, ROTATING, parsed, polygon_with};

/// Every table and choice that no shipped scenario has.
const EVERYTHING: &str = "[known_motion.translation.sinusoid]
amplitude_cm = [1e-7, 0.1, 123456.75]
period_steps = 7.5

[known_motion.deformation.anchored_sinusoid]
direction = \"radial\"
amplitude_cm = 0.3333333333333333
period_steps = 10

[mesh_placement]
unit = \"m\"
rotation_deg = [0.0, 90.0, 0.1]

[mismatch]
outlier_probability = 0.1
outlier_sigma_cm = 1

[mismatch.rotation]
axis = [0, 0, 2]
rate_deg_per_step = -0.5

[filter]
structure = \"none\"
estimator = \"right_invariant_ekf\"
gate_probability = 0.999
rotation_sigma_rad = 0

[noise]
truncate_at_sigmas = 2
";

/// Asserts that a scenario is read back as it was written.
pub(super) fn given_back(scenario: &Scenario) {
    let text = scenario.to_toml().unwrap();
    let again = parsed(&text).unwrap();
    let values = |scenario: &Scenario| {
        let mut values = serde_json::to_value(scenario).unwrap();
        // The path is absolute when it is written.
        values["object"]["mesh"]["file"].take();
        values
    };
    assert_eq!(values(&again), values(scenario), "{text}");
    assert_eq!(again.to_toml().unwrap(), text);
}

#[test]
fn every_kind_of_scenario_is_given_back() {
    for text in [POLYGON, HEART, ROTATING] {
        given_back(&parsed(text).unwrap());
    }
    let everything = polygon_with("[noise]\n", EVERYTHING).unwrap();
    assert!(everything.known_motion.is_some() && everything.mismatch.rotation.is_some());
    given_back(&everything);
    let template = include_str!("../../../cli/templates/scenario.toml");
    given_back(&parsed(template).unwrap());
}

/// From wherever the file will lie, and instead of the object that the file had.
#[test]
fn a_mesh_given_beside_the_scenario_is_its_object_with_an_absolute_path() {
    let scenario = parsed(POLYGON).unwrap().with_mesh("meshes/heart.stl");
    given_back(&scenario);
    let text = scenario.to_toml().unwrap();
    let expected = std::path::absolute("meshes/heart.stl").unwrap();
    let line = format!("file = {}", toml::Value::from(expected.to_str().unwrap()));
    assert!(text.contains(&line), "{text}");
    assert!(!text.contains("positions_cm"), "{text}");
}

/// TOML is Unicode text.
#[cfg(unix)]
#[test]
fn a_path_that_is_no_text_is_refused() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let scenario = parsed(POLYGON).unwrap();
    let error = scenario.with_mesh(OsStr::from_bytes(b"he\xffart.stl"));
    let error = error.to_toml().unwrap_err();
    assert!(error.message().contains("is no Unicode text"), "{error}");
}
