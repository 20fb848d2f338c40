//! table.md: the means that matter most, and which planners differ.

use std::fmt::Write;

use adslam_statistics::{BOOTSTRAP_CONFIDENCE, MeanEstimate, RankComparison};
use comfy_table::{CellAlignment, Table, presets};
use serde_json::Value;

use super::SweepResults;
use super::metrics::{SEES_ALL, STEPS_TO_SEE_ALL};
use super::point::{Comparison, Tested};
use crate::provenance::remark;

/// A metric that people are shown.
struct Shown {
    metric: &'static str,
    title: &'static str,
    /// Digits behind the point.
    digits: usize,
}

const SHOWN: [Shown; 8] = [
    Shown {
        metric: "relative_pose_error_mean",
        title: "Object-relative pose error, mean over the steps (cm, rad)",
        digits: 3,
    },
    Shown {
        metric: "relative_feature_error_mean",
        title: "Object-relative feature error, mean over the steps (cm)",
        digits: 3,
    },
    Shown {
        metric: "pose_error_mean",
        title: "Pose error, mean over the steps (cm, rad)",
        digits: 3,
    },
    Shown {
        metric: "feature_error_mean",
        title: "Feature error at the last step, mean over the features (cm)",
        digits: 3,
    },
    Shown {
        metric: "observed",
        title: "Observed feature times",
        digits: 1,
    },
    Shown {
        metric: SEES_ALL,
        title: "Share of the runs that see all features",
        digits: 2,
    },
    Shown {
        metric: STEPS_TO_SEE_ALL,
        title: "Steps to see all features, mean of the runs that do",
        digits: 1,
    },
    Shown {
        metric: "pose_nees_mean",
        title: "Pose NEES, mean over the steps (6 is consistent)",
        digits: 2,
    },
];

/// Differences whose corrected p-value is at most this are listed.
const LEVEL: f64 = 0.05;

/// The tables as Markdown.
pub(super) fn markdown(results: &SweepResults<'_>) -> String {
    let sweep = &results.plan.sweep;
    let mut text = format!("# {}\n\n", sweep.title);
    let missing = results.missing();
    if missing > 0 {
        let _ = writeln!(text, "**Incomplete: {missing} runs failed.**\n");
    }
    let last_seed = sweep.first_seed.wrapping_add(results.plan.runs as u64 - 1);
    let _ = writeln!(
        text,
        "Each planner at each point of `{}` with the seeds {} to {last_seed}. In each cell: the mean, and in \
         brackets its {} % bootstrap interval; of shares of runs, that of Clopper and Pearson. Differences are taken between runs of the same seed; their p-values \
         come from sign-flip randomisation tests (of ranks for the steps to see all, where a run that never does is \
         last), by Holm's method corrected for the pairs of planners at a point.\n",
        sweep.scenario.name,
        sweep.first_seed,
        BOOTSTRAP_CONFIDENCE * 100.0,
    );
    if let Some(remark) = remark(&results.builds) {
        let _ = writeln!(text, "{remark}\n");
    }
    text += &too_few_runs(results);
    text += &legend(results);
    for shown in &SHOWN {
        let Some(metric) = results.metrics.iter().position(|name| name == shown.metric) else {
            continue;
        };
        let _ = writeln!(text, "## {}\n", shown.title);
        let _ = writeln!(text, "{}\n", means(results, metric, shown.digits));
        text += &differences(results, metric, shown.digits);
    }
    text
}

/// A remark where no difference can reach the level, however clear it is.
fn too_few_runs(results: &SweepResults<'_>) -> String {
    let planners = results.plan.sweep.planners.len();
    let pairs = planners * (planners - 1) / 2;
    let smallest = |runs: usize| {
        let halvings = i32::try_from(runs - 1).unwrap_or(i32::MAX);
        pairs as f64 * 0.5_f64.powi(halvings)
    };
    if pairs == 0 || smallest(results.plan.runs) <= LEVEL {
        return String::new();
    }
    let enough = (1..).find(|runs| smallest(*runs) <= LEVEL).unwrap_or(1);
    format!(
        "{} is too few runs for any difference to have a corrected p-value of at most {LEVEL}; it takes \
         {enough}.\n\n",
        results.plan.runs
    )
}

/// What each point sets, where all have labels: columns for keys that each few points set would be mostly empty.
fn legend(results: &SweepResults<'_>) -> String {
    if !points_are_told_by_labels(results) {
        return String::new();
    }
    let mut text = String::new();
    for (number, point) in (1..).zip(&results.plan.sweep.points) {
        let label = point.label.as_deref().unwrap_or_default();
        let set = results.plan.sweep.varied.iter().filter_map(|key| {
            let value = point.overrides.get(key)?;
            Some(format!("`{key}` = {value}"))
        });
        let set: Vec<String> = set.collect();
        let set = match set.as_slice() {
            [] => "as the scenario".to_owned(),
            some => some.join(", "),
        };
        let _ = writeln!(text, "{number}. {label}: {set}");
    }
    text + "\n"
}

fn points_are_told_by_labels(results: &SweepResults<'_>) -> bool {
    let points = &results.plan.sweep.points;
    points.iter().all(|point| point.label.is_some())
}

/// The keys that have a column.
fn keys_shown<'a>(results: &'a SweepResults<'_>) -> &'a [String] {
    if points_are_told_by_labels(results) {
        return &[];
    }
    &results.plan.sweep.varied
}

/// A row for each point, a column for each planner.
fn means(results: &SweepResults<'_>, metric: usize, digits: usize) -> Table {
    let planners = results.plan.sweep.planners.iter().map(ToString::to_string);
    let mut table = started(results, planners);
    for (index, point) in results.points.iter().enumerate() {
        let cells = point.planners.iter().map(|planner| {
            let mean = planner.means[metric].as_ref();
            let text = mean.map_or("–".to_owned(), |mean| estimate(mean, digits));
            match mean.map_or(0, |mean| mean.count) {
                count if count < planner.done && results.metrics[metric] == STEPS_TO_SEE_ALL => {
                    format!("{text}, {} of {} never", planner.done - count, planner.done)
                }
                count if count < planner.done => {
                    format!("{text}, {count} of {} runs", planner.done)
                }
                _ => text,
            }
        });
        table.add_row(point_cells(results, index).into_iter().chain(cells));
    }
    aligned(table, results)
}

/// The pairs of planners that differ, and how many do not.
fn differences(results: &SweepResults<'_>, metric: usize, digits: usize) -> String {
    let planners = &results.plan.sweep.planners;
    if planners.len() < 2 {
        return String::new();
    }
    let by_ranks = results.metrics[metric] == STEPS_TO_SEE_ALL;
    let what = if by_ranks {
        "sooner, later, alike"
    } else {
        "mean difference"
    };
    let heads = ["planners", what, "p (Holm)"];
    let mut table = started(results, heads.map(ToOwned::to_owned));
    let (mut listed, mut compared) = (0, 0);
    for (index, point) in results.points.iter().enumerate() {
        for Comparison {
            first,
            second,
            result,
        } in &point.comparisons[metric]
        {
            let Some(result) = result else { continue };
            compared += 1;
            if result.p_holm > LEVEL {
                continue;
            }
            listed += 1;
            let cells = [
                format!("{} − {}", planners[*first], planners[*second]),
                shown_difference(&result.tested, by_ranks, digits),
                format!("{:.5}", result.p_holm),
            ];
            table.add_row(point_cells(results, index).into_iter().chain(cells));
        }
    }
    let said = format!(
        "{listed} of {compared} differences between planners have a corrected p-value of at most {LEVEL}"
    );
    match listed {
        0 => format!("{said}.\n\n"),
        _ => format!("{said}:\n\n{}\n\n", aligned(table, results)),
    }
}

/// The mean difference or, where never is last, how often the first of the two is sooner, later and neither.
fn shown_difference(tested: &Tested, by_ranks: bool, digits: usize) -> String {
    let RankComparison {
        smaller,
        larger,
        equal,
        ..
    } = tested.ranks;
    match &tested.difference {
        Some(difference) if !by_ranks => estimate(difference, digits),
        _ => format!("{smaller}, {larger}, {equal}"),
    }
}

/// A table whose first columns say which point it is.
fn started(results: &SweepResults<'_>, heads: impl IntoIterator<Item = String>) -> Table {
    let mut table = Table::new();
    let mut of_point = vec!["point".to_owned()];
    of_point.extend(heads_of(keys_shown(results)));
    table
        .load_style(presets::ASCII_MARKDOWN)
        .set_header(of_point.into_iter().chain(heads));
    table
}

/// The last parts of the keys; a whole key where another ends alike.
fn heads_of(keys: &[String]) -> impl Iterator<Item = String> {
    let last = |key: &str| key.rsplit('.').next().unwrap_or(key).to_owned();
    keys.iter().map(move |key| {
        let alike = keys.iter().filter(|other| last(other) == last(key)).count();
        format!("`{}`", if alike > 1 { key.clone() } else { last(key) })
    })
}

fn aligned(mut table: Table, results: &SweepResults<'_>) -> Table {
    let of_point = 1 + keys_shown(results).len();
    for column in table.column_iter_mut().skip(of_point) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn point_cells(results: &SweepResults<'_>, index: usize) -> Vec<String> {
    let point = &results.plan.sweep.points[index];
    let label = point.label.as_ref();
    let mut cells = vec![label.map_or((index + 1).to_string(), |label| {
        format!("{} {label}", index + 1)
    })];
    let values = point.values.iter().take(keys_shown(results).len());
    cells.extend(values.map(|value| match value {
        None => "–".to_owned(),
        Some(Value::String(text)) => text.clone(),
        Some(other) => other.to_string().replace('|', r"\|"),
    }));
    cells
}

fn estimate(estimate: &MeanEstimate, digits: usize) -> String {
    let MeanEstimate { mean, interval, .. } = estimate;
    match interval {
        None => format!("{mean:.digits$}"),
        Some(interval) => {
            let (low, high) = (interval.low, interval.high);
            format!("{mean:.digits$} ({low:.digits$} to {high:.digits$})")
        }
    }
}
