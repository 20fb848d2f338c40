//! What of a configuration is run.

use std::path::{Path, PathBuf};

use adslam_diagnostics::InputError;
use adslam_names::nearest;

use super::{Config, ExperimentPlan, MOST_RUNS, MOST_RUNS_IN_ALL};
use crate::Object;

/// What of a configuration is run, and how often.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// Runs of each planner; the configuration's number where absent.
    pub runs: Option<usize>,
    /// Only the experiments with these labels; all where empty.
    pub only: Vec<String>,
    /// An STL, OBJ or PLY file for the object of every experiment whose object is a mesh or a phantom.
    pub mesh: Option<PathBuf>,
}

/// `runs`, if it is a number of runs that can be done; `path` is the file that is run, for messages.
pub fn checked_runs(path: &Path, runs: usize) -> Result<usize, InputError> {
    if (1..=MOST_RUNS).contains(&runs) {
        return Ok(runs);
    }
    let message = format!("there are {runs} runs of each planner to do");
    Err(InputError::about_file(path, message)
        .with_help(format!("ask for 1 to {MOST_RUNS} with --runs")))
}

impl Config {
    /// Keeps what is selected.
    ///
    /// # Errors
    /// An unknown label, no runs to do, or too many.
    pub fn select(self, selection: &Selection) -> Result<Self, InputError> {
        self.select_times(selection, 1)
    }

    /// The same where every run is done `times` times, in different ways.
    pub fn select_times(mut self, selection: &Selection, times: usize) -> Result<Self, InputError> {
        self.runs = checked_runs(&self.path, selection.runs.unwrap_or(self.runs))?;
        let labels = self.experiments.iter().map(|plan| plan.label.as_str());
        let labels: Vec<&str> = labels.collect();
        let known = |wish: &&String| labels.contains(&wish.as_str());
        if let Some(unknown) = selection.only.iter().find(|wish| !known(wish)) {
            let path = self.path.display();
            let message = format!("{path} has no experiment called {unknown:?}");
            let known = labels.join(", ");
            let help = match nearest(unknown, labels) {
                Some(near) => format!("did you mean {near}? There are {known}"),
                None => format!("there are {known}"),
            };
            return Err(InputError::about_file(&self.path, message).with_help(help));
        }
        let wanted = |plan: &ExperimentPlan| {
            selection.only.is_empty() || selection.only.contains(&plan.label)
        };
        self.experiments.retain(wanted);
        let planners = self.experiments.iter().map(|plan| plan.planners.len());
        let in_all = planners.sum::<usize>() * self.runs * times;
        if in_all > MOST_RUNS_IN_ALL {
            let message = format!("there are {in_all} runs to do in all");
            return Err(
                InputError::about_file(&self.path, message).with_help(format!(
                    "ask for fewer of each planner, or for fewer experiments with --only: at most \
                     {MOST_RUNS_IN_ALL} runs"
                )),
            );
        }
        if let Some(file) = &selection.mesh {
            for plan in &mut self.experiments {
                if let Object::Mesh(_) | Object::Phantom(_) = plan.scenario.object {
                    plan.scenario = plan.scenario.clone().with_mesh(file);
                }
            }
        }
        Ok(self)
    }
}
