//! history.json: written whole, read with care.

use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, InputError, read_text};
use serde::Deserialize;

use super::{DrawnSurface, HISTORY_FILE, HISTORY_FORMAT, HISTORY_VERSION, HistoryStep, RunHistory};
use crate::AtomicFile;

/// The largest file that is read, in bytes: a run of the heart takes a few million.
const LARGEST_FILE: u64 = 1 << 30;

/// What every version of the file has.
#[derive(Deserialize)]
struct Header {
    format: Option<String>,
    version: Option<u32>,
}

impl RunHistory {
    /// The run as a file that will lie in `folder`; it still has to be committed.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn to_file(&self, folder: &Path) -> Result<AtomicFile, Failure> {
        let path = folder.join(HISTORY_FILE);
        let mut json = serde_json::to_vec(self).map_err(Failure::output(&path))?;
        json.push(b'\n');
        AtomicFile::with_content(&path, &json)
    }

    /// Reads the history of the run in `folder`.
    ///
    /// # Errors
    /// A file that is missing, of another kind or version, cut short, or whose parts do not fit
    /// each other.
    pub fn load(folder: &Path) -> Result<Self, InputError> {
        let (path, text) = Self::text(folder)?;
        Self::parse(&path, &text)
    }

    /// The path of the history in `folder`, and its text.
    pub fn text(folder: &Path) -> Result<(PathBuf, String), InputError> {
        let path = folder.join(HISTORY_FILE);
        let remedy = "give the folder of a run: `adslam run` writes history.json into it";
        let text =
            read_text(&path, LARGEST_FILE, remedy).map_err(|error| error.with_help(remedy))?;
        Ok((path, text))
    }

    /// Reads a history from `text`, the content of the file at `path`.
    ///
    /// # Errors
    /// As [`RunHistory::load`], but for a file that is missing.
    pub fn parse(path: &Path, text: &str) -> Result<Self, InputError> {
        let again = "make the run again with `adslam run`";
        let shown = path.display();
        let about = |message: String| InputError::about_file(path, message).with_help(again);
        let broken = |cause: serde_json::Error| {
            about(if cause.is_eof() {
                format!("{shown} ends in the middle of the run")
            } else {
                format!("{shown} cannot be read as the history of a run: {cause}")
            })
        };
        let header: Header = serde_json::from_str(text).map_err(broken)?;
        if header.format.as_deref() != Some(HISTORY_FORMAT) {
            return Err(about(format!("{shown} is not the history of a run")));
        }
        let is_known = |version: u32| (1..=HISTORY_VERSION).contains(&version);
        if !header.version.is_some_and(is_known) {
            let version = header
                .version
                .map_or("none".to_owned(), |version| version.to_string());
            return Err(about(format!(
                "{shown} has version {version}; this adslam reads versions 1 to \
                 {HISTORY_VERSION}"
            )));
        }
        let history: Self = serde_json::from_str(text).map_err(broken)?;
        match history.check() {
            Ok(()) => Ok(history),
            Err(reason) => Err(about(format!("{shown} does not fit together: {reason}"))),
        }
    }

    /// Whether all sizes and numbers agree; a reader may index without fear then.
    ///
    /// # Errors
    /// What does not.
    pub fn check(&self) -> Result<(), String> {
        if self.steps.is_empty() {
            return Err("there are no steps".to_owned());
        }
        let features = self.feature_count();
        if features == 0 {
            return Err("there are no features".to_owned());
        }
        within("a face", self.topology.iter().flatten(), features)?;
        let modes = match &self.drawn {
            DrawnSurface::Features => None,
            DrawnSurface::Mesh {
                rest_cm,
                faces,
                modes,
            } => {
                within("a drawn face", faces.iter().flatten(), rest_cm.len())?;
                for mode in modes {
                    same("vertices of a mode", mode.len(), rest_cm.len())?;
                }
                Some(modes.len())
            }
        };
        for (i, step) in self.steps.iter().enumerate() {
            self.check_step(step, features, modes, i == 0)
                .map_err(|reason| format!("step {}: {reason}", i + 1))?;
        }
        Ok(())
    }

    fn check_step(
        &self,
        step: &HistoryStep,
        features: usize,
        modes: Option<usize>,
        is_first: bool,
    ) -> Result<(), String> {
        same("features", step.features.len(), features)?;
        let estimated = step.estimated_features.len();
        same("estimated features", estimated, features)?;
        same("covariances", step.feature_covariances.len(), features)?;
        within("a visible feature", &step.visible, features)?;
        if step.metrics.covered > features {
            return Err(format!(
                "{} features are covered, and there are {features}",
                step.metrics.covered
            ));
        }
        if let Some(modes) = modes {
            same("amounts", step.object.amounts.len(), modes)?;
        }
        if step.decision.is_some() == is_first {
            return Err("every step but the first has a decision".to_owned());
        }
        if let Some(decision) = &step.decision {
            same("traces", decision.traces.len(), decision.scored.len())?;
            let greatest = decision.scored.greatest();
            within("a scored action", &greatest, self.actions.len())?;
            within("the action", &decision.action, self.actions.len())?;
            within("the goal", &decision.goal, self.viewpoints_cm.len())?;
        }
        Ok(())
    }
}

fn same(what: &str, found: usize, expected: usize) -> Result<(), String> {
    if found == expected {
        Ok(())
    } else {
        Err(format!("{found} {what}, expected {expected}"))
    }
}

fn within<'a>(
    what: &str,
    numbers: impl IntoIterator<Item = &'a usize>,
    count: usize,
) -> Result<(), String> {
    match numbers.into_iter().find(|number| **number >= count) {
        None => Ok(()),
        Some(number) => Err(format!("{what} has number {number}, beyond {count}")),
    }
}
