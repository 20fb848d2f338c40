//! Tests of studies whose units are quick: what is done, kept, refused and done again.

use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde::{Deserialize, Serialize};
use serde_json::json;
use tempfile::TempDir;

use super::{Study, StudyEnd, StudyPlan, StudyUnit};
use crate::ExperimentError;
use crate::diagnostics::InputError;
use crate::run::{Interrupt, Setup};
use crate::scenario::tests::POLYGON;
use crate::scenario::{PlannerName, Scenario};

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
fn plan(setup: &Setup, seeds: u64) -> StudyPlan<'_> {
    let mut identity = serde_json::Map::new();
    identity.insert("runs".to_owned(), json!(seeds));
    identity.insert("scenario".to_owned(), setup.identity());
    let planners = [PlannerName::Local, PlannerName::Global];
    let units = planners.into_iter().flat_map(|planner| {
        (1..=seeds).map(move |seed| StudyUnit {
            point: 0,
            setup,
            planner,
            seed,
        })
    });
    StudyPlan {
        kind: "test",
        identity,
        units: units.collect(),
    }
}

/// Opens the study and does what is missing; returns how many units that were, and how it ended.
fn work(folder: &Path, plan: StudyPlan<'_>) -> (usize, Vec<Said>) {
    let begun = AtomicUsize::new(0);
    let mut study = Study::open(folder, plan).unwrap();
    let end = study.finish(&Interrupt::new(), &|| (), |unit, _| {
        begun.fetch_add(1, Ordering::Relaxed);
        Ok(Said::of(unit))
    });
    assert_eq!(end.unwrap(), StudyEnd::default());
    let records = study.records().iter().cloned();
    (begun.into_inner(), records.map(Option::unwrap).collect())
}

fn refused(folder: &Path, plan: StudyPlan<'_>) -> InputError {
    match Study::<Said>::open(folder, plan) {
        Err(ExperimentError::Input(error)) => error,
        other => panic!("{other:?}"),
    }
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
    let (begun, records) = work(folder.path(), plan(&setup, 3));
    assert_eq!(begun, 6);
    let expected: Vec<Said> = plan(&setup, 3).units.iter().map(Said::of).collect();
    assert_eq!(records, expected, "in the order of the plan");
    assert_eq!(names(folder.path()), ["plan.json", "records", "study.lock"]);
    let kept = names(&folder.path().join("records"));
    assert_eq!(kept.len(), 6);
    assert_eq!(kept[0], "0001-global-seed1.jsonl");
    assert_eq!(work(folder.path(), plan(&setup, 3)), (0, expected));
}

/// Half of the units are done, then the user stops; a later process does the other half.
#[test]
fn an_interrupted_study_goes_on() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    let (interrupt, done) = (Interrupt::new(), Mutex::new(Vec::new()));
    let mut study = Study::open(folder.path(), plan(&setup, 10)).unwrap();
    let finished = AtomicUsize::new(0);
    let progress = || {
        finished.fetch_add(1, Ordering::Relaxed);
    };
    let end = study.finish(&interrupt, &progress, |unit, interrupt| {
        if interrupt.requested() {
            return Err(ExperimentError::Interrupted);
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
        Err(ExperimentError::Interrupted)
    ));
    assert_eq!((study.done(), finished.into_inner()), (10, 10));
    drop(study);
    assert_eq!(names(&folder.path().join("records")).len(), 10);
    let (begun, records) = work(folder.path(), plan(&setup, 10));
    assert_eq!((begun, records.len()), (10, 20));
}

#[test]
fn what_fails_is_told_and_tried_again() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    let mut study = Study::open(folder.path(), plan(&setup, 2)).unwrap();
    let end = study.finish(&Interrupt::new(), &|| (), |unit, _| {
        if unit.planner == PlannerName::Local {
            let run = format!("polygon, seed {}", unit.seed);
            let reason = "the estimate is not finite".to_owned();
            return Err(ExperimentError::Simulation {
                run,
                step: 3,
                reason,
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
    assert_eq!(work(folder.path(), plan(&setup, 2)).0, 3);
}

#[test]
fn a_write_that_fails_ends_the_work_and_loses_nothing() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    let records = folder.path().join("records");
    let begun = AtomicUsize::new(0);
    let mut study = Study::open(folder.path(), plan(&setup, 50)).unwrap();
    let end = study.finish(&Interrupt::new(), &|| (), |unit, _| {
        if begun.fetch_add(1, Ordering::Relaxed) == 10 {
            fs::rename(&records, folder.path().join("away")).unwrap();
        }
        Ok(Said::of(unit))
    });
    assert!(
        matches!(end, Err(ExperimentError::Output { .. })),
        "{end:?}"
    );
    let begun = begun.into_inner();
    assert!(begun < 50, "{begun} units were begun");
    let kept = study.done();
    assert!((9..=begun).contains(&kept), "{kept} of {begun}");
    drop(study);
    fs::rename(folder.path().join("away"), &records).unwrap();
    assert_eq!(work(folder.path(), plan(&setup, 50)).0, 100 - kept);
}

#[test]
fn one_process_at_a_time() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    let first = Study::<Said>::open(folder.path(), plan(&setup, 1)).unwrap();
    let error = refused(folder.path(), plan(&setup, 1));
    let process = format!("another adslam (process {}) is at work", std::process::id());
    assert!(error.message().starts_with(&process), "{error}");
    assert!(error.remedy().unwrap().contains("--out"));
    drop(first);
    assert_eq!(work(folder.path(), plan(&setup, 1)).0, 2);
}

#[test]
fn another_study_is_refused_by_what_differs() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    work(folder.path(), plan(&setup, 1));
    let error = refused(folder.path(), plan(&setup, 2));
    assert!(
        error
            .message()
            .contains("holds another study: `units` is 2 there and 4 here"),
        "{error}"
    );
    let wider = POLYGON.replacen("range_cm = 3.0", "range_cm = 4.0", 1);
    let wider = Setup::new(&Scenario::parse(&wider, Path::new("polygon.toml")).unwrap()).unwrap();
    let error = refused(folder.path(), plan(&wider, 1));
    let difference = "`scenario.keys.sensor.range_cm` is 3.0 there and 4.0 here";
    assert!(error.message().contains(difference), "{error}");
    assert!(error.path().ends_with("plan.json"));
    // What is said there does not count, nor where it lies.
    let same = format!("# A comment.\n{POLYGON}").replace("A prism of", "About");
    let same = Setup::new(&Scenario::parse(&same, Path::new("other.toml")).unwrap()).unwrap();
    assert_eq!(work(folder.path(), plan(&same, 1)).0, 0);
    for text in ["", "{}", "[1", "\u{1}"] {
        fs::write(folder.path().join("plan.json"), text).unwrap();
        let error = refused(folder.path(), plan(&setup, 1));
        assert!(error.message().contains("is no plan of a study"), "{error}");
    }
}

/// A study of one planner and seed with its record altered.
fn with_record(setup: &Setup, alter: impl FnOnce(String) -> String) -> (TempDir, InputError) {
    let folder = tempfile::tempdir().unwrap();
    work(folder.path(), plan(setup, 1));
    let record = folder.path().join("records/0001-local-seed1.jsonl");
    let text = alter(fs::read_to_string(&record).unwrap());
    fs::write(&record, text).unwrap();
    let error = refused(folder.path(), plan(setup, 1));
    assert_eq!(error.path(), record);
    fs::remove_file(&record).unwrap();
    (folder, error)
}

#[test]
fn damaged_and_foreign_records_are_named() {
    let setup = setup();
    type Alter = fn(String) -> String;
    let cases: [(Alter, &str); 7] = [
        (|_| String::new(), "is damaged: it is cut short"),
        (|text| text[..text.len() - 3].to_owned(), "it is cut short"),
        (
            |text| text.replacen("\"seed\":1", "\"seed\":2", 1),
            "its checksum is wrong",
        ),
        (
            |text| text.replacen("adslam-record", "x", 1),
            "its first line is not that of",
        ),
        (|text| text.replacen("crc32", "crc", 1), "its first line: "),
        (
            |text| text.replacen("local", "global", 1),
            "is a record of another study",
        ),
        (
            |text| text.replacen("\"study\":\"", "\"study\":\"0", 1),
            "is a record of another study",
        ),
    ];
    for (alter, message) in cases {
        let (folder, error) = with_record(&setup, alter);
        assert!(error.message().contains(message), "{error}");
        assert!(
            error.remedy().unwrap().contains("0001-local-seed1"),
            "{error:?}"
        );
        // As the remedy says.
        assert_eq!(work(folder.path(), plan(&setup, 1)).0, 1);
    }
}

#[test]
fn strangers_are_refused_and_leftovers_removed() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    work(folder.path(), plan(&setup, 1));
    let stranger = folder.path().join("records/0002-local-seed1.jsonl");
    fs::write(&stranger, "").unwrap();
    let error = refused(folder.path(), plan(&setup, 1));
    assert!(
        error.message().contains("is no record of this study"),
        "{error}"
    );
    fs::remove_file(&stranger).unwrap();
    for leftover in [".adslam-abc123", "records/.adslam-xyz789"] {
        fs::write(folder.path().join(leftover), "half").unwrap();
    }
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    assert_eq!(work(folder.path(), plan(&setup, 1)).0, 0);
    let left = ["notes.txt", "plan.json", "records", "study.lock"];
    assert_eq!(names(folder.path()), left);
    assert_eq!(names(&folder.path().join("records")).len(), 2);
}
