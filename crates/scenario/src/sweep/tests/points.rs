//! The points of sweeps, and the kinds of files.

use serde_json::{Value, json};

use super::{Folder, loaded};
use crate::config::Config;
use crate::sweep::Sweep;
use crate::tests::repository;
use crate::{FileKind, Scenario};

#[test]
fn the_last_key_of_the_grid_varies_fastest_and_listed_points_come_after() {
    let sweep = loaded(
        "[set]\nsteps = 7\n[grid]\n\"sensor.range_cm\" = [2.0, 4]\n\
         \"noise.deformation_noise\" = [\"fresh\", \"accumulating\"]\n\
         [[points]]\nlabel = \"calm\"\nset = { \"noise.rotation_sigma_rad\" = 0.0, steps = 9 }\n",
    )
    .unwrap();
    let varied = [
        "sensor.range_cm",
        "noise.deformation_noise",
        "noise.rotation_sigma_rad",
        "steps",
    ];
    assert_eq!(sweep.varied, varied);
    let values: Vec<Vec<Option<Value>>> = sweep
        .points
        .iter()
        .map(|point| point.values.clone())
        .collect();
    // What a point leaves alone is the scenario's; what that leaves out is nothing.
    let expected = [
        json!([2.0, "fresh", 0.02, 7]),
        json!([2.0, "accumulating", 0.02, 7]),
        json!([4, "fresh", 0.02, 7]),
        json!([4, "accumulating", 0.02, 7]),
        json!([3.0, null, 0.0, 9]),
    ];
    assert_eq!(json!(values), json!(expected));
    assert_eq!(*sweep.points[2].scenario.sensor.range_cm, 4.0);
    assert_eq!(sweep.points[4].label.as_deref(), Some("calm"));
    assert_eq!(sweep.points[4].scenario.steps.get(), 9);
    assert_eq!(sweep.points[3].scenario.steps.get(), 7);
    assert_eq!(json!(sweep.points[0].overrides)["steps"], 7);
    assert_eq!((sweep.runs_in_all(3), sweep.first_seed), (Some(30), 1));
}

#[test]
fn whole_tables_and_elements_of_lists_are_varied_too() {
    let sweep = loaded(
        "[grid]\n\"planners.combined\" = [{ nearest_count = 3 }, { nearest_fraction = 0.5 }]\n\
         \"object.points.positions_cm[13]\" = [[1.5, 0.0, 5.0], [1.5, 0.0, 6.0]]\n",
    )
    .unwrap();
    assert_eq!(sweep.points.len(), 4);
    assert_eq!(
        sweep.points[3].values[0],
        Some(json!({"nearest_fraction": 0.5}))
    );
    assert_eq!(sweep.points[1].values[1], Some(json!([1.5, 0.0, 6.0])));
}

#[test]
fn kinds_of_files_are_told_apart() {
    let folder = Folder::with("[grid]\nsteps = [5]");
    let (sweep, scenario) = (folder.path("sweep.toml"), folder.path("polygon.toml"));
    assert_eq!(FileKind::of_file(&sweep).unwrap(), FileKind::Sweep);
    let error = Config::load(&sweep).unwrap_err();
    assert!(
        error
            .message()
            .ends_with("is a sweep, and a configuration is needed")
    );
    assert_eq!(error.remedy(), Some("`adslam sweep` runs a sweep"));
    let error = Scenario::load(&sweep).unwrap_err();
    assert!(
        error
            .message()
            .ends_with("is a sweep, and a scenario is needed")
    );
    let error = Sweep::load(&scenario).unwrap_err();
    assert!(
        error
            .message()
            .ends_with("is a scenario, and a sweep is needed")
    );
    let error = Sweep::load(&repository("configs/paper.toml")).unwrap_err();
    assert!(error.remedy().unwrap().contains("adslam tables"), "{error}");
}
