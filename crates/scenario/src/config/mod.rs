//! Configuration files: what is run. Scenarios with overrides, planners, seeds, and the published
//! tables to compare with.

mod plan;
mod published;
mod selection;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use adslam_diagnostics::InputError;
use adslam_documents::Document;
use adslam_names::PlannerName;
use schemars::JsonSchema;
use serde::Deserialize;

pub use plan::ExperimentPlan;
pub(crate) use plan::{each_once, reachable};
pub use published::{Published, PublishedPlanner, PublishedScenario, StepsToCover};
pub use selection::{Selection, checked_runs};

use crate::FileKind;
use crate::registry::Registry;
use crate::values::{Count, List, Name, Seed};

/// More runs of a planner are a mistake: their summaries would not fit into memory.
pub const MOST_RUNS: usize = 100_000;
/// More runs in all, of every planner in every experiment or at every point of a sweep, would take months.
pub const MOST_RUNS_IN_ALL: usize = 1_000_000;
/// More experiments are a mistake: the scenario of each is read and built before the first run.
const MOST_EXPERIMENTS: usize = 1_000;
/// How many times each planner runs in each experiment.
pub type Runs = Count<1, { MOST_RUNS as u64 }>;

/// A configuration with everything it refers to read, overridden and checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// The file it came from.
    pub path: PathBuf,
    /// What the file says.
    pub text: String,
    /// What it shows, for the head of its tables.
    pub title: String,
    /// Runs of each planner in each experiment.
    pub runs: usize,
    /// The seed of the first run; the others count up from it.
    pub first_seed: u64,
    /// The experiments, in the order of the file.
    pub experiments: Vec<ExperimentPlan>,
}

/// What is run: scenarios, some of their keys overridden, planners, and how often. Unknown keys are
/// errors.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Configuration")]
pub struct ConfigFile {
    /// Head of the tables.
    title: String,
    /// Runs of each planner in each experiment.
    #[serde(default = "runs")]
    runs: Runs,
    /// Seed of the first run; the others count up from it. Every planner meets the same noise at the
    /// same seed.
    #[serde(default = "first_seed")]
    first_seed: Seed,
    /// The file of published results; its path counts from this file's folder. Default: none.
    #[schemars(extend("format" = "path"))]
    published: Option<PathBuf>,
    /// What is run: an `[[experiments]]` for each, at most 1000.
    experiments: List<Experiment>,
}

/// A scenario, some of its keys overridden, and the planners that run in it.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Experiment {
    /// What it is called in tables and file names; no two may share it. Default: the scenario's name.
    label: Option<Name>,
    /// The scenario; its path counts from this file's folder.
    #[schemars(extend("format" = "path"))]
    scenario: PathBuf,
    /// The planners that run, each once.
    planners: List<PlannerName>,
    /// The entry of the published results to print beside. Default: none.
    published: Option<Name>,
    /// Overrides of the scenario's keys: each key is a path into the scenario, in quotes; at most
    /// 1000. Default: none.
    // Only their being a table is looked at here: `Document` reads them in place.
    #[serde(default, rename = "set")]
    #[schemars(schema_with = "crate::schema::overrides")]
    _set: toml::Table,
}

impl Config {
    /// Reads and checks the configuration at `path` and all files it names, whose paths count from
    /// its folder.
    ///
    /// # Errors
    /// When one of the files cannot be read or holds anything but what belongs there. A scenario's
    /// own fault is shown in the scenario's file, that of an override in the configuration.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        Self::load_with(path, &Registry::standard())
    }

    /// The same for a program with planners of its own.
    ///
    /// # Errors
    /// As [`Config::load`].
    pub fn load_with(path: &Path, registry: &Registry) -> Result<Self, InputError> {
        let document = Document::read(path)?;
        FileKind::Configuration.expect(&document)?;
        Self::from_document(&document, registry)
    }

    /// Reads and checks a configuration from `text`, as if it were the content of the file at `path`.
    ///
    /// # Errors
    /// As [`Config::load`].
    pub fn parse(text: &str, path: &Path) -> Result<Self, InputError> {
        Self::from_document(&Document::parse(text, path)?, &Registry::standard())
    }

    fn from_document(document: &Document, registry: &Registry) -> Result<Self, InputError> {
        let file: ConfigFile = document.deserialize()?;
        let count = file.experiments.len();
        if count > MOST_EXPERIMENTS {
            return Err(document
                .error_at("experiments[0]", format!("there are {count} experiments"))
                .with_help(format!("write at most {MOST_EXPERIMENTS}")));
        }
        let folder = document.path().parent().unwrap_or(Path::new(""));
        let published = match &file.published {
            None => None,
            Some(path) => Some(
                plan::reachable(document, "published", folder.join(path))
                    .and_then(|path| Published::load_with(&path, registry))?,
            ),
        };
        let mut experiments: Vec<ExperimentPlan> = Vec::new();
        for (index, experiment) in file.experiments.iter().enumerate() {
            let place = plan::Place {
                document,
                folder,
                index,
                registry,
            };
            let plan = place.plan(experiment, published.as_ref())?;
            if let Some(other) = experiments
                .iter()
                .position(|other| other.label == plan.label)
            {
                return Err(place.label_taken(experiment, &plan.label, other));
            }
            experiments.push(plan);
        }
        Ok(Self {
            path: document.path().to_owned(),
            text: document.text().to_owned(),
            title: file.title,
            runs: file.runs.get(),
            first_seed: file.first_seed.as_u64(),
            experiments,
        })
    }
}

fn runs() -> Runs {
    Runs::default_of(5)
}

pub(crate) fn first_seed() -> Seed {
    Seed::default_of(1)
}
