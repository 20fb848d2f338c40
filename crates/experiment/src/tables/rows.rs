//! What the tables hold: rows of values, however they are set.

use std::fmt::Display;

use super::cell::{CellValue, ResultCell};
use super::{ExperimentTables, PlannerRuns};
use crate::config::PublishedPlanner;
use crate::metrics::RunSummary;
use crate::scenario::PlannerName;

/// Up to this many runs are listed one by one, as the paper does.
const LISTED_RUNS: usize = 10;

/// A table with a column for each planner.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultTable {
    /// What stands above it.
    pub title: String,
    /// The heads of its columns.
    pub planners: Vec<PlannerName>,
    /// Its rows, from the top.
    pub rows: Vec<ResultRow>,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultRow {
    /// What it shows, with the unit.
    pub name: String,
    /// A cell for each planner.
    pub cells: Vec<ResultCell>,
}

impl ExperimentTables {
    /// The paper's two tables of an environment, with published values beside ours.
    #[must_use]
    pub fn paper_tables(&self) -> [ResultTable; 2] {
        [self.coverage_table(), self.error_table()]
    }

    /// What the paper's tables leave out.
    #[must_use]
    pub fn further_table(&self) -> ResultTable {
        type Ours = fn(&RunSummary) -> Option<f64>;
        let lines: [(&str, usize, Ours); 10] = [
            ("Drift floor of the position error, mean (cm)", 3, |r| {
                Some(r.drift_floor_mean)
            }),
            ("Object-relative pose error, mean (cm, rad)", 3, |r| {
                Some(r.relative_pose_error_mean)
            }),
            ("Object-relative feature error, mean (cm)", 3, |r| {
                Some(r.relative_feature_error_mean)
            }),
            ("Pose NEES, mean (6 is consistent)", 2, |r| r.pose_nees_mean),
            ("Feature NEES, mean (3 is consistent)", 2, |r| {
                r.feature_nees_mean
            }),
            ("Steps inside the object", 1, |r| {
                Some(r.steps_inside_object as f64)
            }),
            ("Steps nearer than the clearance", 1, |r| {
                Some(r.steps_below_clearance as f64)
            }),
            ("Decisions without a safe action", 1, |r| {
                Some(r.compromised_decisions as f64)
            }),
            ("Decision time, median (ms)", 2, |r| {
                r.decision_ms.map(|times| times.median)
            }),
            ("Decision time, 95th percentile (ms)", 2, |r| {
                r.decision_ms.map(|times| times.p95)
            }),
        ];
        let rows = lines.map(|(name, digits, of_run)| {
            self.row(name, |ours, _| {
                let values = ours.runs.iter().filter_map(of_run);
                ResultCell::new(None, CellValue::of_runs(values, digits))
            })
        });
        let title = format!("Beyond the paper's tables, {}", self.label);
        self.table(title, rows.into())
    }

    /// Tables I and III.
    fn coverage_table(&self) -> ResultTable {
        let title = format!("Coverage, {} ({} steps)", self.label, self.steps);
        let number = self.published.as_ref().map(|p| &p.coverage_table);
        let most = self.planners.iter().map(|column| column.runs.len()).max();
        let listed = most.filter(|most| *most <= LISTED_RUNS).unwrap_or(0);
        let observed = |ours: &PlannerRuns| {
            CellValue::of_runs(ours.runs.iter().map(|run| run.observed as f64), 0)
        };
        let steps = |ours: &PlannerRuns| {
            let steps = ours.runs.iter().filter_map(|r| r.steps_to_full_coverage);
            CellValue::of_runs(steps.map(|n| n as f64), 0)
        };
        let mut rows = Vec::new();
        for k in 0..listed {
            let name = format!("Observed feature times, {}", k + 1);
            rows.push(self.row(&name, |ours, published| {
                let published =
                    published.map(|p| CellValue::of_count(p.observed.get(k).map(|n| n.get())));
                let own = CellValue::of_count(ours.runs.get(k).map(|run| run.observed));
                ResultCell::judged(published, own, observed(ours))
            }));
        }
        let name = "Observed feature times, mean (range)";
        rows.push(self.row(name, |ours, published| {
            let published =
                published.map(|p| CellValue::of_runs(p.observed.iter().map(|n| n.get() as f64), 0));
            ResultCell::new(published, observed(ours))
        }));
        for k in 0..listed {
            let name = format!("Steps to see all, {}", k + 1);
            rows.push(self.row(&name, |ours, published| {
                let published =
                    published.map(|p| CellValue::of_count(p.steps.get(k).and_then(|n| n.0)));
                let own = ours.runs.get(k).and_then(|run| run.steps_to_full_coverage);
                ResultCell::judged(published, CellValue::of_count(own), steps(ours))
            }));
        }
        let name = "Steps to see all, mean (range)";
        rows.push(self.row(name, |ours, published| {
            let published = published.map(|p| {
                CellValue::of_runs(p.steps.iter().filter_map(|n| n.0).map(|n| n as f64), 0)
            });
            ResultCell::new(published, steps(ours))
        }));
        rows.push(self.row("Runs that see all", |ours, published| {
            let share = |steps: &mut dyn Iterator<Item = Option<usize>>, all: usize| {
                let some = steps.filter(Option::is_some).count();
                CellValue::Share { some, all }
            };
            let published =
                published.map(|p| share(&mut p.steps.iter().map(|n| n.0), p.steps.len()));
            let mut own = ours.runs.iter().map(|run| run.steps_to_full_coverage);
            ResultCell::new(published, share(&mut own, ours.runs.len()))
        }));
        self.table(numbered(number, &title), rows)
    }

    /// Tables II and IV.
    fn error_table(&self) -> ResultTable {
        type Published = fn(&PublishedPlanner) -> f64;
        type Ours = fn(&RunSummary) -> f64;
        let lines: [(&str, Published, Ours); 4] = [
            (
                "Max error robot (cm, rad)",
                |p| *p.pose_error_max,
                |r| r.pose_error_max,
            ),
            (
                "Ave error robot (cm, rad)",
                |p| *p.pose_error_mean,
                |r| r.pose_error_mean,
            ),
            (
                "Max error feature (cm)",
                |p| *p.feature_error_max_cm,
                |r| r.feature_error_max,
            ),
            (
                "Ave error feature (cm)",
                |p| *p.feature_error_mean_cm,
                |r| r.feature_error_mean,
            ),
        ];
        let rows = lines.map(|(name, of_published, of_run)| {
            self.row(name, |ours, published| {
                let published = published.map(|p| CellValue::Number {
                    value: of_published(p),
                    digits: 3,
                });
                ResultCell::new(
                    published,
                    CellValue::of_runs(ours.runs.iter().map(of_run), 3),
                )
            })
        });
        let number = self.published.as_ref().map(|p| &p.error_table);
        let title = format!("Estimation error, {}", self.label);
        self.table(numbered(number, &title), rows.into())
    }

    fn table(&self, title: String, rows: Vec<ResultRow>) -> ResultTable {
        ResultTable {
            title,
            planners: self.planners.iter().map(|column| column.planner).collect(),
            rows,
        }
    }

    /// A row made by asking each planner's column.
    fn row(
        &self,
        name: &str,
        cell: impl Fn(&PlannerRuns, Option<&PublishedPlanner>) -> ResultCell,
    ) -> ResultRow {
        let published = |column: &PlannerRuns| {
            let published = self.published.as_ref()?;
            published.planners.get(&column.planner)
        };
        let cells = self.planners.iter();
        ResultRow {
            name: name.to_owned(),
            cells: cells
                .map(|column| cell(column, published(column)))
                .collect(),
        }
    }
}

fn numbered(number: Option<impl Display>, title: &str) -> String {
    match number {
        Some(number) => format!("Table {number}: {title}"),
        None => title.to_owned(),
    }
}
