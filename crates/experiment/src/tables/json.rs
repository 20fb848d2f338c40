//! tables.json: every run, for machines.

use std::collections::BTreeMap;
use std::path::Path;

use adslam_diagnostics::Failure;
use adslam_names::PlannerName;
use adslam_scenario::config::PublishedScenario;
use adslam_simulation::RunSummary;
use serde::Serialize;

use super::{Agreement, ExperimentTables, Tables};
use crate::provenance::BuildRuns;

#[derive(Serialize)]
struct TablesJson<'a> {
    title: &'a str,
    runs: usize,
    first_seed: u64,
    /// Fewer runs may have finished than were asked for.
    complete: bool,
    /// What the user should know of the runs.
    warnings: &'a [String],
    builds: &'a [BuildRuns],
    scenarios: BTreeMap<&'a str, ScenarioJson<'a>>,
    published: BTreeMap<&'a str, PublishedJson>,
    comparisons: Vec<ComparisonJson<'a>>,
}

/// A published value against ours; steps that never come are null.
#[derive(Serialize)]
struct ComparisonJson<'a> {
    scenario: &'a str,
    table: String,
    row: String,
    planner: PlannerName,
    published: f64,
    /// What is expected of as many runs of ours as were published.
    ours: f64,
    /// Where as many runs of ours would lie in 95 % of cases.
    low: Option<f64>,
    high: Option<f64>,
    ratio: Option<f64>,
    agreement: Option<&'static str>,
}

#[derive(Serialize)]
struct ScenarioJson<'a> {
    planners: BTreeMap<String, &'a [RunSummary]>,
}

#[derive(Serialize)]
struct PublishedJson {
    coverage_table: String,
    error_table: String,
    planners: BTreeMap<String, PublishedPlannerJson>,
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

/// All runs, the published values, and how they compare, as JSON.
///
/// # Errors
/// [`Failure::Output`] of a number that JSON cannot hold.
pub fn json(tables: &Tables) -> Result<String, Failure> {
    let scenarios = tables.experiments.iter().map(|experiment| {
        let planners = experiment.planners.iter();
        let planners = planners
            .map(|p| (p.planner.to_string(), p.runs.as_slice()))
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
        first_seed: tables.first_seed,
        complete: tables.is_complete(),
        warnings: &tables.warnings,
        builds: &tables.builds,
        scenarios: scenarios.collect(),
        published: published.collect(),
        comparisons: tables.experiments.iter().flat_map(comparisons).collect(),
    };
    let text = serde_json::to_string_pretty(&json);
    let text = text.map_err(Failure::output(Path::new("tables.json")))?;
    Ok(text + "\n")
}

fn comparisons(experiment: &ExperimentTables) -> Vec<ComparisonJson<'_>> {
    let mut all = Vec::new();
    for table in experiment.paper_tables() {
        for row in &table.rows {
            for (planner, cell) in table.planners.iter().zip(&row.cells) {
                let Some(compared) = cell.comparison else {
                    continue;
                };
                all.push(ComparisonJson {
                    scenario: &experiment.label,
                    table: table.title.clone(),
                    row: row.name.clone(),
                    planner: *planner,
                    published: compared.published,
                    ours: compared.ours,
                    low: compared.interval.map(|interval| interval.low),
                    high: compared.interval.map(|interval| interval.high),
                    ratio: compared.ratio,
                    agreement: compared.agreement.map(Agreement::as_str),
                });
            }
        }
    }
    all
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
        (name.to_string(), json)
    });
    PublishedJson {
        coverage_table: published.coverage_table.to_string(),
        error_table: published.error_table.to_string(),
        planners: planners.collect(),
    }
}
