//! Tests of studies whose units are quick: what is done, kept and done again.

mod grown;
mod refused;

use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use adslam_diagnostics::{Failure, Interrupt};
use adslam_names::PlannerName;
use adslam_scenario::Scenario;
use adslam_setup::Setup;
use serde::{Deserialize, Serialize};

use super::{OtherBuilds, Study, StudyEnd, StudyPlan, StudyPoint, StudyUnit};
use crate::test_files::POLYGON;

/// What a unit of these studies gives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Said {
    seed: u64,
    third: f64,
}

impl Said {
    fn of(unit: &StudyUnit<'_>) -> Self {
        let third = unit.seed as f64 / 3.0;
        Self {
            seed: unit.seed,
            third,
        }
    }
}

fn setup() -> Setup {
    Setup::new(&Scenario::parse(POLYGON, Path::new("polygon.toml")).unwrap()).unwrap()
}

/// Two planners at as many seeds.
fn plan(setup: &Setup, runs: usize) -> StudyPlan<'_> {
    of_points(&[setup], runs)
}

/// Two planners at as many seeds at each of several points.
fn of_points<'a>(setups: &[&'a Setup], runs: usize) -> StudyPlan<'a> {
    const PLANNERS: &[PlannerName] = &[PlannerName::LOCAL, PlannerName::GLOBAL];
    let points = setups.iter().map(|&setup| StudyPoint {
        setup,
        planners: PLANNERS,
        label: None,
    });
    StudyPlan {
        kind: "test",
        points: points.collect(),
        first_seed: 1,
        runs,
    }
}

fn open<'a>(folder: &Path, plan: &StudyPlan<'a>) -> Result<Study<'a, Said>, Failure> {
    Study::open(folder, plan, OtherBuilds::Refuse)
}

/// Opens the study and does what is missing; returns how many units that were, and how it ended.
fn work(folder: &Path, plan: &StudyPlan<'_>) -> (usize, Vec<Said>) {
    let begun = AtomicUsize::new(0);
    let mut study = open(folder, plan).unwrap();
    let end = study.finish(&Interrupt::new(), &|| (), |unit, _| {
        begun.fetch_add(1, Ordering::Relaxed);
        Ok(Said::of(unit))
    });
    assert_eq!(end.unwrap(), StudyEnd::default());
    let records = study.records().iter().cloned();
    (begun.into_inner(), records.map(Option::unwrap).collect())
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn every_unit_is_done_once_and_its_record_read_back() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    let (begun, records) = work(folder.path(), &plan(&setup, 3));
    assert_eq!(begun, 6);
    let expected: Vec<Said> = plan(&setup, 3).units(&[1]).iter().map(Said::of).collect();
    assert_eq!(records, expected, "in the order of the plan");
    assert_eq!(names(folder.path()), ["plan.json", "records", "study.lock"]);
    let kept = names(&folder.path().join("records"));
    assert_eq!(kept.len(), 6);
    assert_eq!(kept[0], "0001-global-seed1.jsonl");
    assert_eq!(work(folder.path(), &plan(&setup, 3)), (0, expected));
}

/// Half of the units are done, then the user stops; a later process does the other half.
#[test]
fn an_interrupted_study_goes_on() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    let (interrupt, done) = (Interrupt::new(), Mutex::new(Vec::new()));
    let mut study = open(folder.path(), &plan(&setup, 10)).unwrap();
    let finished = AtomicUsize::new(0);
    let progress = || {
        finished.fetch_add(1, Ordering::Relaxed);
    };
    let end = study.finish(&interrupt, &progress, |unit, interrupt| {
        if interrupt.requested() {
            return Err(Failure::Interrupted);
        }
        let mut done = done.lock().unwrap();
        done.push(unit.key());
        if done.len() == 10 {
            interrupt.request();
        }
        Ok(Said::of(unit))
    });
    assert!(end.as_ref().unwrap().interrupted);
    assert!(matches!(
        end.unwrap().into_result(),
        Err(Failure::Interrupted)
    ));
    assert_eq!((study.done(), finished.into_inner()), (10, 10));
    drop(study);
    assert_eq!(names(&folder.path().join("records")).len(), 10);
    let (begun, records) = work(folder.path(), &plan(&setup, 10));
    assert_eq!((begun, records.len()), (10, 20));
}

#[test]
fn what_fails_is_told_and_tried_again() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    let mut study = open(folder.path(), &plan(&setup, 2)).unwrap();
    let end = study.finish(&Interrupt::new(), &|| (), |unit, _| {
        if unit.planner == PlannerName::LOCAL {
            let run = format!("polygon, seed {}", unit.seed);
            let reason = "the estimate is not finite";
            return Err(Failure::Simulation {
                run,
                step: 3,
                cause: reason.into(),
            });
        }
        // A record that JSON cannot hold is the fault of this unit alone.
        let third = if unit.seed == 2 { f64::NAN } else { 0.0 };
        Ok(Said { seed: 1, third })
    });
    let failures = end.unwrap().failures;
    assert_eq!(failures.len(), 3);
    assert!(
        failures[0].starts_with("[0001-local-seed1] polygon, seed 1: step 3"),
        "{failures:?}"
    );
    assert!(
        failures[2].starts_with("[0001-global-seed2] its result"),
        "{failures:?}"
    );
    drop(study);
    assert_eq!(work(folder.path(), &plan(&setup, 2)).0, 3);
}

#[test]
fn a_write_that_fails_ends_the_work_and_loses_nothing() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    let records = folder.path().join("records");
    let begun = AtomicUsize::new(0);
    let mut study = open(folder.path(), &plan(&setup, 50)).unwrap();
    let end = study.finish(&Interrupt::new(), &|| (), |unit, _| {
        if begun.fetch_add(1, Ordering::Relaxed) == 10 {
            fs::rename(&records, folder.path().join("away")).unwrap();
        }
        Ok(Said::of(unit))
    });
    assert!(matches!(end, Err(Failure::Output { .. })), "{end:?}");
    let begun = begun.into_inner();
    assert!(begun < 50, "{begun} units were begun");
    let kept = study.done();
    assert!((9..=begun).contains(&kept), "{kept} of {begun}");
    drop(study);
    fs::rename(folder.path().join("away"), &records).unwrap();
    assert_eq!(work(folder.path(), &plan(&setup, 50)).0, 100 - kept);
}
