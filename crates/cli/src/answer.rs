//! What a command answers on the standard output.

use std::fmt::Display;
use std::path::Path;

use adslam_diagnostics::{Failure, InputError};
use miette::Diagnostic;
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::exit::code;
use crate::paths::shown;
use crate::print::{print, say, warn};

/// An answer: lines for people as they come or, with `--json`, one object for machines at the end.
/// Progress, warnings and explained errors go to the standard error stream either way.
pub(crate) struct Answer {
    object: Option<Map<String, Value>>,
}

impl Answer {
    /// Does `work` and completes the answer by whether it went well, and what went wrong.
    pub(crate) fn give(
        json: bool,
        work: impl FnOnce(&mut Self) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        // It comes first, however the work ends.
        let begun = || Map::from_iter([("ok".to_owned(), Value::Null)]);
        let mut answer = Self {
            object: json.then(begun),
        };
        let result = work(&mut answer);
        if let Some(mut object) = answer.object {
            object.insert("ok".to_owned(), result.is_ok().into());
            if let Err(error) = &result {
                object.insert("exit_code".to_owned(), code(error).into());
                object.insert("error".to_owned(), told(error));
            }
            let printed = print(Value::Object(object));
            return result.and(printed);
        }
        result
    }

    /// A line for people.
    pub(crate) fn say(&self, line: impl Display) {
        if self.object.is_none() {
            say(line);
        }
    }

    /// A key for machines.
    pub(crate) fn set(&mut self, key: &str, value: impl Serialize) {
        if let Some(object) = &mut self.object {
            let value = serde_json::to_value(value).unwrap_or(Value::Null);
            object.insert(key.to_owned(), value);
        }
    }

    /// The files that were written.
    pub(crate) fn set_files<P: AsRef<Path>>(&mut self, files: &[P]) {
        let names: Vec<_> = files.iter().map(|file| shown(file.as_ref())).collect();
        self.set("files", names);
    }

    /// Warnings, for both.
    pub(crate) fn warn(&mut self, warnings: &[String]) {
        warn(warnings);
        if warnings.is_empty() {
            return;
        }
        if let Some(object) = &mut self.object {
            let told = object.entry("warnings").or_insert_with(|| json!([]));
            if let Value::Array(told) = told {
                told.extend(warnings.iter().map(|warning| json!(warning)));
            }
        }
    }
}

/// An error of any kind for machines.
fn told(error: &Failure) -> Value {
    match error {
        Failure::Input(error) => told_input(error),
        Failure::Runs { failures } => {
            json!({ "message": "some of the runs failed", "failures": failures })
        }
        error => json!({
            "message": error.to_string(),
            "help": error.help().map(|help| help.to_string()),
        }),
    }
}

/// What is wrong with an input, and where, for machines. Lines and columns count from 1, columns in
/// characters; both are null where the whole file is to blame.
pub(crate) fn told_input(error: &InputError) -> Value {
    let (line, column) = error.line_and_column().unzip();
    json!({
        "message": error.message(),
        "help": error.remedy(),
        "file": shown(error.path()),
        "line": line,
        "column": column,
    })
}
