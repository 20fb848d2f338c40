//! Why an experiment, a replayed log or a table could not be finished.

use std::error::Error;
use std::io;
use std::path::{Path, PathBuf};

use miette::Diagnostic;

use crate::InputError;

/// Everything that can stop a run, a study, or the writing of what they leave.
///
/// Every message is complete: it contains that of its cause, and `source` gives none.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub enum Failure {
    /// The input cannot be used; nothing was run.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Input(#[from] InputError),
    /// A decision failed during a run.
    #[error("{run}: the planner failed at step {step}: {cause}")]
    Planning {
        /// Which run.
        run: String,
        /// The step at which it had to decide.
        step: usize,
        /// What happened.
        cause: Box<dyn Error + Send + Sync>,
    },
    /// The filter failed during a run or a replay.
    #[error("{run}: the filter failed at step {step}: {cause}")]
    Filter {
        /// Which run or log.
        run: String,
        /// The step that it was computing.
        step: usize,
        /// What happened.
        cause: Box<dyn Error + Send + Sync>,
    },
    /// The simulated object or the error of an estimate cannot be computed any more.
    #[error("{run}: step {step} cannot be simulated: {cause}")]
    Simulation {
        /// Which run.
        run: String,
        /// The step.
        step: usize,
        /// What happened.
        cause: Box<dyn Error + Send + Sync>,
    },
    /// A result could not be written. What was there before is unchanged.
    #[error("cannot write {}: {cause}", path.display())]
    #[diagnostic(help(
        "what was there is unchanged; check that the folder is writable and the disk has room"
    ))]
    Output {
        /// Which file or folder.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// Some of many runs failed; the others were finished and written.
    #[error("{} of the runs failed:\n{}", failures.len(), first_of(failures))]
    #[diagnostic(help("the other runs were finished and written"))]
    Runs {
        /// What happened to each.
        failures: Vec<String>,
    },
    /// The user asked to stop.
    #[error("interrupted")]
    #[diagnostic(help("runs that had finished were written, half-written files were not"))]
    Interrupted,
}

impl Failure {
    /// Whether the input is to blame, rather than the work itself.
    #[must_use]
    pub const fn is_bad_input(&self) -> bool {
        matches!(self, Self::Input(_))
    }

    /// An error where some of many runs were not done: [`Self::Interrupted`] where the user stopped them, else
    /// [`Self::Runs`] where some failed.
    pub fn unless_complete(interrupted: bool, failures: Vec<String>) -> Result<(), Self> {
        match (interrupted, failures.is_empty()) {
            (true, _) => Err(Self::Interrupted),
            (false, true) => Ok(()),
            (false, false) => Err(Self::Runs { failures }),
        }
    }

    /// Turns what a writer says into the error that names its file.
    pub fn output<E: Into<io::Error>>(path: &Path) -> impl FnOnce(E) -> Self + '_ {
        move |cause| Self::Output {
            path: path.to_owned(),
            cause: cause.into(),
        }
    }
}

/// The first failures, and how many more there are: thousands of runs may fail for one reason.
fn first_of(failures: &[String]) -> String {
    const SHOWN: usize = 10;
    let shown = failures.len().min(SHOWN);
    let mut text = failures[..shown].join("\n");
    if failures.len() > shown {
        text += &format!("\nand {} more", failures.len() - shown);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thousand_failures_are_told_in_a_few_lines() {
        let said = |count: usize| {
            let failures = (0..count).map(|run| format!("run {run}")).collect();
            Failure::Runs { failures }.to_string()
        };
        assert_eq!(said(2), "2 of the runs failed:\nrun 0\nrun 1");
        assert!(said(10).ends_with("\nrun 9"));
        assert!(said(1000).ends_with("\nrun 9\nand 990 more"));
    }
}
