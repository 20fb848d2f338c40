//! From an entry of `[[experiments]]` to what is run.

use std::path::{Path, PathBuf};

use super::{Experiment, MOST_OVERRIDES, Published, PublishedScenario};
use crate::diagnostics::{Document, InputError, nearest};
use crate::scenario::values::Name;
use crate::scenario::{PlannerName, Scenario};

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
        let scenario = self.overridden(experiment, Scenario::load(&path)?)?;
        for (second, planner) in experiment.planners.iter().enumerate() {
            if experiment.planners[..second].contains(planner) {
                let place = self.key(&format!("planners[{second}]"));
                return Err(self
                    .document
                    .error_at(&place, format!("the planner {planner} is listed twice"))
                    .with_help("name each planner once; for more runs raise `runs`"));
            }
        }
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

    /// The scenario with the overrides of this experiment.
    fn overridden(
        &self,
        experiment: &Experiment,
        scenario: Scenario,
    ) -> Result<Scenario, InputError> {
        let set = self.key("set");
        let count = experiment.set.len();
        if count == 0 {
            return Ok(scenario);
        }
        if count > MOST_OVERRIDES {
            return Err(self
                .document
                .error_at(&set, format!("there are {count} overrides"))
                .with_help(format!(
                    "write at most {MOST_OVERRIDES}, and the rest into a scenario of its own"
                )));
        }
        let overrides = self.document.keys(&set);
        let merged = scenario.document().with_overrides(self.document, &set);
        let error = match Scenario::from_document(merged.clone()) {
            Err(error) if merged.is_in_base(&error) => error,
            result => return result,
        };
        // The scenario is valid by itself, so an override is to blame where it points: the one
        // without which all would be well.
        let guilty = overrides
            .iter()
            .find(|key| Scenario::from_document(merged.without_override(key)).is_ok());
        let message = format!("with this override, {}", error.message());
        let blamed = match guilty {
            Some(key) => merged.error_at_override(key, message),
            None => self.document.error_at(&set, message),
        };
        let key = error
            .pointed_at()
            .filter(|text| !text.contains('\n'))
            .unwrap_or_default();
        let label = format!("does not go with `{key}` in {}", error.path().display());
        let blamed = if key.is_empty() {
            blamed
        } else {
            blamed.with_label(label)
        };
        Err(match error.remedy() {
            Some(remedy) => blamed.with_help(remedy),
            None => blamed,
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

/// The path, if there is a file: the fault of a wrong path lies in the configuration, at `key`.
pub(super) fn reachable(
    document: &Document,
    key: &str,
    path: PathBuf,
) -> Result<PathBuf, InputError> {
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
