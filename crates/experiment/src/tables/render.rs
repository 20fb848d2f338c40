//! Tables for people: in the terminal, and as Markdown.

use std::fmt::Write;

use comfy_table::{CellAlignment, Table, TableStyle, presets};

use super::{ExperimentTables, PlannerRuns, Spread, Tables};
use crate::config::PublishedPlanner;
use crate::metrics::RunSummary;

/// Up to this many runs are listed one by one, as the paper does.
const LISTED_RUNS: usize = 10;

/// How the tables are set.
#[derive(Clone, Copy)]
struct Setting {
    style: TableStyle,
    heading: &'static str,
    /// Between a published value and ours where both together are wide.
    wide_separator: &'static str,
}

/// All tables, drawn with lines.
#[must_use]
pub fn terminal(tables: &Tables) -> String {
    let setting = Setting {
        style: presets::UTF8_FULL_CONDENSED,
        heading: "",
        wide_separator: "\n",
    };
    let legend = "In each cell: the published value, then ours, the mean over the runs (range).";
    format!("{legend}\n\n{}", render(tables, setting))
}

/// All tables as Markdown.
#[must_use]
pub fn markdown(tables: &Tables) -> String {
    let setting = Setting {
        style: presets::ASCII_MARKDOWN,
        heading: "## ",
        wide_separator: " / ",
    };
    let mut text = format!("# {}\n\n", tables.title);
    if !tables.is_complete() {
        text.push_str("**Incomplete: some runs failed or were interrupted.**\n\n");
    }
    let _ = writeln!(
        text,
        "{} runs of each planner. In each cell: published / ours, the mean over the runs with the \
         range in brackets.\n",
        tables.runs
    );
    text + &render(tables, setting)
}

fn render(tables: &Tables, setting: Setting) -> String {
    let mut text = String::new();
    for experiment in &tables.experiments {
        for (title, rows) in [
            coverage_table(experiment),
            error_table(experiment),
            further_table(experiment),
        ] {
            let table = draw(experiment, rows, setting);
            let _ = writeln!(text, "{}{title}\n\n{table}\n", setting.heading);
        }
    }
    text
}

/// A row: what it shows, and a cell for each planner.
type Row = (String, Vec<Cell>);

/// A published value, if there is one, and ours.
struct Cell {
    published: Option<String>,
    ours: String,
}

impl Cell {
    fn new(published: Option<String>, ours: Option<String>) -> Self {
        let ours = ours.unwrap_or_else(|| "-".to_owned());
        Self { published, ours }
    }

    fn set(self, wide_separator: &str) -> String {
        const WIDE: usize = 16;
        let Some(published) = self.published else {
            return self.ours;
        };
        let is_wide = published.chars().count() + self.ours.chars().count() > WIDE;
        let separator = if is_wide { wide_separator } else { " / " };
        published + separator + &self.ours
    }
}

fn draw(experiment: &ExperimentTables, rows: Vec<Row>, setting: Setting) -> Table {
    let mut table = Table::new();
    let names = experiment
        .planners
        .iter()
        .map(|column| column.planner.to_string());
    table
        .load_style(setting.style)
        .set_header(std::iter::once(String::new()).chain(names));
    for (name, cells) in rows {
        let cells = cells
            .into_iter()
            .map(|cell| cell.set(setting.wide_separator));
        table.add_row(std::iter::once(name).chain(cells));
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn published_of<'a>(
    experiment: &'a ExperimentTables,
    column: &PlannerRuns,
) -> Option<&'a PublishedPlanner> {
    experiment.published.as_ref()?.planners.get(&column.planner)
}

/// A row made by asking each planner's column.
fn row(
    experiment: &ExperimentTables,
    name: &str,
    cell: impl Fn(&PlannerRuns, Option<&PublishedPlanner>) -> Cell,
) -> Row {
    let cells = experiment
        .planners
        .iter()
        .map(|column| cell(column, published_of(experiment, column)))
        .collect();
    (name.to_owned(), cells)
}

/// Tables I and III.
fn coverage_table(experiment: &ExperimentTables) -> (String, Vec<Row>) {
    let number = experiment
        .published
        .as_ref()
        .map(|p| format!("Table {}: ", p.coverage_table));
    let title = format!(
        "{}Coverage, {} ({} steps)",
        number.unwrap_or_default(),
        experiment.label,
        experiment.steps
    );
    let listed = experiment
        .planners
        .iter()
        .map(|column| column.runs.len())
        .max()
        .unwrap_or(0);
    let listed = if listed <= LISTED_RUNS { listed } else { 0 };
    let mut rows = Vec::new();
    for k in 0..listed {
        rows.push(row(
            experiment,
            &format!("Observed feature times, {}", k + 1),
            |ours, published| {
                let published = published.map(|p| {
                    p.observed
                        .get(k)
                        .map_or("-".to_owned(), |n| n.get().to_string())
                });
                Cell::new(
                    published,
                    ours.runs.get(k).map(|run| run.observed.to_string()),
                )
            },
        ));
    }
    rows.push(row(
        experiment,
        "Observed feature times, mean (range)",
        |ours, published| {
            let published = published
                .and_then(|p| Spread::of(p.observed.iter().map(|n| n.get() as f64)))
                .map(|spread| format!("{spread:.0}"));
            Cell::new(
                published,
                spread(&ours.runs, 0, |run| Some(run.observed as f64)),
            )
        },
    ));
    let step = |step: Option<usize>| step.map_or("-".to_owned(), |n| n.to_string());
    for k in 0..listed {
        rows.push(row(
            experiment,
            &format!("Steps to see all, {}", k + 1),
            |ours, published| {
                let published =
                    published.map(|p| p.steps.get(k).map_or("-".to_owned(), |n| step(n.0)));
                Cell::new(
                    published,
                    ours.runs.get(k).map(|run| step(run.steps_to_full_coverage)),
                )
            },
        ));
    }
    rows.push(row(
        experiment,
        "Steps to see all, mean (range)",
        |ours, published| {
            let published = published.map(|p| {
                Spread::of(p.steps.iter().filter_map(|n| n.0).map(|n| n as f64))
                    .map_or("-".to_owned(), |spread| format!("{spread:.0}"))
            });
            let of_run = |run: &RunSummary| run.steps_to_full_coverage.map(|n| n as f64);
            Cell::new(published, spread(&ours.runs, 0, of_run))
        },
    ));
    rows.push(row(experiment, "Runs that see all", |ours, published| {
        let share = |some: usize, all: usize| format!("{some} of {all}");
        let published = published.map(|p| {
            share(
                p.steps.iter().filter(|n| n.0.is_some()).count(),
                p.steps.len(),
            )
        });
        let all = ours
            .runs
            .iter()
            .filter(|run| run.steps_to_full_coverage.is_some())
            .count();
        Cell::new(published, Some(share(all, ours.runs.len())))
    }));
    (title, rows)
}

/// Tables II and IV.
fn error_table(experiment: &ExperimentTables) -> (String, Vec<Row>) {
    let number = experiment
        .published
        .as_ref()
        .map(|p| format!("Table {}: ", p.error_table));
    let title = format!(
        "{}Estimation error, {}",
        number.unwrap_or_default(),
        experiment.label
    );
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
        row(experiment, name, |ours, published| {
            let published = published.map(|p| format!("{:.3}", of_published(p)));
            Cell::new(published, spread(&ours.runs, 3, |run| Some(of_run(run))))
        })
    });
    (title, rows.into())
}

/// What the paper's tables leave out.
fn further_table(experiment: &ExperimentTables) -> (String, Vec<Row>) {
    let title = format!("Beyond the paper's tables, {}", experiment.label);
    type Ours = fn(&RunSummary) -> Option<f64>;
    let lines: [(&str, usize, Ours); 9] = [
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
            Some(r.decision_ms.median)
        }),
        ("Decision time, 95th percentile (ms)", 2, |r| {
            Some(r.decision_ms.p95)
        }),
    ];
    let rows = lines.map(|(name, digits, of_run)| {
        row(experiment, name, |ours, _| {
            Cell::new(None, spread(&ours.runs, digits, of_run))
        })
    });
    (title, rows.into())
}

fn spread(
    runs: &[RunSummary],
    digits: usize,
    of_run: impl Fn(&RunSummary) -> Option<f64>,
) -> Option<String> {
    Spread::of(runs.iter().filter_map(of_run)).map(|spread| format!("{spread:.digits$}"))
}
