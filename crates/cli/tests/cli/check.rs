//! `adslam check`

use std::fs;

use super::support::{BAD_INPUT, Place, polygon, repository};

#[test]
fn all_shipped_files_are_valid() {
    let place = Place::new(&[]);
    let mut files = Vec::new();
    for folder in ["scenarios", "configs", "sweeps"] {
        for entry in fs::read_dir(repository(folder)).unwrap() {
            files.push(entry.unwrap().path().display().to_string());
        }
    }
    assert!(files.len() >= 8, "{files:?}");
    let said = place.succeeds(&format!("check {}", files.join(" ")));
    assert_eq!(
        said.out.matches(": valid ").count(),
        files.len(),
        "{said:?}"
    );
    assert_eq!(said.err, "", "nothing to warn of");
}

#[test]
fn every_wrong_file_is_explained_and_the_others_are_checked() {
    let place = Place::new(&[
        ("good.toml", &polygon(&[])),
        ("typo.toml", &polygon(&[("range_cm", "rang_cm")])),
        ("colour.toml", "colour = 3\n"),
    ]);
    let said = place.refuses(
        "check typo.toml colour.toml absent.toml good.toml",
        &[
            "did you mean `range_cm`?",
            "colour.toml is neither a scenario nor a configuration nor a sweep",
            "cannot read absent.toml",
            "3 of 4 files are not valid",
        ],
    );
    assert!(said.out.contains("good.toml: valid scenario"), "{said:?}");
}

/// What only shows when the world is built is found without a run.
#[test]
fn the_world_is_looked_at() {
    let place = Place::new(&[
        (
            "in.toml",
            &polygon(&[("[robot] ", "[robot]\nstart_cm = [1.5, 0.0, 2.0]\n")]),
        ),
        (
            "near.toml",
            &polygon(&[("[robot] ", "[robot]\nstart_cm = [0.8, 0.0, 2.0]\n")]),
        ),
    ]);
    place.refuses(
        "check in.toml",
        &["the robot starts 0.500 cm inside the object", "in.toml:"],
    );
    let said = place.succeeds("check near.toml");
    assert!(said.err.contains("nearer than its clearance"), "{said:?}");
}

#[test]
fn what_is_no_file_is_refused() {
    let place = Place::new(&[("empty.toml", "")]);
    fs::write(place.path("binary.toml"), [0xff, 0xfe, 0, 1]).unwrap();
    for (file, word) in [
        (".", "is a folder"),
        ("empty.toml", "has no keys"),
        ("binary.toml", "byte 0 is not UTF-8"),
    ] {
        place.refuses(&format!("check {file}"), &[file, word]);
    }
    assert_eq!(place.adslam("check absent.toml").code, Some(BAD_INPUT));
}
