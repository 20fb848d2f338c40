//! Tests of scenario files: the shipped ones, and what is said about wrong ones.

mod advice;
mod anything;
mod documented;
mod shipped;
mod written;
mod wrong_choices;
mod wrong_files;
mod wrong_motions;
mod wrong_values;
mod wrong_worlds;

use std::path::{Path, PathBuf};

use adslam_diagnostics::InputError;

use super::Scenario;

pub(crate) const POLYGON: &str = include_str!("../../../../scenarios/polygon.toml");
pub(crate) const HEART: &str = include_str!("../../../../scenarios/heart.toml");
pub(crate) const ROTATING: &str = include_str!("../../../../scenarios/rotating.toml");

/// A file of the repository.
pub(crate) fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

/// A scenario from a text, as if from a file.
fn parsed(text: &str) -> Result<Scenario, InputError> {
    Scenario::parse(text, Path::new("test.toml"))
}

/// The polygon with the first `from` replaced by `to`.
fn polygon_with(from: &str, to: &str) -> Result<Scenario, InputError> {
    assert!(POLYGON.contains(from), "the polygon has no {from:?}");
    parsed(&POLYGON.replacen(from, to, 1))
}

/// The polygon with one text replaced by another is refused.
#[track_caller]
fn refused(from: &str, to: &str, message: &str, pointed_at: &str, remedy: &str) {
    assert_error(polygon_with(from, to), message, pointed_at, remedy);
}

/// Asserts what an error says, what its caret points at, and what remedy it gives.
#[track_caller]
pub(crate) fn assert_error<T>(
    result: Result<T, InputError>,
    message: &str,
    pointed_at: &str,
    remedy: &str,
) {
    let error = result.err().expect("an error");
    let shown = format!("{:?}", miette_report(&error));
    assert!(error.message().contains(message), "{shown}");
    assert_eq!(error.pointed_at(), Some(pointed_at), "{shown}");
    assert!(
        error.remedy().unwrap_or_default().contains(remedy),
        "{shown}"
    );
}

/// The error as a user sees it, without colours.
pub(crate) fn miette_report(error: &InputError) -> String {
    let mut shown = String::new();
    let theme = miette::GraphicalTheme::unicode_nocolor();
    let handler = miette::GraphicalReportHandler::new_themed(theme).with_width(100);
    handler.render_report(&mut shown, error).expect("a report");
    shown
}
