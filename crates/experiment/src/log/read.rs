//! Reading a log line by line, checking each.

use std::collections::HashSet;
use std::io::{BufRead, Read};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use super::format::{FORMAT, LogHeader, LogStep, VERSION};
use crate::diagnostics::InputError;

/// The longest line that is read: a step with a few thousand features and all their pairs fits.
const LONGEST_LINE: u64 = 1 << 30;

/// A log being read. Gives the steps after the header; ends after an error.
#[derive(Debug)]
pub struct LogReader<R> {
    lines: Lines<R>,
    header: LogHeader,
    last_step: Option<u64>,
    finished: bool,
}

impl<R: BufRead> LogReader<R> {
    /// Reads and checks the header. `path` is for messages.
    ///
    /// # Errors
    /// [`InputError`] with the line, what is wrong with it, and what to do.
    pub fn new(reader: R, path: &Path) -> Result<Self, InputError> {
        let mut lines = Lines {
            reader,
            path: path.to_owned(),
            number: 0,
        };
        let first = lines.next()?.ok_or_else(|| {
            InputError::about_file(path, format!("{} is empty", path.display()))
                .with_help("the first line of a log is its header; see docs/log.md")
        })?;
        let header = lines.parse(&first, "header")?;
        let log = Self {
            lines,
            header,
            last_step: None,
            finished: false,
        };
        log.check_header()?;
        Ok(log)
    }

    /// The header.
    #[must_use]
    pub fn header(&self) -> &LogHeader {
        &self.header
    }

    /// The number of the line read last, from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        self.lines.number
    }

    /// The next step; nothing at the end.
    ///
    /// # Errors
    /// [`InputError`] with the line, what is wrong with it, and what to do.
    pub fn next_step(&mut self) -> Result<Option<LogStep>, InputError> {
        if self.finished {
            return Ok(None);
        }
        // Whatever goes wrong, nothing after it can be trusted.
        self.finished = true;
        let Some(line) = self.lines.next()? else {
            return Ok(None);
        };
        let step: LogStep = self.lines.parse(&line, "step")?;
        self.check_step(&step)?;
        self.last_step = Some(step.step);
        self.finished = false;
        Ok(Some(step))
    }

    fn check_header(&self) -> Result<(), InputError> {
        let header = &self.header;
        let wrong = |what: String, help: &str| Err(self.error(&what, help));
        if header.format != FORMAT {
            let what = format!("has the format {:?}", header.format);
            return wrong(what, &format!("write \"format\": \"{FORMAT}\""));
        }
        if header.version != VERSION {
            let what = format!("has version {}", header.version);
            return wrong(what, &format!("this program reads version {VERSION}"));
        }
        if !["mm", "cm", "m"].contains(&header.length_unit.as_str()) {
            let what = format!("has the length unit {:?}", header.length_unit);
            return wrong(what, "write mm, cm or m, and use it for every length");
        }
        if header.features == 0 {
            return wrong(
                "says that there are 0 features".to_owned(),
                "a log needs at least one",
            );
        }
        if header.initial.features.len() != header.features {
            let what = format!(
                "says that there are {} features, and gives the first positions of {}",
                header.features,
                header.initial.features.len()
            );
            return wrong(what, "make the two agree");
        }
        Ok(())
    }

    fn check_step(&self, step: &LogStep) -> Result<(), InputError> {
        let count = self.header.features;
        let wrong = |what: String, help: &str| Err(self.error(&what, help));
        let n = step.step;
        if let Some(last) = self.last_step
            && last.checked_add(1) != Some(n)
        {
            let what = format!("is step {n} after step {last}");
            return wrong(
                what,
                "steps follow each other without gaps; sort or complete the log",
            );
        }
        if step.feature_motion.len() != count {
            let what = format!(
                "(step {n}) gives the motion of {} features, and the log has {count}",
                step.feature_motion.len()
            );
            return wrong(what, "feature_motion has one [x, y, z] for each feature");
        }
        let range = format!("the log has features 0 to {}", count - 1);
        let mut seen = HashSet::new();
        for measurement in &step.feature_measurements {
            let id = measurement.id;
            if id >= count {
                return wrong(
                    format!("(step {n}) measures the unknown feature {id}"),
                    &range,
                );
            }
            if !seen.insert(id) {
                let what = format!("(step {n}) measures feature {id} twice");
                return wrong(what, "give one measurement of each feature in a step");
            }
        }
        for pair in &step.structure_measurements {
            let (from, to) = (pair.from, pair.to);
            if from >= count || to >= count {
                let what = format!("(step {n}) measures the unknown pair {from} to {to}");
                return wrong(what, &range);
            }
            if from >= to {
                let what = format!("(step {n}) measures a pair from {from} to {to}");
                return wrong(
                    what,
                    "write each pair with from < to, and z = p_to - p_from",
                );
            }
        }
        Ok(())
    }

    fn error(&self, what: &str, help: &str) -> InputError {
        self.lines.error(what, help)
    }
}

/// The lines of a file, and errors that name them.
#[derive(Debug)]
struct Lines<R> {
    reader: R,
    path: PathBuf,
    /// Of the line read last, from 1.
    number: usize,
}

impl<R: BufRead> Lines<R> {
    /// The next line that is not blank.
    fn next(&mut self) -> Result<Option<String>, InputError> {
        loop {
            let mut bytes = Vec::new();
            let mut limited = (&mut self.reader).take(LONGEST_LINE);
            let read = limited
                .read_until(b'\n', &mut bytes)
                .map_err(|error| InputError::unreadable(&self.path, error))?;
            if read == 0 {
                return Ok(None);
            }
            self.number += 1;
            let line = String::from_utf8(bytes).map_err(|_| {
                self.error("is not UTF-8 text", "a log is text, a JSON object a line")
            })?;
            if !line.trim().is_empty() {
                return Ok(Some(line));
            }
        }
    }

    fn parse<T: DeserializeOwned>(&self, line: &str, kind: &str) -> Result<T, InputError> {
        serde_json::from_str(line).map_err(|error| {
            // serde_json counts lines within the line.
            let reason = error.to_string();
            let reason = reason.split(" at line ").next().unwrap_or(&reason);
            let column = error.column();
            if error.is_eof() {
                return self.error(
                    &format!("ends in the middle of the {kind} (column {column}): {reason}"),
                    "the log was cut off; remove the broken line, or keep what is complete with \
                     --keep-complete",
                );
            }
            self.error(
                &format!("(column {column}) is no valid {kind}: {reason}"),
                "docs/log.md shows the keys of each line",
            )
        })
    }

    fn error(&self, what: &str, help: &str) -> InputError {
        let message = format!("{}: line {} {what}", self.path.display(), self.number);
        InputError::about_file(&self.path, message).with_help(help)
    }
}
