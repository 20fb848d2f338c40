//! What the tables hold: rows of values, however they are set.

use std::fmt::Display;

use adslam_names::PlannerName;
use adslam_scenario::config::PublishedPlanner;
use adslam_simulation::RunSummary;
use adslam_statistics::{Statistic, interval_of_share, mean};

use super::agreement::Published;
use super::cell::{CellValue, ResultCell};
use super::{Agreement, Comparison, ExperimentTables, PlannerRuns};

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
                ResultCell {
                    published: None,
                    ours: CellValue::of_runs(values, digits),
                    comparison: None,
                }
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
        let mut rows = Vec::new();
        for k in 0..listed {
            let name = format!("Observed feature times, {}", k + 1);
            rows.push(self.row(&name, |ours, published| {
                let published = published.map(|p| p.observed.get(k).map(|n| n.get()));
                let compared = published
                    .flatten()
                    .and_then(|count| Published::mean(count as f64, 1).against(&observed(ours)));
                ResultCell {
                    published: published.map(CellValue::of_count),
                    ours: CellValue::of_count(ours.runs.get(k).map(|run| run.observed)),
                    comparison: compared,
                }
            }));
        }
        let name = "Observed feature times, mean (range)";
        rows.push(self.row(name, |ours, published| {
            let published = published.map(|p| p.observed.iter().map(|n| n.get() as f64));
            let published: Option<Vec<f64>> = published.map(Iterator::collect);
            ResultCell {
                comparison: published
                    .as_ref()
                    .and_then(|p| Published::mean(mean(p), p.len()).against(&observed(ours))),
                published: published.map(|p| CellValue::of_runs(p, 0)),
                ours: CellValue::of_runs(observed(ours), 0),
            }
        }));
        for k in 0..listed {
            let name = format!("Steps to see all, {}", k + 1);
            rows.push(self.row(&name, |ours, published| {
                let published = published.map(|p| p.steps.get(k).map(|steps| steps.0));
                let own = ours.runs.get(k).map(|run| run.steps_to_full_coverage);
                ResultCell {
                    published: published.map(|steps| CellValue::of_count(steps.flatten())),
                    ours: CellValue::of_count(own.flatten()),
                    comparison: published
                        .flatten()
                        .zip(own)
                        .and_then(|(published, own)| single_step(published, own, &steps(ours))),
                }
            }));
        }
        let name = "Steps to see all, mean of the runs that do (range)";
        rows.push(self.row(name, |ours, published| {
            let published = published.map(|p| p.steps.iter().map(|steps| steps.0));
            ResultCell {
                comparison: published.clone().and_then(|p| {
                    let p: Vec<f64> = p.map(step).collect();
                    Published::mean(Statistic::Mean.of(&p), p.len()).against(&steps(ours))
                }),
                published: published.map(CellValue::of_steps),
                ours: CellValue::of_steps(ours.runs.iter().map(|r| r.steps_to_full_coverage)),
            }
        }));
        rows.push(self.row("Runs that see all", |ours, published| {
            let finished = |steps: &[f64]| steps.iter().filter(|step| step.is_finite()).count();
            let published =
                published.map(|p| p.steps.iter().map(|s| step(s.0)).collect::<Vec<f64>>());
            let own = steps(ours);
            let sees_all = own.iter().map(|step| f64::from(u8::from(step.is_finite())));
            let sees_all: Vec<f64> = sees_all.collect();
            let (some, all) = (finished(&own), own.len());
            ResultCell {
                comparison: published.as_ref().and_then(|p| {
                    let share = finished(p) as f64 / p.len() as f64;
                    let published = Published {
                        is_share: true,
                        ..Published::mean(share, p.len())
                    };
                    published.against(&sees_all)
                }),
                published: published.map(|p| CellValue::Share {
                    some: finished(&p),
                    all: p.len(),
                    interval: None,
                }),
                ours: CellValue::Share {
                    some,
                    all,
                    interval: interval_of_share(some, all),
                },
            }
        }));
        self.table(numbered(number, &title), rows)
    }

    /// Tables II and IV.
    fn error_table(&self) -> ResultTable {
        type Theirs = fn(&PublishedPlanner) -> f64;
        type Ours = fn(&RunSummary) -> f64;
        let lines: [(&str, Statistic, Theirs, Ours); 4] = [
            (
                "Max error robot (cm, rad)",
                Statistic::Largest,
                |p| *p.pose_error_max,
                |r| r.pose_error_max,
            ),
            (
                "Ave error robot (cm, rad)",
                Statistic::Mean,
                |p| *p.pose_error_mean,
                |r| r.pose_error_mean,
            ),
            (
                "Max error feature (cm)",
                Statistic::Largest,
                |p| *p.feature_error_max_cm,
                |r| r.feature_error_max,
            ),
            (
                "Ave error feature (cm)",
                Statistic::Mean,
                |p| *p.feature_error_mean_cm,
                |r| r.feature_error_mean,
            ),
        ];
        let rows = lines.map(|(name, statistic, of_published, of_run)| {
            self.row(name, |ours, published| {
                let own: Vec<f64> = ours.runs.iter().map(of_run).collect();
                ResultCell {
                    comparison: published.and_then(|p| {
                        let published = Published {
                            statistic,
                            ..Published::mean(of_published(p), p.observed.len())
                        };
                        published.against(&own)
                    }),
                    published: published.map(|p| CellValue::Number {
                        value: of_published(p),
                        digits: 3,
                    }),
                    ours: CellValue::of_runs(own, 3),
                }
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

/// A step as a number: infinite where it never comes.
fn step(step: Option<usize>) -> f64 {
    step.map_or(f64::INFINITY, |step| step as f64)
}

fn steps(ours: &PlannerRuns) -> Vec<f64> {
    let steps = ours.runs.iter().map(|run| run.steps_to_full_coverage);
    steps.map(step).collect()
}

fn observed(ours: &PlannerRuns) -> Vec<f64> {
    ours.runs.iter().map(|run| run.observed as f64).collect()
}

/// The step of a single published run against all of ours. It does not agree where it or the run of ours that is
/// shown beside it never gets there, and the other does.
fn single_step(published: Option<usize>, own: Option<usize>, ours: &[f64]) -> Option<Comparison> {
    let compared = Published::mean(step(published), 1).against(ours)?;
    let differ = published.is_some() != own.is_some();
    Some(Comparison {
        agreement: compared.agreement.map(|agreement| {
            if differ {
                Agreement::of_order(step(own), step(published))
            } else {
                agreement
            }
        }),
        ..compared
    })
}

fn numbered(number: Option<impl Display>, title: &str) -> String {
    match number {
        Some(number) => format!("Table {number}: {title}"),
        None => title.to_owned(),
    }
}
