//! The points of sweeps, and the kinds of files.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use serde_json::{Value, json};

use super::{Folder, loaded};
use crate::config::{Config, check_file};
use crate::diagnostics::FileKind;
use crate::run::Setup;
use crate::scenario::Scenario;
use crate::scenario::tests::repository;
use crate::sweep::{Sweep, SweepPlan};

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
    assert_eq!(check_file(&sweep).unwrap().kind, FileKind::Sweep);
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

#[test]
fn the_shipped_sweeps_can_be_run() {
    let entries = fs::read_dir(repository("sweeps")).unwrap();
    let paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    assert!(!paths.is_empty());
    for path in paths {
        let plan = SweepPlan::load(&path, None).unwrap();
        assert!(plan.total_runs() > 100, "{}", path.display());
        assert!(plan.warnings().is_empty(), "{:?}", plan.warnings());
    }
}

/// Building the phantom takes long, and points that vary something else share it.
#[test]
fn an_object_that_does_not_change_is_built_once() {
    let folder = Folder::with(
        "[set]\n\"object.phantom.spacing_cm\" = 0.6\n\
        \"robot.start_cm\" = [-15, 0, 0]\n[grid]\n\"object.phantom.features\" = [10, 12]\n\
        \"sensor.range_cm\" = [2.0, 3.0]\n",
    );
    let plan = SweepPlan::load(&folder.path("sweep.toml"), None).unwrap();
    let drawn: Vec<_> = plan.setups.iter().map(|setup| &setup.drawn).collect();
    assert!(Arc::ptr_eq(drawn[0], drawn[1]) && Arc::ptr_eq(drawn[2], drawn[3]));
    assert!(!Arc::ptr_eq(drawn[1], drawn[2]));
    for (setup, point) in plan.setups.iter().zip(&plan.sweep().points) {
        let alone = Setup::new(&point.scenario).unwrap();
        assert_eq!(setup.object_checksum(), alone.object_checksum());
        assert_eq!(
            setup.planning.sensor.max_range,
            *point.scenario.sensor.range_cm
        );
        assert_eq!(
            setup.planning.topology.faces(),
            alone.planning.topology.faces()
        );
    }
}

#[test]
fn a_deadline_is_warned_of_once() {
    let folder = Folder::with("[grid]\n\"planners.local.deadline_ms\" = [1.0, 2.0]");
    let plan = SweepPlan::load(&folder.path("sweep.toml"), None).unwrap();
    let warnings = plan.warnings();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].starts_with("polygon: the local planner has a deadline"));
}
