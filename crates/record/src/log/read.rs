//! Reading a log line by line, checking each.

use std::collections::HashSet;
use std::io::BufRead;
use std::path::Path;

use adslam_diagnostics::InputError;

use super::format::{LogHeader, LogStep, LogTruth};
use super::header::check_header;
use super::lines::Lines;

/// Sums over all pairs cancel but for rounding, relative to their sizes.
const UNBALANCED: f64 = 1e-6;

/// A log being read. Gives the steps after the header; ends after an error.
#[derive(Debug)]
pub struct LogReader<R> {
    lines: Lines<R>,
    header: LogHeader,
    last_step: Option<u64>,
    last_time: Option<f64>,
    finished: bool,
}

impl<R: BufRead> LogReader<R> {
    /// Reads and checks the header. `path` is for messages.
    ///
    /// # Errors
    /// [`InputError`] with the line, what is wrong with it, and what to do.
    pub fn new(reader: R, path: &Path) -> Result<Self, InputError> {
        let mut lines = Lines::new(reader, path)?;
        let first = lines.next()?.ok_or_else(|| {
            InputError::about_file(path, format!("{} is empty", path.display()))
                .with_help("the first line of a log is its header; see docs/log.md")
        })?;
        let header: LogHeader = lines.parse(&first, "header")?;
        check_header(&header, &lines)?;
        let log = Self {
            lines,
            last_step: None,
            last_time: header.time,
            header,
            finished: false,
        };
        log.check_truth(log.header.truth.as_ref())?;
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
        self.lines.number()
    }

    /// The next step; `None` at the end.
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
        self.last_time = step.time.or(self.last_time);
        self.finished = false;
        Ok(Some(step))
    }

    fn check_truth(&self, truth: Option<&LogTruth>) -> Result<(), InputError> {
        let count = self.header.features;
        match truth {
            Some(truth) if truth.features.len() != count => {
                let what = format!(
                    "has the true positions of {} features, and the log has {count}",
                    truth.features.len()
                );
                Err(self.error(&what, "truth.features has one [x, y, z] for each feature"))
            }
            _ => Ok(()),
        }
    }

    /// Whether time goes on.
    fn check_time(&self, step: &LogStep) -> Result<(), InputError> {
        match (self.last_time, step.time) {
            (Some(last), Some(time)) if time <= last => {
                let what = format!("(step {}) has the time {time} after {last}", step.step);
                Err(self.error(&what, "times are seconds, and grow from step to step"))
            }
            _ => Ok(()),
        }
    }

    /// Whether the sums over all pairs can be such.
    fn check_sums(&self, step: &LogStep, sums: &[[f64; 3]]) -> Result<(), InputError> {
        let (n, count) = (step.step, self.header.features);
        let wrong = |what: String, help: &str| Err(self.error(&what, help));
        if !step.structure_measurements.is_empty() {
            let what = format!("(step {n}) has structure_sums and structure_measurements");
            return wrong(what, "the sums hold all pairs: give one of the two");
        }
        if sums.len() != count {
            let what = format!(
                "(step {n}) has {} structure_sums, and the log has {count} features",
                sums.len()
            );
            return wrong(what, "structure_sums has one [x, y, z] for each feature");
        }
        for axis in 0..3 {
            let of_axis = || sums.iter().map(|sum| sum[axis]);
            let (total, size) = (of_axis().sum::<f64>(), of_axis().map(f64::abs).sum::<f64>());
            if !total.is_finite() || total.abs() > UNBALANCED * size {
                let what = format!("(step {n}) has structure_sums that add up to {total}, not 0");
                return wrong(
                    what,
                    "each pair goes into two sums, once as p_i - p_j and once as p_j - p_i",
                );
            }
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
        self.check_time(step)?;
        self.check_truth(step.truth.as_ref())?;
        if let Some(sums) = &step.structure_sums {
            self.check_sums(step, sums)?;
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

    /// An error about the line read last.
    pub(super) fn error(&self, what: &str, help: &str) -> InputError {
        self.lines.error(what, help)
    }
}
