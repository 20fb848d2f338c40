//! Golden whole runs: what every planner decided on both environments, as text that is kept and
//! compared with. `cargo xtask golden-runs` renews it.

use std::fmt;

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::provenance::RESULTS_VERSION;
use adslam_names::PlannerName;
use adslam_setup::Setup;
use rayon::prelude::*;

use crate::setup;

mod recorder;

/// Where they are kept, in `tests/fixtures`.
pub const GOLDEN_RUNS: &str = "golden/runs.txt";

/// Beyond the seeds of the published tables.
const SEED: u64 = 101;

const VERSION: &str = "results_version = ";

/// Numbers with decimals are written to 10⁻⁶ cm or rad. They may differ by one of the last digit: the
/// last bits of a sum or a sine are not the same on every machine.
const TOLERANCE: f64 = 1.5e-6;

const HEAD: &str = "\
# What every planner decided in whole runs. `cargo xtask golden-runs` renews this file, see docs/testing.md.
#
# A line for each step: the estimated pose (rad, cm), then the decision taken there. The action is its place
# in the action set, or for the predetermined path its control.
#
# step      roll     pitch       yaw           x           y           z  action goal admissible safe scored trace
";

/// Whole runs, and by which version of results they were made.
#[derive(Clone, Debug, PartialEq)]
pub struct GoldenRuns {
    /// [`RESULTS_VERSION`] of the program that made them.
    pub version: u32,
    /// The runs.
    pub runs: Vec<GoldenRun>,
}

/// A run as text.
#[derive(Clone, Debug, PartialEq)]
pub struct GoldenRun {
    /// Scenario, planner and seed.
    pub name: String,
    /// A line for each viewpoint, then one for each step.
    pub lines: Vec<String>,
}

/// What the file of golden runs has to become.
#[derive(Clone, Debug, PartialEq)]
pub enum Renewal {
    /// It holds what the program does.
    UpToDate,
    /// This text.
    Write(String),
}

impl GoldenRuns {
    /// Does all runs.
    ///
    /// # Errors
    /// A run that fails, or is interrupted.
    ///
    /// # Panics
    /// If a shipped scenario is not valid.
    pub fn record(interrupt: &Interrupt) -> Result<Self, Failure> {
        let setups = ["polygon.toml", "heart.toml"].map(|name| setup(name, &[]));
        let runs: Vec<(&Setup, PlannerName)> = setups
            .iter()
            .flat_map(|setup| PlannerName::PAPER.map(|planner| (setup, planner)))
            .collect();
        let runs: Result<_, _> = runs
            .into_par_iter()
            .map(|(setup, planner)| GoldenRun::record(setup, planner, SEED, interrupt))
            .collect();
        Ok(Self {
            version: RESULTS_VERSION,
            runs: runs?,
        })
    }

    /// From the text of a file.
    ///
    /// # Errors
    /// Text that is no such file, with what is wrong.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut lines = text.lines().filter(|line| !is_left_out(line));
        let version = lines
            .next()
            .and_then(|line| line.strip_prefix(VERSION)?.parse().ok())
            .ok_or("the first line does not say the version of results")?;
        let mut runs: Vec<GoldenRun> = Vec::new();
        for line in lines {
            if let Some(name) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) {
                runs.push(GoldenRun {
                    name: name.to_owned(),
                    lines: Vec::new(),
                });
            } else {
                let run = runs.last_mut().ok_or("a step stands before any run")?;
                run.lines.push(line.to_owned());
            }
        }
        Ok(Self { version, runs })
    }

    /// The first line that differs in a run that both hold.
    #[must_use]
    pub fn first_difference(&self, now: &Self) -> Option<Difference> {
        self.runs.iter().find_map(|golden| {
            let now = now.runs.iter().find(|run| run.name == golden.name)?;
            golden.first_difference(now)
        })
    }

    /// What the file, if there is one, has to become for these runs, which the program has just done.
    ///
    /// # Errors
    /// Runs that have changed while the version of results has not risen, or a file that cannot be
    /// read.
    pub fn renewal_of(&self, file: Option<&str>) -> Result<Renewal, String> {
        if let Some(text) = file {
            let golden = Self::parse(text)?;
            if golden.version > self.version {
                return Err(format!(
                    "the golden runs are of version {} of results, this program is of version {}",
                    golden.version, self.version
                ));
            }
            let difference = golden.first_difference(self);
            if golden.version == self.version {
                if let Some(difference) = difference {
                    return Err(format!(
                        "{difference}\nWhere that is meant, raise RESULTS_VERSION in \
                         crates/experiment/src/provenance.rs, so that nobody takes new results for \
                         old ones, and renew the golden runs then."
                    ));
                }
                if golden.names().eq(self.names()) {
                    return Ok(Renewal::UpToDate);
                }
            }
        }
        Ok(Renewal::Write(self.to_string()))
    }

    /// The runs' names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.runs.iter().map(|run| run.name.as_str())
    }
}

impl fmt::Display for GoldenRuns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{HEAD}{VERSION}{}", self.version)?;
        for run in &self.runs {
            writeln!(f, "\n[{}]", run.name)?;
            run.lines
                .iter()
                .try_for_each(|line| writeln!(f, "{line}"))?;
        }
        Ok(())
    }
}

impl GoldenRun {
    fn first_difference(&self, now: &Self) -> Option<Difference> {
        (0..self.lines.len().max(now.lines.len()))
            .map(|i| [&self.lines, &now.lines].map(|lines| lines.get(i)))
            .find(|[golden, now]| match (golden, now) {
                (Some(golden), Some(now)) => !says_the_same(golden, now),
                _ => true,
            })
            .map(|[golden, other]| Difference {
                run: self.name.clone(),
                golden: golden.cloned(),
                now: other.cloned(),
            })
    }
}

/// Where two runs part.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The run's name.
    pub run: String,
    /// The line as it was, if the run was so long.
    pub golden: Option<String>,
    /// The line as it is now, if the run is so long.
    pub now: Option<String>,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { run, golden, now } = self;
        let line = golden.as_ref().or(now.as_ref());
        let mut words = line.iter().flat_map(|line| line.split_whitespace());
        let place = match words.next() {
            Some("viewpoint") => format!("viewpoint {}", words.next().unwrap_or_default()),
            step => format!("step {}", step.unwrap_or_default()),
        };
        let text = |line: &Option<String>| line.clone().unwrap_or("(the run is over)".to_owned());
        writeln!(f, "{run}: {place} is the first that differs")?;
        writeln!(f, "  golden: {}", text(golden))?;
        write!(f, "  now:    {}", text(now))
    }
}

fn is_left_out(line: &str) -> bool {
    line.is_empty() || line.starts_with('#')
}

/// Whether two lines hold the same words, and the same numbers but for the last digit.
fn says_the_same(golden: &str, now: &str) -> bool {
    let mut others = now.split_whitespace();
    golden.split_whitespace().all(|word| {
        others.next().is_some_and(|other| {
            word == other
                || matches!(
                    (decimal(word), decimal(other)),
                    (Some(a), Some(b)) if (a - b).abs() < TOLERANCE
                )
        })
    }) && others.next().is_none()
}

/// A number with decimals; counts and places have none.
fn decimal(word: &str) -> Option<f64> {
    word.parse().ok().filter(|_| word.contains('.'))
}
