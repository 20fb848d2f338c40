//! Sweeps made ready to run.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use adslam_setup::Setup;

use super::Folder;
use crate::sweep::SweepPlan;
use crate::test_files::repository;

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
    let drawn: Vec<_> = plan.setups.iter().map(|setup| &setup.model.drawn).collect();
    assert!(Arc::ptr_eq(drawn[0], drawn[1]) && Arc::ptr_eq(drawn[2], drawn[3]));
    assert!(!Arc::ptr_eq(drawn[1], drawn[2]));
    for (setup, point) in plan.setups.iter().zip(&plan.sweep().points) {
        let alone = Setup::new(&point.scenario).unwrap();
        assert_eq!(setup.object_checksum(), alone.object_checksum());
        assert_eq!(
            setup.model.planning.sensor.max_range,
            *point.scenario.sensor.range_cm
        );
        assert_eq!(
            setup.model.planning.topology.faces(),
            alone.model.planning.topology.faces()
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

#[test]
fn no_more_runs_are_planned_than_can_be_done() {
    let folder = Folder::with("[grid]\nsteps = [5, 6, 7, 8, 9, 10]");
    let path = folder.path("sweep.toml");
    for (runs, help) in [
        (0, "1 to 100000"),
        (200_000, "1 to 100000"),
        (90_000, "fewer"),
    ] {
        let error = SweepPlan::load(&path, Some(runs)).unwrap_err();
        assert!(error.remedy().unwrap().contains(help), "{error}");
    }
    assert_eq!(SweepPlan::load(&path, Some(2)).unwrap().total_runs(), 24);
}
