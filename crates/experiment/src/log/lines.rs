//! The lines of a log, and errors that name them.

use std::io::{BufRead, Read};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use super::explain::explain;
use crate::diagnostics::InputError;

/// The longest line that is read, in bytes: a step with 2000 features and all their pairs fits.
const LONGEST_LINE: u64 = 256 << 20;

/// A file being read line by line.
#[derive(Debug)]
pub(super) struct Lines<R> {
    reader: R,
    path: PathBuf,
    number: usize,
}

impl<R: BufRead> Lines<R> {
    /// `path` is for messages.
    pub(super) fn new(reader: R, path: &Path) -> Self {
        Self {
            reader,
            path: path.to_owned(),
            number: 0,
        }
    }

    /// The number of the line read last, from 1.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// The next line that is not blank.
    pub(super) fn next(&mut self) -> Result<Option<String>, InputError> {
        loop {
            let mut bytes = Vec::new();
            let read = (&mut self.reader)
                .take(LONGEST_LINE + 1)
                .read_until(b'\n', &mut bytes)
                .map_err(|error| InputError::unreadable(&self.path, error))?;
            if read == 0 {
                return Ok(None);
            }
            self.number += 1;
            if read as u64 > LONGEST_LINE {
                let what = format!("has more than {LONGEST_LINE} bytes");
                return Err(self.error(&what, "a log has a line a step; is it another file?"));
            }
            let line = String::from_utf8(bytes).map_err(|_| {
                self.error(
                    "is not UTF-8 text",
                    "a log is text, a JSON object a line; is it another file?",
                )
            })?;
            if !line.trim().is_empty() {
                return Ok(Some(line));
            }
        }
    }

    /// What `line`, the line read last, says; `kind` (header or step) is what it should be.
    pub(super) fn parse<T: DeserializeOwned>(
        &self,
        line: &str,
        kind: &str,
    ) -> Result<T, InputError> {
        serde_json::from_str(line).map_err(|error| {
            let explanation = explain(&error, line, kind);
            self.error(&explanation.what, &explanation.help)
        })
    }

    /// An error about the line read last.
    pub(super) fn error(&self, what: &str, help: &str) -> InputError {
        let message = format!("{}: line {} {what}", self.path.display(), self.number);
        InputError::about_file(&self.path, message).with_help(help)
    }
}
