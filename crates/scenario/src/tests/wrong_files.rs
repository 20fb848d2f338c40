//! What is said about files that are no scenarios at all.

use std::path::Path;

use super::{assert_error, miette_report, parsed, polygon_with};
use crate::Scenario;

#[test]
fn a_missing_file_is_named() {
    let error = Scenario::load(Path::new("no/such/file.toml")).unwrap_err();
    assert!(
        error.message().contains("cannot read no/such/file.toml"),
        "{error}"
    );
    assert!(error.remedy().unwrap().contains("check the path"));
}

#[test]
fn a_folder_is_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let error = Scenario::load(folder.path()).unwrap_err();
    assert!(error.message().contains("is a folder"), "{error}");
}

#[test]
fn garbage_is_no_text() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("garbage.toml");
    std::fs::write(&path, [0x89, 0x50, 0xff, 0x00, 0xfe]).unwrap();
    let error = Scenario::load(&path).unwrap_err();
    assert!(error.message().contains("is not text"), "{error}");
    assert!(error.remedy().unwrap().contains("TOML"));
}

#[test]
fn an_absurdly_large_file_is_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.toml");
    std::fs::File::create(&path)
        .unwrap()
        .set_len(1 << 40)
        .unwrap();
    let error = Scenario::load(&path).unwrap_err();
    assert!(error.message().contains("bytes"), "{error}");
}

#[test]
fn an_empty_file_is_called_so() {
    for empty in ["", "\n\n", "# only a comment\n"] {
        let error = parsed(empty).unwrap_err();
        assert!(error.message().contains("has no keys"), "{error}");
        assert!(error.remedy().unwrap().contains("`adslam new` writes"));
    }
}

#[test]
fn bad_syntax_is_shown_where_it_is() {
    assert_error(
        parsed("name = \n"),
        "neither a number nor a text in quotes",
        "",
        "",
    );
    assert_error(
        parsed("name = \"a\nsteps = 4"),
        "invalid basic string",
        "",
        "",
    );
    let error = parsed("[object\nname = 3").unwrap_err();
    assert!(error.span().is_some());
}

/// Nobody reads a thousand lines to find what is wrong in one.
#[test]
fn a_long_text_is_not_shown_whole() {
    let lists = "[1, 2, 3],\n".repeat(1000);
    let many = polygon_with("yaw_deg = [", &format!("yaw_deg = [\n{lists}")).unwrap_err();
    let report = miette_report(&many);
    assert!(report.lines().count() < 20, "{report}");
    assert!(report.contains("sequence cannot stand here"), "{report}");

    let long = format!("description = \"é\"\nsteps = [{}]\n", "1, ".repeat(100_000));
    let error = parsed(&long).unwrap_err();
    let report = miette_report(&error);
    assert!(report.len() < 2000, "{report}");
    assert!(report.contains("(line 2, column 9)"), "{report}");
    assert_eq!(error.line_and_column(), Some((2, 9)));
}

/// The whole report, as a user sees it.
#[test]
fn a_report_shows_file_line_caret_and_remedy() {
    let report = miette_report(&polygon_with("range_cm = 3.0", "range_cm = -3.0").unwrap_err());
    for part in [
        "-3 is not above 0",
        "test.toml:53:12",
        "range_cm = -3.0",
        "here",
        "help: write a number above 0",
    ] {
        assert!(report.contains(part), "{part}:\n{report}");
    }
}
