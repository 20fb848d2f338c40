//! From the records of a sweep to its tables.

use std::path::{Path, PathBuf};

use adslam_diagnostics::Failure;
use adslam_record::{AtomicFile, Column, ColumnKind, TableFile};
use adslam_statistics::{MeanEstimate, RankComparison};
use rayon::prelude::*;
use serde_json::{Value, json};

use super::metrics::metrics;
use super::point::{PlannerMetrics, PointStatistics};
use super::{SweepPlan, markdown};
use crate::provenance::BuildRuns;
use crate::run::warnings;
use crate::study::SummaryRecord;

/// What a sweep gave: made of its records alone, the same whenever and in whatever order they were written.
pub struct SweepResults<'a> {
    pub(super) plan: &'a SweepPlan,
    records: &'a [Option<SummaryRecord>],
    pub(super) builds: Vec<BuildRuns>,
    /// The names of all metrics.
    pub(super) metrics: Vec<String>,
    /// For each point.
    pub(super) points: Vec<PointStatistics>,
}

impl<'a> SweepResults<'a> {
    /// Of the records of a plan's study, in its order, and what made them, as [`Study::builds`] says.
    ///
    /// [`Study::builds`]: crate::study::Study::builds
    #[must_use]
    pub fn new(
        plan: &'a SweepPlan,
        records: &'a [Option<SummaryRecord>],
        builds: Vec<BuildRuns>,
    ) -> Self {
        let first = records.iter().flatten().next();
        let metrics: Vec<String> = first
            .map(|record| metrics(&record.summary).keys().cloned().collect())
            .unwrap_or_default();
        let points = records
            .par_chunks(plan.sweep.planners.len() * plan.runs)
            .map(|point| {
                let planners: Vec<_> = point.chunks(plan.runs).map(of_planner).collect();
                PointStatistics::of(&planners, &metrics)
            })
            .collect();
        Self {
            plan,
            records,
            builds,
            metrics,
            points,
        }
    }

    /// How many runs have no record.
    #[must_use]
    pub fn missing(&self) -> usize {
        self.records
            .iter()
            .filter(|record| record.is_none())
            .count()
    }

    /// What the user should know of the runs, each once.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let done = self.records.iter().flatten();
        warnings::merged(done.map(|record| record.warnings.as_slice()))
    }

    /// Writes all tables into `folder` and returns their paths: runs, table and comparisons in the formats of
    /// [`TableFile`], and table.md for people.
    ///
    /// # Errors
    /// [`Failure::Output`]; the tables that were there are then unchanged.
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
        let mut files = Vec::new();
        for table in [
            self.write_runs(folder)?,
            self.write_table(folder)?,
            self.write_comparisons(folder)?,
        ] {
            files.extend(table.finish()?);
        }
        let text = markdown::markdown(self);
        files.push(AtomicFile::with_content(
            &folder.join("table.md"),
            text.as_bytes(),
        )?);
        let paths = files.iter().map(|file| file.path().to_owned()).collect();
        AtomicFile::commit_all(files)?;
        Ok(paths)
    }

    /// A row a run.
    fn write_runs(&self, folder: &Path) -> Result<TableFile, Failure> {
        let mut columns = self.columns_of_points();
        columns.push(Column::new("planner", ColumnKind::Text));
        columns.push(Column::new("seed", ColumnKind::Integer));
        columns.extend(self.metrics.iter().map(|name| number(name, "")));
        let mut table = TableFile::create(folder, "runs", columns)?;
        let planners = &self.plan.sweep.planners;
        for (index, record) in self.records.iter().enumerate() {
            let Some(record) = record else { continue };
            let cell = index / self.plan.runs;
            let mut row = self.cells_of_point(cell / planners.len());
            row.push(json!(planners[cell % planners.len()].as_str()));
            row.push(json!(record.summary.seed));
            let mut values = metrics(&record.summary);
            let value = |name| values.remove(name).unwrap_or_default();
            row.extend(self.metrics.iter().map(value));
            table.add(row)?;
        }
        Ok(table)
    }

    /// A row for each planner at each point.
    fn write_table(&self, folder: &Path) -> Result<TableFile, Failure> {
        let mut columns = self.columns_of_points();
        columns.push(Column::new("planner", ColumnKind::Text));
        columns.push(Column::new("runs", ColumnKind::Integer));
        columns.push(Column::new("failures", ColumnKind::Integer));
        for name in &self.metrics {
            columns.push(Column::new(format!("{name}_count"), ColumnKind::Integer));
            columns.extend(["_mean", "_low", "_high"].map(|what| number(name, what)));
        }
        let mut table = TableFile::create(folder, "table", columns)?;
        for (index, point) in self.points.iter().enumerate() {
            for (planner, results) in self.plan.sweep.planners.iter().zip(&point.planners) {
                let mut row = self.cells_of_point(index);
                row.push(json!(planner.as_str()));
                row.push(json!(results.done));
                row.push(json!(self.plan.runs - results.done));
                for mean in &results.means {
                    row.push(json!(mean.map_or(0, |mean| mean.count)));
                    row.extend(cells_of_mean(mean.as_ref()));
                }
                table.add(row)?;
            }
        }
        Ok(table)
    }

    /// A row for each pair of planners, metric by metric, point by point.
    fn write_comparisons(&self, folder: &Path) -> Result<TableFile, Failure> {
        let mut columns = self.columns_of_points();
        columns
            .extend(["metric", "planner", "other"].map(|name| Column::new(name, ColumnKind::Text)));
        let counts = ["pairs", "smaller", "larger", "equal", "difference_count"];
        columns.extend(counts.map(|name| Column::new(name, ColumnKind::Integer)));
        columns.extend(["mean", "low", "high"].map(|what| number("difference_", what)));
        columns.extend(["p", "p_holm"].map(|name| number(name, "")));
        let mut table = TableFile::create(folder, "comparisons", columns)?;
        let planner = |index: usize| json!(self.plan.sweep.planners[index].as_str());
        for (index, point) in self.points.iter().enumerate() {
            for (metric, comparisons) in self.metrics.iter().zip(&point.comparisons) {
                for comparison in comparisons {
                    let result = comparison.result.as_ref();
                    let tested = result.map(|result| &result.tested);
                    let difference = tested.and_then(|tested| tested.difference.as_ref());
                    let count = |of: fn(&RankComparison) -> usize| {
                        json!(tested.map_or(0, |tested| of(&tested.ranks)))
                    };
                    let mut row = self.cells_of_point(index);
                    row.extend([
                        json!(metric),
                        planner(comparison.first),
                        planner(comparison.second),
                        count(|ranks| ranks.smaller + ranks.larger + ranks.equal),
                        count(|ranks| ranks.smaller),
                        count(|ranks| ranks.larger),
                        count(|ranks| ranks.equal),
                        json!(difference.map_or(0, |mean| mean.count)),
                    ]);
                    row.extend(cells_of_mean(difference));
                    row.push(json!(tested.map(|tested| tested.p)));
                    row.push(json!(result.map(|result| result.p_holm)));
                    table.add(row)?;
                }
            }
        }
        Ok(table)
    }

    /// The columns that say which point it is.
    fn columns_of_points(&self) -> Vec<Column> {
        let sweep = &self.plan.sweep;
        let mut columns = vec![
            Column::new("point", ColumnKind::Integer),
            Column::new("label", ColumnKind::Text),
        ];
        columns.extend(sweep.varied.iter().enumerate().map(|(index, key)| {
            let mut values = sweep
                .points
                .iter()
                .filter_map(|point| point.values[index].as_ref());
            let kind = if values.all(Value::is_number) {
                ColumnKind::Number
            } else {
                ColumnKind::Text
            };
            Column::new(key, kind)
        }));
        columns
    }

    fn cells_of_point(&self, index: usize) -> Vec<Value> {
        let point = &self.plan.sweep.points[index];
        let mut cells = vec![json!(index + 1), json!(point.label)];
        cells.extend(point.values.iter().map(|value| json!(value)));
        cells
    }
}

fn of_planner(runs: &[Option<SummaryRecord>]) -> PlannerMetrics {
    let of_run = |record: &Option<SummaryRecord>| Some(metrics(&record.as_ref()?.summary));
    runs.iter().map(of_run).collect()
}

fn number(name: &str, what: &str) -> Column {
    Column::new(format!("{name}{what}"), ColumnKind::Number)
}

/// Mean, lower and upper end of the interval.
fn cells_of_mean(estimate: Option<&MeanEstimate>) -> [Value; 3] {
    let interval = estimate.and_then(|estimate| estimate.interval);
    [
        json!(estimate.map(|estimate| estimate.mean)),
        json!(interval.map(|interval| interval.low)),
        json!(interval.map(|interval| interval.high)),
    ]
}
