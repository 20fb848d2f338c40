//! tables.json: every run, for machines.

use std::collections::BTreeMap;

use serde::Serialize;

use super::Tables;
use crate::ExperimentError;
use crate::config::PublishedScenario;
use crate::metrics::RunSummary;
use crate::output::AtomicFile;
use crate::scenario::Named;

#[derive(Serialize)]
struct TablesJson<'a> {
    title: &'a str,
    runs: usize,
    /// Fewer runs may have finished than were asked for.
    complete: bool,
    /// What the user should know of the runs.
    warnings: &'a [String],
    scenarios: BTreeMap<&'a str, ScenarioJson<'a>>,
    published: BTreeMap<&'a str, PublishedJson>,
}

#[derive(Serialize)]
struct ScenarioJson<'a> {
    planners: BTreeMap<&'static str, &'a [RunSummary]>,
}

#[derive(Serialize)]
struct PublishedJson {
    coverage_table: String,
    error_table: String,
    planners: BTreeMap<&'static str, PublishedPlannerJson>,
}

#[derive(Serialize)]
struct PublishedPlannerJson {
    observed: Vec<usize>,
    steps_to_full_coverage: Vec<Option<usize>>,
    pose_error_mean: f64,
    pose_error_max: f64,
    feature_error_mean: f64,
    feature_error_max: f64,
}

/// Writes all runs, and the published values.
///
/// # Errors
/// [`ExperimentError::Output`].
pub fn write_json(tables: &Tables, file: &mut AtomicFile) -> Result<(), ExperimentError> {
    let scenarios = tables.experiments.iter().map(|experiment| {
        let planners = experiment.planners.iter();
        let planners = planners
            .map(|p| (p.planner.as_str(), p.runs.as_slice()))
            .collect();
        (experiment.label.as_str(), ScenarioJson { planners })
    });
    let published = tables.experiments.iter().filter_map(|experiment| {
        Some((
            experiment.label.as_str(),
            published_json(experiment.published.as_ref()?),
        ))
    });
    let json = TablesJson {
        title: &tables.title,
        runs: tables.runs,
        complete: tables.is_complete(),
        warnings: &tables.warnings,
        scenarios: scenarios.collect(),
        published: published.collect(),
    };
    file.add_json(&json)
}

fn published_json(published: &PublishedScenario) -> PublishedJson {
    let planners = published.planners.iter().map(|(name, column)| {
        let json = PublishedPlannerJson {
            observed: column.observed.iter().map(|count| count.get()).collect(),
            steps_to_full_coverage: column.steps.iter().map(|steps| steps.0).collect(),
            pose_error_mean: *column.pose_error_mean,
            pose_error_max: *column.pose_error_max,
            feature_error_mean: *column.feature_error_mean_cm,
            feature_error_max: *column.feature_error_max_cm,
        };
        (name.as_str(), json)
    });
    PublishedJson {
        coverage_table: published.coverage_table.to_string(),
        error_table: published.error_table.to_string(),
        planners: planners.collect(),
    }
}
