//! The lines of a log, and errors that name them.

use std::io::{self, BufRead, Read};
use std::path::{Path, PathBuf};

use adslam_diagnostics::InputError;
use serde::de::DeserializeOwned;

use super::explain::explain;
use super::source::Source;

/// The longest line that is read, in bytes: a step with 2000 features and all their pairs fits.
const LONGEST_LINE: u64 = 256 << 20;

/// What some editors write before a text in UTF-8.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// What a text in UTF-16 may begin with.
const UTF_16: [&[u8]; 2] = [&[0xff, 0xfe], &[0xfe, 0xff]];

/// A file being read line by line.
#[derive(Debug)]
pub(super) struct Lines<R> {
    reader: Source<R>,
    path: PathBuf,
    number: usize,
}

impl<R: BufRead> Lines<R> {
    /// `path` is for messages.
    pub(super) fn new(reader: R, path: &Path) -> Result<Self, InputError> {
        let reader = Source::new(reader).map_err(|error| InputError::unreadable(path, error))?;
        Ok(Self {
            reader,
            path: path.to_owned(),
            number: 0,
        })
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
                .read_until(b'\n', &mut bytes);
            let read = match read {
                Ok(0) => return Ok(None),
                Ok(read) => read,
                Err(error) => {
                    self.number += 1;
                    return Err(self.unreadable(error));
                }
            };
            self.number += 1;
            if read as u64 > LONGEST_LINE {
                let what = format!("has more than {LONGEST_LINE} bytes");
                return Err(self.error(&what, "a log has a line a step; is it another file?"));
            }
            let mut line = String::from_utf8(bytes).map_err(|error| {
                let help = if self.number == 1
                    && UTF_16.iter().any(|mark| error.as_bytes().starts_with(mark))
                {
                    "it looks like UTF-16: save the log as UTF-8"
                } else {
                    "a log is text, a JSON object a line; is it another file?"
                };
                self.error("is not UTF-8 text", help)
            })?;
            if self.number == 1 && line.starts_with(BYTE_ORDER_MARK) {
                line.remove(0);
            }
            if !line.trim().is_empty() {
                return Ok(Some(line));
            }
        }
    }

    /// Why the line after the one read last could not be read.
    fn unreadable(&self, error: io::Error) -> InputError {
        match self.reader.damage(&error) {
            Some((what, help)) => self.error(&what, help),
            None => InputError::unreadable(&self.path, error),
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
