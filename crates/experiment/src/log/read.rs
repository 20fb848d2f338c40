//! Reading a log line by line, checking each.

use std::collections::HashSet;
use std::io::BufRead;
use std::path::Path;

use super::format::{FORMAT, LogHeader, LogStep, LogTruth, VERSION};
use super::lines::Lines;
use crate::diagnostics::InputError;
use crate::scenario::values::GateProbability;
use crate::scenario::{EstimatorName, LengthUnit, Named};

/// As many features as a scenario may have: the covariance of more would not fit into memory.
const MOST_FEATURES: usize = 2_000;
/// Entries of a covariance that mirror each other may differ by rounding, relative to the variances.
const ASYMMETRY: f64 = 1e-9;
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
        let log = Self {
            lines,
            last_step: None,
            last_time: header.time,
            header,
            finished: false,
        };
        log.check_header()?;
        log.check_filter()?;
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
        self.last_time = step.time.or(self.last_time);
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
        if LengthUnit::named(&header.length_unit).is_err() {
            let what = format!("has the length unit {:?}", header.length_unit);
            return wrong(what, "write mm, cm or m, and use it for every length");
        }
        if header.features == 0 {
            return wrong(
                "says that there are 0 features".to_owned(),
                "a log needs at least one",
            );
        }
        if header.features > MOST_FEATURES {
            let what = format!("says that there are {} features", header.features);
            return wrong(what, &format!("a log may have up to {MOST_FEATURES}"));
        }
        if header.initial.features.len() != header.features {
            let what = format!(
                "says that there are {} features, and gives the first positions of {}",
                header.features,
                header.initial.features.len()
            );
            return wrong(what, "make the two agree");
        }
        self.check_sigmas()?;
        self.check_pose_covariance()
    }

    /// Sigmas are never negative, and what is divided by is above 0.
    fn check_sigmas(&self) -> Result<(), InputError> {
        let (noise, initial) = (&self.header.noise, &self.header.initial);
        let may_be_zero = [
            ("noise.rotation_sigma", noise.rotation_sigma),
            ("noise.translation_sigma", noise.translation_sigma),
            ("noise.feature_motion_sigma", noise.feature_motion_sigma),
            ("initial.feature_sigma", initial.feature_sigma),
        ];
        let above_zero = [
            (
                "noise.feature_measurement_sigma",
                noise.feature_measurement_sigma,
            ),
            (
                "noise.structure_measurement_sigma",
                noise.structure_measurement_sigma,
            ),
        ];
        for (key, sigma) in may_be_zero {
            if sigma < 0.0 {
                let what = format!("has {sigma} in {key}");
                return Err(self.error(&what, "a sigma is not negative: write 0 or more"));
            }
        }
        for (key, sigma) in above_zero {
            if sigma <= 0.0 {
                let what = format!("has {sigma} in {key}");
                let help = "no measurement is exact, and none has a negative sigma: write a number above 0";
                return Err(self.error(&what, help));
            }
        }
        Ok(())
    }

    /// Whether it can be a covariance at first sight; whether it really is one the first belief checks.
    fn check_pose_covariance(&self) -> Result<(), InputError> {
        let covariance = &self.header.initial.pose_covariance;
        for (i, row) in covariance.iter().enumerate() {
            let variance = row[i];
            if variance < 0.0 {
                let what = format!("has the variance {variance} in pose_covariance[{i}][{i}]");
                return Err(self.error(&what, "variances are squares of sigmas: write 0 or more"));
            }
            for (j, other) in covariance.iter().enumerate().take(i) {
                let (below, above) = (row[j], other[i]);
                let scale = variance.max(other[j]).max(below.abs());
                if (below - above).abs() > ASYMMETRY * scale {
                    let what = format!(
                        "has {below} in pose_covariance[{i}][{j}] and {above} in \
                         pose_covariance[{j}][{i}]"
                    );
                    return Err(self.error(&what, "a covariance is symmetric: make them equal"));
                }
            }
        }
        Ok(())
    }

    /// Whether there is such a filter.
    fn check_filter(&self) -> Result<(), InputError> {
        let Some(filter) = &self.header.filter else {
            return Ok(());
        };
        if let Some(name) = &filter.estimator
            && let Err(reason) = EstimatorName::named(name)
        {
            let what = format!("has a filter that there is not: {reason}");
            return Err(self.error(&what, "or leave filter out, and say it with --estimator"));
        }
        if let Some(probability) = filter.gate_probability
            && GateProbability::new(probability).is_err()
        {
            let what = format!("has the gate probability {probability}");
            return Err(self.error(&what, "write a number above 0 and below 1, or leave it out"));
        }
        Ok(())
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
