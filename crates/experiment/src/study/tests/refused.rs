//! Folders that are refused, by what is wrong with them.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, InputError};
use adslam_scenario::Scenario;
use adslam_setup::Setup;
use tempfile::TempDir;

use super::super::folder::StudyFolder;
use super::super::{OtherBuilds, StudyPlan};
use super::{names, open, plan, setup, work};
use crate::test_files::POLYGON;

fn refused(folder: &Path, plan: &StudyPlan<'_>) -> InputError {
    match open(folder, plan) {
        Err(Failure::Input(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn one_process_at_a_time() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    // A process that died here, with as long a number as there is.
    fs::write(folder.path().join("study.lock"), "4294967295").unwrap();
    let at_work = StudyFolder::lock(folder.path(), &plan(&setup, 1), OtherBuilds::Refuse).unwrap();
    let process = format!("another adslam (process {}) is at work", std::process::id());
    let refused_with = |process: &str| {
        let error = refused(folder.path(), &plan(&setup, 1));
        assert!(error.message().starts_with(process), "{error}");
        assert!(error.remedy().unwrap().contains("--out"));
    };
    // As soon as it is locked, and later.
    refused_with(&process);
    drop(at_work);
    let at_work = open(folder.path(), &plan(&setup, 1)).unwrap();
    refused_with(&process);
    fs::write(folder.path().join("study.lock"), "").unwrap();
    refused_with("another adslam is at work");
    drop(at_work);
    assert_eq!(work(folder.path(), &plan(&setup, 1)).0, 2);
}

#[test]
fn another_study_is_refused_by_what_differs() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    work(folder.path(), &plan(&setup, 1));
    let later = StudyPlan {
        first_seed: 2,
        ..plan(&setup, 2)
    };
    let error = refused(folder.path(), &later);
    assert!(
        error
            .message()
            .ends_with("holds another study: seeds 1 there and 2–3 here"),
        "{error}"
    );
    let wider = POLYGON.replacen("range_cm = 3.0", "range_cm = 4.0", 1);
    let wider = Setup::new(&Scenario::parse(&wider, Path::new("polygon.toml")).unwrap()).unwrap();
    let error = refused(folder.path(), &plan(&wider, 1));
    let difference = "`sensor.range_cm` is 3.0 there and 4.0 here";
    assert!(error.message().contains(difference), "{error}");
    assert!(error.path().ends_with("plan.json"));
    // What is said there does not count, nor where it lies.
    let same = format!("# A comment.\n{POLYGON}").replace("A prism of", "About");
    let same = Setup::new(&Scenario::parse(&same, Path::new("other.toml")).unwrap()).unwrap();
    assert_eq!(work(folder.path(), &plan(&same, 1)).0, 0);
    for text in ["", "{}", "[1", "\u{1}"] {
        fs::write(folder.path().join("plan.json"), text).unwrap();
        let error = refused(folder.path(), &plan(&setup, 1));
        assert!(error.message().contains("is no plan of a study"), "{error}");
    }
}

/// All files below the folder, with their content.
fn content(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for path in fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
    {
        if path.is_dir() {
            files.extend(content(&path));
        } else {
            files.insert(path.clone(), fs::read(path).unwrap());
        }
    }
    files
}

#[test]
fn a_folder_that_is_refused_stays_as_it_is() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    work(folder.path(), &plan(&setup, 2));
    let path = |name: &str| folder.path().join(name);
    fs::write(path("records/.adslam-abc123"), "half").unwrap();
    let before = content(folder.path());
    refused(folder.path(), &plan(&setup, 1));
    assert_eq!(content(folder.path()), before);
    // Nor is a plan written for records that turn out to be of another study.
    fs::remove_file(path("plan.json")).unwrap();
    let before = content(folder.path());
    let wider = POLYGON.replacen("range_cm = 3.0", "range_cm = 4.0", 1);
    let wider = Setup::new(&Scenario::parse(&wider, Path::new("polygon.toml")).unwrap()).unwrap();
    let error = refused(folder.path(), &plan(&wider, 2));
    assert!(error.message().contains("of another study"), "{error}");
    assert_eq!(content(folder.path()), before);
    assert_eq!(work(folder.path(), &plan(&setup, 2)).0, 0);
}

#[test]
fn files_that_are_far_too_large_are_not_called_damaged() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    work(folder.path(), &plan(&setup, 1));
    for (name, most_bytes) in [
        ("records/0001-local-seed1.jsonl", 1 << 30),
        ("plan.json", 1_u64 << 28),
    ] {
        let path = folder.path().join(name);
        // Nothing but a length: it takes no room on the disk.
        let file = File::options().write(true).open(&path).unwrap();
        file.set_len(most_bytes + 1).unwrap();
        let error = refused(folder.path(), &plan(&setup, 1));
        let message = format!("has more than {most_bytes} bytes");
        assert!(error.message().contains(&message), "{error}");
        assert_eq!(error.path(), path);
        assert!(!error.message().contains("damaged"), "{error}");
    }
}

/// A record that was cut anywhere, or in which any one byte is another.
#[test]
fn no_damage_goes_unseen() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    work(folder.path(), &plan(&setup, 1));
    let path = folder.path().join("records/0001-local-seed1.jsonl");
    let whole = fs::read(&path).unwrap();
    for at in 0..whole.len() {
        let mut other = whole.clone();
        other[at] ^= 1 << (at % 8);
        for bytes in [&whole[..at], &other] {
            fs::write(&path, bytes).unwrap();
            refused(folder.path(), &plan(&setup, 1));
        }
    }
    fs::write(&path, &whole).unwrap();
    assert_eq!(work(folder.path(), &plan(&setup, 1)).0, 0);
}

/// A study of one planner and seed with its record altered.
fn with_record(setup: &Setup, alter: impl FnOnce(String) -> String) -> (TempDir, InputError) {
    let folder = tempfile::tempdir().unwrap();
    work(folder.path(), &plan(setup, 1));
    let record = folder.path().join("records/0001-local-seed1.jsonl");
    let text = alter(fs::read_to_string(&record).unwrap());
    fs::write(&record, text).unwrap();
    let error = refused(folder.path(), &plan(setup, 1));
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
            |text| text.replacen("\"identity\":\"", "\"identity\":\"0", 1),
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
        assert_eq!(work(folder.path(), &plan(&setup, 1)).0, 1);
    }
}

#[test]
fn strangers_are_refused_and_leftovers_removed() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    work(folder.path(), &plan(&setup, 1));
    let stranger = folder.path().join("records/0002-local-seed1.jsonl");
    fs::write(&stranger, "").unwrap();
    let error = refused(folder.path(), &plan(&setup, 1));
    assert!(
        error.message().contains("is no record of this study"),
        "{error}"
    );
    fs::remove_file(&stranger).unwrap();
    for leftover in [".adslam-abc123", "records/.adslam-xyz789"] {
        fs::write(folder.path().join(leftover), "half").unwrap();
    }
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    assert_eq!(work(folder.path(), &plan(&setup, 1)).0, 0);
    let left = ["notes.txt", "plan.json", "records", "study.lock"];
    assert_eq!(names(folder.path()), left);
    assert_eq!(names(&folder.path().join("records")).len(), 2);
}
