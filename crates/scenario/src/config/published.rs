//! The published tables, to print beside our own numbers.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use adslam_diagnostics::InputError;
use adslam_documents::Document;
use adslam_names::PlannerName;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};

use crate::FileKind;
use crate::registry::Registry;
use crate::values::{Count, List, Name, NonNegative};

/// Published results, to print beside our own. Unknown keys are errors.
#[derive(Debug, Clone, PartialEq, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// Where they were published.
    pub title: String,
    /// The results in each scenario, `[tables.NAME]`; an experiment names one.
    pub tables: BTreeMap<Name, PublishedScenario>,
}

/// What was published about one scenario.
#[derive(Debug, Clone, PartialEq, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PublishedScenario {
    /// Number of the table with the coverage, such as `"I"`.
    pub coverage_table: Name,
    /// Number of the table with the errors, such as `"II"`.
    pub error_table: Name,
    /// The results of each planner, `[tables.NAME.planners.PLANNER]`.
    pub planners: BTreeMap<PlannerName, PublishedPlanner>,
}

/// The results of one planner.
#[derive(Debug, Clone, PartialEq, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PublishedPlanner {
    /// Observed feature times of each run.
    pub observed: List<Count<0, 1_000_000_000>>,
    /// Step by which every feature had been seen, of each run; `"-"`: never.
    pub steps: List<StepsToCover>,
    /// Largest pose error, eq. (11), which mixes radians and cm.
    pub pose_error_max: NonNegative,
    /// Mean pose error, eq. (11).
    pub pose_error_mean: NonNegative,
    /// Largest feature error at the last step, eq. (12) (cm).
    pub feature_error_max_cm: NonNegative,
    /// Mean feature error at the last step, eq. (12) (cm).
    pub feature_error_mean_cm: NonNegative,
}

/// The step at which all features have been seen: a number, or "-" where that never happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StepsToCover(pub Option<usize>);

impl<'de> Deserialize<'de> for StepsToCover {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct StepOrDash;

        // The step is checked in here, where an error still gets its place.
        impl Visitor<'_> for StepOrDash {
            type Value = StepsToCover;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a step from 1, or \"-\" for never")
            }

            fn visit_i64<E: Error>(self, step: i64) -> Result<StepsToCover, E> {
                match usize::try_from(step) {
                    Ok(step) if step > 0 => Ok(StepsToCover(Some(step))),
                    _ => Err(E::invalid_value(Unexpected::Signed(step), &self)),
                }
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<StepsToCover, E> {
                match text {
                    "-" => Ok(StepsToCover(None)),
                    other => Err(E::invalid_value(Unexpected::Str(other), &self)),
                }
            }
        }

        deserializer.deserialize_any(StepOrDash)
    }
}

impl JsonSchema for StepsToCover {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "StepsToCover".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "integer", "minimum": 1 }, { "const": "-" }] })
    }
}

impl Published {
    /// Reads and checks the file of published results at `path`.
    ///
    /// # Errors
    /// When it cannot be read or holds anything else; the error points at the place.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        Self::load_with(path, &Registry::standard())
    }

    /// The same for a program with planners of its own.
    ///
    /// # Errors
    /// As [`Published::load`].
    pub fn load_with(path: &Path, registry: &Registry) -> Result<Self, InputError> {
        let document = Document::read(path)?;
        FileKind::Published.expect(&document)?;
        Self::from_document(&document, registry)
    }

    /// Reads and checks published results from `text`, as if it were the content of the file at
    /// `path`.
    ///
    /// # Errors
    /// As [`Published::load`].
    pub fn parse(text: &str, path: &Path) -> Result<Self, InputError> {
        Self::from_document(&Document::parse(text, path)?, &Registry::standard())
    }

    fn from_document(document: &Document, registry: &Registry) -> Result<Self, InputError> {
        let published: Self = document.deserialize()?;
        for (scenario, tables) in &published.tables {
            for (planner, column) in &tables.planners {
                let key = format!("tables.{scenario}.planners.{planner}");
                registry.check(*planner, || document.error_at_key(&key, ""))?;
                let (observed, steps) = (column.observed.len(), column.steps.len());
                if observed != steps {
                    // Names may hold dots, which a path cannot; the table is near enough then.
                    let key = format!("tables.{scenario}.planners.{planner}.steps");
                    return Err(document
                        .error_at(&key, format!("{observed} runs in `observed`, {steps} here"))
                        .with_help("give one number for each run in both"));
                }
            }
        }
        Ok(published)
    }
}
