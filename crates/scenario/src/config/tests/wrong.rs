//! What is said about wrong configurations and published tables, and whose fault it is.

use std::fs;

use super::{Folder, ONE, loaded};
use crate::FileKind;
use crate::config::{Config, Published};
use crate::tests::{POLYGON, assert_error};

#[test]
fn wrong_configurations() {
    let with = |from: &str, to: &str| {
        assert!(ONE.contains(from));
        loaded(&ONE.replacen(from, to, 1))
    };
    assert_error(
        with("global", "globel"),
        "`globel` is not one",
        "\"globel\"",
        "did you mean `global`?",
    );
    assert_error(
        with("\"global\"", "\"local\", \"local\""),
        "listed twice",
        "\"local\"",
        "once",
    );
    assert_error(
        with("\"global\"", ""),
        "the list is empty",
        "[]",
        "at least one",
    );
    assert_error(
        with("polygon.toml", "polygone.toml"),
        "does not exist",
        "\"polygone.toml\"",
        "paths count",
    );
    assert_error(
        with("polygon.toml", "."),
        "is not a file",
        "\".\"",
        "paths count",
    );
    assert_error(
        with("title = \"one\"\n", ""),
        "the key `title` is missing",
        "",
        "add `title",
    );
    assert_error(
        with("title = \"one\"", "title = \"one\"\nruns = 0"),
        "0 is too small",
        "0",
        "from 1",
    );
    assert_error(
        with(
            "title = \"one\"",
            "title = \"one\"\npublished = \"none.toml\"",
        ),
        "does not exist",
        "\"none.toml\"",
        "paths count",
    );
    assert_error(
        with("scenario =", "scenari ="),
        "unknown key `scenari`",
        "scenari",
        "did you mean `scenario`?",
    );
    assert_error(
        loaded("title = \"x\"\nexperiments = []"),
        "the list is empty",
        "[]",
        "at least one",
    );
    let twice = format!("{ONE}{}", ONE.replace("title = \"one\"\n", ""));
    assert_error(
        loaded(&twice),
        "both called \"polygon\"",
        "\"polygon.toml\"",
        "label = ",
    );
    let published = format!("{ONE}published = \"polygon\"\n");
    assert_error(
        loaded(&published),
        "no published tables",
        "\"polygon\"",
        "add `published",
    );
    let published = format!("published = \"published.toml\"\n{ONE}published = \"polygn\"\n");
    assert_error(
        loaded(&published),
        "have no \"polygn\"",
        "\"polygn\"",
        "did you mean \"polygon\"?",
    );
}

#[test]
fn a_fault_of_the_scenario_is_shown_in_the_scenario() {
    let folder = Folder::with(ONE);
    fs::write(
        folder.path("polygon.toml"),
        POLYGON.replace("range_cm = 3.0", "range_cm = -1"),
    )
    .unwrap();
    let error = Config::load(&folder.path("config.toml")).unwrap_err();
    assert!(error.path().ends_with("polygon.toml"));
    assert_eq!(error.pointed_at(), Some("-1"));
}

#[test]
fn wrong_published_tables() {
    let folder = Folder::with(ONE);
    let path = folder.path("published.toml");
    let text = fs::read_to_string(&path).unwrap();
    let with = |from: &str, to: &str| {
        assert!(text.contains(from));
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        Published::load(&path)
    };
    assert_error(
        with("[35, 24,", "[35,"),
        "5 runs in `observed`, 4 here",
        "[35, 24, 25, 24]",
        "each run",
    );
    assert_error(
        with("[35, 24,", "[35, 0,"),
        "integer `0`",
        "0",
        "\"-\" for never",
    );
    assert_error(
        with("[35, 24,", "[35, \"x\","),
        "string \"x\"",
        "\"x\"",
        "a step from 1",
    );
    assert_error(
        with("planners.global", "planners.golbal"),
        "`golbal` is not one",
        "golbal",
        "did you mean `global`?",
    );
}

#[test]
fn a_file_is_known_by_its_keys() {
    let folder = Folder::with(ONE);
    for (name, kind) in [
        ("polygon.toml", FileKind::Scenario),
        ("heart.toml", FileKind::Scenario),
        ("config.toml", FileKind::Configuration),
        ("published.toml", FileKind::Published),
    ] {
        assert_eq!(
            FileKind::of_file(&folder.path(name)).unwrap(),
            kind,
            "{name}"
        );
    }
    fs::write(folder.path("other.toml"), "colour = 3\n").unwrap();
    let error = FileKind::of_file(&folder.path("other.toml")).unwrap_err();
    assert!(
        error
            .message()
            .contains("neither a scenario nor a configuration"),
        "{error}"
    );
    assert!(
        FileKind::of_file(folder.0.path())
            .unwrap_err()
            .message()
            .contains("folder")
    );
}
