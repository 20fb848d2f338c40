//! A planner as a registry knows it.

use std::sync::Arc;

use adslam_diagnostics::InputError;
use adslam_documents::{Document, root_schema};
use adslam_estimator::Belief;
use adslam_names::{Look, PlannerName};
use adslam_planning::{Goals, Planner, PlanningError, PlanningModel};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::viewpoints;
use crate::Scenario;

type Build =
    dyn Fn(&mut PlannerContext<'_>) -> Result<Box<dyn Planner>, PlanningError> + Send + Sync;

/// A planner: its name, how it is shown, the keys that it has in scenarios, and how it is built.
#[derive(Clone)]
pub struct PlannerEntry {
    /// What it is called in files and on the command line.
    pub name: PlannerName,
    /// What it looks like in results.
    pub look: Look,
    /// What it does, in a sentence: editors show it.
    pub meaning: String,
    pub(super) keys: Option<Keys>,
    build: Arc<Build>,
}

/// Keys of a planner's own.
#[derive(Clone, Copy)]
pub(super) struct Keys {
    pub(super) read: fn(&Document, &str) -> Result<Value, InputError>,
    pub(super) schema: fn() -> Value,
}

/// What a planner is built from, at the start of a run.
pub struct PlannerContext<'a> {
    /// The scenario, for its keys.
    pub scenario: &'a Scenario,
    /// What planners know of robot, sensor and object.
    pub model: &'a PlanningModel,
    /// What is believed at the start.
    pub belief: &'a Belief,
    /// Draws the next number from 0 to 1, from the run's own stream for planners: a planner has no random numbers but
    /// these.
    pub draw: &'a mut dyn FnMut() -> f64,
    /// What the user should know of the run.
    pub warnings: &'a mut Vec<String>,
}

impl PlannerContext<'_> {
    /// The viewpoints to visit: those of the scenario, or a path drawn by Algorithm 2. At the same seed all planners
    /// draw the same path, if they draw nothing before.
    ///
    /// # Errors
    /// No viewpoint outside the object, or a first estimate that makes no surface.
    pub fn goals(&mut self) -> Result<Goals, PlanningError> {
        viewpoints::goals(self)
    }
}

impl PlannerEntry {
    /// A planner without keys of its own, shown by its name.
    #[must_use]
    pub fn new(
        name: PlannerName,
        build: impl Fn(&mut PlannerContext<'_>) -> Result<Box<dyn Planner>, PlanningError>
        + Send
        + Sync
        + 'static,
    ) -> Self {
        Self {
            name,
            look: Look::of_planner(name),
            meaning: String::new(),
            keys: None,
            build: Arc::new(build),
        }
    }

    /// A planner with the keys of a `K` in `[planners.NAME]`, whose comments are their documentation; what a scenario
    /// leaves out is as in `K::default()`. If one of them is `deadline_ms`, it is the time that the planner has for a
    /// decision.
    #[must_use]
    pub fn with_keys<K>(
        name: PlannerName,
        build: impl Fn(K, &mut PlannerContext<'_>) -> Result<Box<dyn Planner>, PlanningError>
        + Send
        + Sync
        + 'static,
    ) -> Self
    where
        K: Default + Serialize + DeserializeOwned + JsonSchema,
    {
        let entry = Self::new(name, move |context| {
            let keys = match context.scenario.planners.own.get(&name) {
                Some(keys) => K::deserialize(keys).map_err(|error| Box::new(error) as Box<_>)?,
                None => K::default(),
            };
            build(keys, context)
        });
        let keys = Keys {
            read: |document, table| {
                let keys: K = document.deserialize_at(table)?.unwrap_or_default();
                serde_json::to_value(keys).map_err(|error| {
                    let message =
                        format!("the keys of the planner cannot be written down: {error}");
                    document.error_at(table, message)
                })
            },
            schema: root_schema::<K>,
        };
        Self {
            keys: Some(keys),
            ..entry
        }
    }

    /// Shown under a label and in a colour (red, green, blue) of its own.
    #[must_use]
    pub fn shown_as(self, label: &str, colour: [u8; 3]) -> Self {
        Self {
            look: Look::new(label, colour),
            ..self
        }
    }

    /// With a sentence that says what it does.
    #[must_use]
    pub fn described_as(self, meaning: &str) -> Self {
        Self {
            meaning: meaning.to_owned(),
            ..self
        }
    }

    /// The planner, ready to decide.
    ///
    /// # Errors
    /// What it cannot be built from.
    pub fn build(
        &self,
        context: &mut PlannerContext<'_>,
    ) -> Result<Box<dyn Planner>, PlanningError> {
        (self.build)(context)
    }

    /// The path of the table with its keys.
    pub(super) fn table(&self) -> String {
        format!("planners.{}", self.name)
    }
}
