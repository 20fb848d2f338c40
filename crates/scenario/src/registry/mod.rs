//! What a program has to choose from, by name: planners and estimators, ours and those of its own.

mod planner;
mod standard;
mod viewpoints;

use std::fmt;
use std::sync::Arc;

use adslam_agent::{EstimatorEntry, EstimatorNameTaken, Estimators};
use adslam_diagnostics::InputError;
use adslam_documents::{Document, unknown_choice};
use adslam_names::{EstimatorName, Look, PlannerName, UnknownName};
use serde_json::{Map, Value, json};
use thiserror::Error;

pub use planner::{PlannerContext, PlannerEntry};

/// The planners and estimators that files, commands and results know. To copy it is cheap.
#[derive(Clone)]
pub struct Registry {
    planners: Arc<Vec<PlannerEntry>>,
    estimators: Estimators,
}

/// Two things were to have the same name.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is a planner called {0} already; give yours another name")]
pub struct NameTaken(PlannerName);

impl Registry {
    /// The paper's planners.
    #[must_use]
    pub fn standard() -> Self {
        Self {
            planners: Arc::new(standard::planners()),
            estimators: Estimators::standard(),
        }
    }

    /// With one more planner.
    ///
    /// # Errors
    /// Where another has its name.
    pub fn with_planner(mut self, entry: PlannerEntry) -> Result<Self, NameTaken> {
        if self.planners.iter().any(|known| known.name == entry.name) {
            return Err(NameTaken(entry.name));
        }
        Arc::make_mut(&mut self.planners).push(entry);
        Ok(self)
    }

    /// With one more estimator.
    ///
    /// # Errors
    /// Where another has its name.
    pub fn with_estimator(self, entry: EstimatorEntry) -> Result<Self, EstimatorNameTaken> {
        Ok(Self {
            estimators: self.estimators.with(entry)?,
            ..self
        })
    }

    /// The estimators.
    #[must_use]
    pub fn estimators(&self) -> &Estimators {
        &self.estimators
    }

    /// All planners, the paper's first.
    #[must_use]
    pub fn planners(&self) -> &[PlannerEntry] {
        &self.planners
    }

    /// The planner of that name.
    ///
    /// # Errors
    /// Where there is none, with the names that there are.
    pub fn planner(&self, name: PlannerName) -> Result<&PlannerEntry, UnknownName> {
        self.planner_named(name.as_str())
    }

    /// The planner whose name is `text`.
    ///
    /// # Errors
    /// As [`Registry::planner`].
    pub fn planner_named(&self, text: &str) -> Result<&PlannerEntry, UnknownName> {
        let mut planners = self.planners.iter();
        let found = planners.find(|entry| entry.name.as_str() == text);
        found.ok_or_else(|| {
            let known = self.planners.iter().map(|entry| entry.name.to_string());
            UnknownName::new("planner", text, known.collect())
        })
    }

    /// What a planner looks like in results; none for the paper's, whose look everyone knows.
    #[must_use]
    pub fn look(&self, name: PlannerName) -> Option<Look> {
        let look = self.planner(name).ok()?.look.clone();
        (look != Look::of_planner(name)).then_some(look)
    }

    /// Refuses the planner `name` if there is none of that name; `at` is an error where it stands.
    pub(crate) fn check(
        &self,
        name: PlannerName,
        at: impl FnOnce() -> InputError,
    ) -> Result<(), InputError> {
        let known = self.planners.iter().map(|entry| entry.name.as_str());
        refuse_unknown(name.as_str(), known, at)
    }

    /// Refuses the estimator `name` if there is none of that name; `at` is an error where it stands.
    pub(crate) fn check_estimator(
        &self,
        name: EstimatorName,
        at: impl FnOnce() -> InputError,
    ) -> Result<(), InputError> {
        let known = self.estimators.all().iter();
        refuse_unknown(name.as_str(), known.map(|entry| entry.name.as_str()), at)
    }

    /// The paths of the tables that planners have for keys of their own.
    pub(crate) fn own_tables(&self) -> Vec<String> {
        let own = self.planners.iter().filter(|entry| entry.keys.is_some());
        own.map(PlannerEntry::table).collect()
    }

    /// The keys of every planner that has some of its own, as the document gives them or else their defaults.
    pub(crate) fn own_keys(
        &self,
        document: &Document,
    ) -> Result<Vec<(PlannerName, Value)>, InputError> {
        let mut all = Vec::new();
        for entry in self.planners.iter() {
            if let Some(keys) = &entry.keys {
                all.push((entry.name, (keys.read)(document, &entry.table())?));
            }
        }
        Ok(all)
    }

    /// Completes the schema of a kind of file by what only the registry knows.
    pub(crate) fn complete(&self, schema: &mut Value) {
        let Some(definitions) = schema["definitions"].as_object_mut() else {
            return;
        };
        if let Some(name) = definitions.get_mut("PlannerName") {
            let planners = self.planners.iter();
            *name = schema_of_names(
                "The planners, in the order of the paper's tables.",
                planners.map(|entry| (entry.name.as_str(), entry.meaning.as_str())),
            );
        }
        if let Some(name) = definitions.get_mut("EstimatorName") {
            let estimators = self.estimators.all().iter();
            *name = schema_of_names(
                "The estimators. They differ in what they take for the error of a state.",
                estimators.map(|entry| (entry.name.as_str(), entry.meaning.as_str())),
            );
        }
        for entry in self.planners.iter() {
            let Some(keys) = &entry.keys else { continue };
            let mut own = (keys.schema)();
            if let Some(own) = own.as_object_mut() {
                own.remove("$schema");
                own.remove("title");
                if let Some(Value::Object(further)) = own.remove("definitions") {
                    definitions.extend(further);
                }
            }
            let planners = definitions.get_mut("Planners");
            if let Some(planners) = planners.and_then(|table| table["properties"].as_object_mut()) {
                planners.insert(entry.name.to_string(), own);
            }
        }
    }
}

/// Refuses a name that is not `known`; `at` is an error where it stands.
fn refuse_unknown<'a>(
    name: &str,
    known: impl Iterator<Item = &'a str>,
    at: impl FnOnce() -> InputError,
) -> Result<(), InputError> {
    let known: Vec<&str> = known.collect();
    if known.contains(&name) {
        return Ok(());
    }
    Err(unknown_choice(at(), name, &known))
}

/// The schema of a name that is one of these, each with what it means.
fn schema_of_names<'a>(description: &str, all: impl Iterator<Item = (&'a str, &'a str)>) -> Value {
    let (names, meanings): (Vec<&str>, Vec<&str>) = all.unzip();
    let mut schema = Map::new();
    let mut insert = |key: &str, value: Value| schema.insert(key.to_owned(), value);
    insert("description", json!(description));
    insert("type", json!("string"));
    insert("enum", json!(names));
    // Taplo's own key for what each word means.
    insert("x-taplo", json!({ "docs": { "enumValues": meanings } }));
    Value::Object(schema)
}

impl Default for Registry {
    fn default() -> Self {
        Self::standard()
    }
}

/// By the names of what there is: whether two programs do the same under them nobody can tell.
impl PartialEq for Registry {
    fn eq(&self, other: &Self) -> bool {
        let planners = |registry: &Self| -> Vec<PlannerName> {
            registry.planners.iter().map(|entry| entry.name).collect()
        };
        let estimators = |registry: &Self| -> Vec<EstimatorName> {
            let all = registry.estimators.all().iter();
            all.map(|entry| entry.name).collect()
        };
        planners(self) == planners(other) && estimators(self) == estimators(other)
    }
}

impl fmt::Debug for Registry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self.planners.iter().map(|entry| entry.name);
        f.debug_list().entries(names).finish()
    }
}
