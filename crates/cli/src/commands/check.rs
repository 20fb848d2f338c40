//! `adslam check`

use std::path::PathBuf;

use adslam_diagnostics::{Failure, InputError};
use adslam_experiment::{CheckedFile, check_file};
use adslam_scenario::registry::Registry;
use serde_json::json;

use crate::CheckArgs;
use crate::answer::{Answer, told_input};
use crate::paths::shown;
use crate::print::{tell, warn};

/// Checks every file and says what each is, or what is wrong with it.
///
/// # Errors
/// That of a single file; of several, that some are not valid, after each has been explained.
pub fn check(args: &CheckArgs, registry: &Registry) -> Result<(), Failure> {
    Answer::give(args.json, |answer| check_all(&args.files, registry, answer))
}

fn check_all(files: &[PathBuf], registry: &Registry, answer: &mut Answer) -> Result<(), Failure> {
    let mut checked = Vec::new();
    let mut wrong = Vec::new();
    for path in files {
        let file = shown(path);
        match check_file(path, registry) {
            Ok(CheckedFile { kind, warnings }) => {
                warn(&warnings);
                answer.say(format_args!("{file}: valid {kind}"));
                let kind = kind.short_name();
                checked.push(
                    json!({ "file": file, "valid": true, "kind": kind, "warnings": warnings }),
                );
            }
            Err(error) => {
                checked.push(json!({ "file": file, "valid": false, "error": told_input(&error) }));
                wrong.push((path, error));
            }
        }
    }
    answer.set("checked", checked);
    if files.len() == 1 {
        return wrong.pop().map_or(Ok(()), |(_, error)| Err(error.into()));
    }
    let count = wrong.len();
    let Some((first, _)) = wrong.first() else {
        return Ok(());
    };
    let message = format!("{count} of {} files are not valid", files.len());
    let summary = InputError::about_file(first, message)
        .with_help("each is explained above; the others can be used");
    for (_, error) in wrong {
        tell(format_args!("{:?}", miette::Report::new(error)));
    }
    Err(summary.into())
}
