//! From the records of a consistency study to its tables.

use std::path::{Path, PathBuf};

use adslam_diagnostics::Failure;
use adslam_names::{EstimatorName, Look, PlannerName};
use adslam_record::{AtomicFile, Column, ColumnKind, TableFile};
use adslam_simulation::RunSummary;
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};

use super::{ConsistencyPlan, ConsistencyRecord, Judgement, Measure, markdown};
use crate::provenance::BuildRuns;
use crate::run::warnings;

/// What a consistency study gave: made of its records alone.
#[derive(Clone, Debug, Serialize)]
pub struct ConsistencyResults {
    /// The configuration's title.
    pub title: String,
    /// Runs of each cell that were asked for.
    pub runs: usize,
    /// The seed of the first of them.
    pub first_seed: u64,
    /// Experiment by experiment, estimator by estimator, planner by planner.
    pub cells: Vec<ConsistencyCell>,
    /// What the user should know of the runs.
    pub warnings: Vec<String>,
    /// What made them.
    pub builds: Vec<BuildRuns>,
}

/// The runs of one experiment, estimator and planner.
#[derive(Clone, Debug, Serialize)]
pub struct ConsistencyCell {
    /// The experiment.
    pub label: String,
    /// The estimator.
    pub estimator: EstimatorName,
    /// The planner.
    pub planner: PlannerName,
    /// What it looks like, where its name does not say it.
    #[serde(skip)]
    pub look: Option<Look>,
    /// What the estimator looks like.
    #[serde(skip)]
    pub estimator_look: Look,
    /// Runs that were finished.
    pub runs: usize,
    /// Mean over runs and steps of eq. (11), radians and cm together; absent, as the others, without runs.
    pub pose_error: Option<f64>,
    /// The drift floor: what of that the noise alone must cost, cm.
    pub drift_floor: Option<f64>,
    /// The pose error relative to the object.
    pub relative_pose_error: Option<f64>,
    /// Feature measurements that the gate kept out, in all runs.
    pub rejected_measurements: usize,
    /// NEES of each feature, mean over steps and runs, over its 3 degrees of freedom; absent where its
    /// covariance was always singular.
    pub nees_of_features: Vec<Option<f64>>,
    /// What each measure says, of those that were taken.
    pub judgements: Vec<Judgement>,
}

impl ConsistencyCell {
    /// Of the runs that were finished.
    #[must_use]
    pub fn of(
        label: &str,
        estimator: EstimatorName,
        planner: PlannerName,
        runs: &[&ConsistencyRecord],
    ) -> Self {
        let summaries = runs.iter().filter_map(|record| record.summary.as_ref());
        let mean = |value: fn(&RunSummary) -> f64| {
            let sum: f64 = summaries.clone().map(value).sum();
            (!runs.is_empty()).then(|| sum / runs.len() as f64)
        };
        Self {
            label: label.to_owned(),
            estimator,
            planner,
            look: None,
            estimator_look: Look::of_estimator(estimator),
            runs: runs.len(),
            pose_error: mean(|run| run.pose_error_mean),
            drift_floor: mean(|run| run.drift_floor_mean),
            relative_pose_error: mean(|run| run.relative_pose_error_mean),
            rejected_measurements: summaries.clone().map(|run| run.rejected_measurements).sum(),
            nees_of_features: nees_of_features(runs),
            judgements: Measure::ALL
                .into_iter()
                .filter_map(|measure| Judgement::of(measure, runs))
                .collect(),
        }
    }

    /// How many features have a mean NEES outside the interval of one step.
    #[must_use]
    pub fn features_outside(&self) -> usize {
        let Some(judged) = self.judgement(Measure::FeatureNees) else {
            return 0;
        };
        let outside = |nees: &&f64| !judged.interval.contains(**nees);
        let each = self.nees_of_features.iter().flatten();
        each.filter(outside).count()
    }

    /// What one of the measures says.
    #[must_use]
    pub fn judgement(&self, measure: Measure) -> Option<&Judgement> {
        self.judgements.iter().find(|j| j.measure == measure)
    }
}

impl ConsistencyResults {
    /// Of the records of a plan's study, in its order, and what made them, as [`Study::builds`] says.
    ///
    /// [`Study::builds`]: crate::study::Study::builds
    #[must_use]
    pub fn new(
        plan: &ConsistencyPlan,
        records: &[Option<ConsistencyRecord>],
        builds: Vec<BuildRuns>,
    ) -> Self {
        let cells: Vec<_> = plan.cells().zip(records.chunks(plan.runs)).collect();
        let cells = cells.into_par_iter().map(|(cell, records)| {
            let done: Vec<&ConsistencyRecord> = records.iter().flatten().collect();
            let label = &cell.point.plan.label;
            let registry = cell.point.setup.scenario.registry();
            ConsistencyCell {
                look: registry.look(cell.planner),
                estimator_look: cell.point.setup.model.estimator.look.clone(),
                ..ConsistencyCell::of(label, cell.point.estimator, cell.planner, &done)
            }
        });
        Self {
            title: plan.title.clone(),
            runs: plan.runs,
            first_seed: plan.first_seed,
            cells: cells.collect(),
            builds,
            warnings: warnings::merged(
                records
                    .iter()
                    .flatten()
                    .map(|record| record.warnings.as_slice()),
            ),
        }
    }

    /// The labels of the experiments, each once, in order.
    #[must_use]
    pub fn labels(&self) -> Vec<&str> {
        let mut labels: Vec<&str> = self.cells.iter().map(|cell| cell.label.as_str()).collect();
        labels.dedup();
        labels
    }

    /// Writes into `folder` and returns the paths: consistency.md for people, consistency.json with all there
    /// is, verdicts, steps and features as CSV and JSON
    /// lines.
    ///
    /// # Errors
    /// [`Failure::Output`]; what was there is then unchanged.
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
        let text = markdown::markdown(self);
        let mut files = vec![AtomicFile::with_content(
            &folder.join("consistency.md"),
            text.as_bytes(),
        )?];
        let mut json = AtomicFile::create(&folder.join("consistency.json"))?;
        json.add_json(self)?;
        files.push(json);
        files.extend(self.write_verdicts(folder)?.finish()?);
        files.extend(self.write_steps(folder)?.finish()?);
        files.extend(self.write_features(folder)?.finish()?);
        let paths = files.iter().map(|file| file.path().to_owned()).collect();
        AtomicFile::commit_all(files)?;
        Ok(paths)
    }

    /// A row for each cell and measure.
    fn write_verdicts(&self, folder: &Path) -> Result<TableFile, Failure> {
        let numbers = [
            "mean_per_dof",
            "low_per_dof",
            "high_per_dof",
            "steps_inside",
        ];
        let mut columns = cell_columns();
        columns.extend(numbers.map(|name| Column::new(name, ColumnKind::Number)));
        columns.push(Column::new("verdict", ColumnKind::Text));
        let mut table = TableFile::create(folder, "verdicts", columns)?;
        for (cell, judgement) in self.judgements() {
            let mut row = cell_values(cell, judgement.measure);
            row.extend([
                json!(judgement.mean),
                json!(judgement.interval.low),
                json!(judgement.interval.high),
                json!(judgement.steps_inside),
                json!(judgement.verdict.to_string()),
            ]);
            table.add(row)?;
        }
        Ok(table)
    }

    /// A row for each cell, measure and step.
    fn write_steps(&self, folder: &Path) -> Result<TableFile, Failure> {
        let mut columns = cell_columns();
        columns.push(Column::new("step", ColumnKind::Integer));
        let numbers = ["mean_per_dof", "low_per_dof", "high_per_dof"];
        columns.extend(numbers.map(|name| Column::new(name, ColumnKind::Number)));
        let mut table = TableFile::create(folder, "steps", columns)?;
        for (cell, judgement) in self.judgements() {
            for step in &judgement.steps {
                let mut row = cell_values(cell, judgement.measure);
                row.extend([
                    json!(step.step),
                    json!(step.mean),
                    json!(step.interval.low),
                    json!(step.interval.high),
                ]);
                table.add(row)?;
            }
        }
        Ok(table)
    }

    /// A row for each cell and feature.
    fn write_features(&self, folder: &Path) -> Result<TableFile, Failure> {
        let mut columns = cell_columns();
        columns.push(Column::new("feature", ColumnKind::Integer));
        columns.push(Column::new("mean_per_dof", ColumnKind::Number));
        let mut table = TableFile::create(folder, "features", columns)?;
        for cell in &self.cells {
            for (feature, mean) in cell.nees_of_features.iter().enumerate() {
                let mut row = cell_values(cell, Measure::FeatureNees);
                row.extend([json!(feature), json!(mean)]);
                table.add(row)?;
            }
        }
        Ok(table)
    }

    fn judgements(&self) -> impl Iterator<Item = (&ConsistencyCell, &Judgement)> {
        self.cells
            .iter()
            .flat_map(|cell| cell.judgements.iter().map(move |j| (cell, j)))
    }
}

/// NEES of each feature over 3, mean over the steps of all runs.
fn nees_of_features(runs: &[&ConsistencyRecord]) -> Vec<Option<f64>> {
    let count = runs.iter().map(|run| run.nees_of_features.len()).max();
    (0..count.unwrap_or(0))
        .map(|feature| {
            let of = runs
                .iter()
                .filter_map(|run| run.nees_of_features.get(feature));
            let (sum, steps) = of.fold((0.0, 0), |all, of| (all.0 + of.0, all.1 + of.1));
            (steps > 0).then(|| sum / (3 * steps) as f64)
        })
        .collect()
}

fn cell_columns() -> Vec<Column> {
    let mut columns: Vec<Column> = ["experiment", "estimator", "planner", "measure"]
        .map(|name| Column::new(name, ColumnKind::Text))
        .into();
    columns.push(Column::new("runs", ColumnKind::Integer));
    columns
}

fn cell_values(cell: &ConsistencyCell, measure: Measure) -> Vec<Value> {
    vec![
        json!(cell.label),
        json!(cell.estimator),
        json!(cell.planner.as_str()),
        json!(measure),
        json!(cell.runs),
    ]
}
