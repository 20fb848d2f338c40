//! From an entry of `[[experiments]]` to what is run.

use std::path::{Path, PathBuf};

use adslam_diagnostics::InputError;
use adslam_documents::{Document, Layer};
use adslam_names::{PlannerName, nearest};

use super::{Experiment, Published, PublishedScenario};
use crate::Scenario;
use crate::registry::Registry;
use crate::values::Name;

/// One experiment: a scenario, overrides applied, and the planners that run in it.
#[derive(Debug, Clone, PartialEq)]
pub struct ExperimentPlan {
    /// What it is called in tables and file names; no two of a configuration share it.
    pub label: String,
    /// The scenario with the overrides applied.
    pub scenario: Scenario,
    /// The planners, each once, in the order of the file.
    pub planners: Vec<PlannerName>,
    /// The published values to print beside.
    pub published: Option<PublishedScenario>,
}

/// An experiment's place in its configuration.
pub(super) struct Place<'a> {
    pub(super) document: &'a Document,
    pub(super) folder: &'a Path,
    pub(super) index: usize,
    pub(super) registry: &'a Registry,
}

impl Place<'_> {
    fn key(&self, name: &str) -> String {
        format!("experiments[{}].{name}", self.index)
    }

    pub(super) fn plan(
        &self,
        experiment: &Experiment,
        published: Option<&Published>,
    ) -> Result<ExperimentPlan, InputError> {
        let path = self.folder.join(&experiment.scenario);
        let path = reachable(self.document, &self.key("scenario"), path)?;
        let set = Layer::of_values(self.key("set"));
        let scenario =
            Scenario::load_with(&path, self.registry)?.overridden(self.document, vec![set])?;
        each_once(
            self.document,
            &self.key("planners"),
            &experiment.planners,
            self.registry,
        )?;
        let published = match &experiment.published {
            None => None,
            Some(name) => Some(self.published(name, published)?),
        };
        let label = experiment
            .label
            .as_ref()
            .unwrap_or(&scenario.name)
            .to_string();
        Ok(ExperimentPlan {
            label,
            scenario,
            planners: experiment.planners.to_vec(),
            published,
        })
    }

    fn published(
        &self,
        name: &Name,
        published: Option<&Published>,
    ) -> Result<PublishedScenario, InputError> {
        let at = |message: String| self.document.error_at(&self.key("published"), message);
        let Some(published) = published else {
            return Err(
                at("there are no published tables to take this from".to_owned())
                    .with_help("add `published = \"published.toml\"` above the experiments"),
            );
        };
        published.tables.get(name).cloned().ok_or_else(|| {
            let known: Vec<&str> = published.tables.keys().map(|known| &**known).collect();
            let help = match nearest(name, known.iter().copied()) {
                Some(near) => format!("did you mean {near:?}?"),
                None => format!("there are {}", known.join(", ")),
            };
            at(format!("the published tables have no {:?}", &**name)).with_help(help)
        })
    }

    pub(super) fn label_taken(
        &self,
        experiment: &Experiment,
        label: &str,
        other: usize,
    ) -> InputError {
        let key = if experiment.label.is_some() {
            "label"
        } else {
            "scenario"
        };
        self.document
            .error_at(
                &self.key(key),
                format!(
                    "experiments {} and {} are both called {label:?}",
                    other + 1,
                    self.index + 1
                ),
            )
            .with_label("the second of them")
            .with_help(format!(
                "give this one another name, such as `label = \"{label}-2\"`"
            ))
    }
}

/// Refuses a list of planners, at `key`, with one of them twice, or one that there is not.
pub(crate) fn each_once(
    document: &Document,
    key: &str,
    planners: &[PlannerName],
    registry: &Registry,
) -> Result<(), InputError> {
    for (second, planner) in planners.iter().enumerate() {
        let place = format!("{key}[{second}]");
        registry.check(*planner, || document.error_at(&place, ""))?;
        if planners[..second].contains(planner) {
            return Err(document
                .error_at(&place, format!("the planner {planner} is listed twice"))
                .with_help("name each planner once; for more runs raise `runs`"));
        }
    }
    Ok(())
}

/// The path, if there is a file: the fault of a wrong path lies in the configuration, at `key`.
pub fn reachable(document: &Document, key: &str, path: PathBuf) -> Result<PathBuf, InputError> {
    if path.is_file() {
        return Ok(path);
    }
    let problem = if path.exists() {
        "is not a file"
    } else {
        "does not exist"
    };
    Err(document
        .error_at(key, format!("{} {problem}", path.display()))
        .with_help(format!(
            "paths count from the folder of {}",
            document.path().display()
        )))
}
