//! What the charts of several methods have in common.

use adslam_record::{HistoryStep, RunHistory};

use crate::error::DrawingError;
use crate::figure::Area;
use crate::legend::{self, Entry};
use crate::method::Method;
use crate::shape::{Look, Shape};
use crate::sheet::size_in_units;
use crate::style::FLOOR;

/// The histories in the order of the paper's tables, others by their names, whatever order they came in.
pub(crate) fn in_order<'a>(histories: &[&'a RunHistory]) -> Vec<&'a RunHistory> {
    let mut sorted = histories.to_vec();
    sorted.sort_by_key(|history| history.planner);
    sorted
}

/// The name of a scenario with a capital, and of the seed if all runs have the same.
pub(crate) fn subject(histories: &[&RunHistory]) -> String {
    let Some(first) = histories.first() else {
        return "no runs".to_owned();
    };
    format!("{} environment, seed {}", first.scenario, first.seed)
}

/// The number of the longest history's last step.
pub(crate) fn last_step(histories: &[&RunHistory]) -> usize {
    histories.iter().map(|h| h.steps.len()).max().unwrap_or(0)
}

/// The steps of a history with their numbers, from 1.
pub(crate) fn numbered(history: &RunHistory) -> impl Iterator<Item = (f64, &HistoryStep)> {
    let numbers = (1u32..).map(f64::from);
    numbers.zip(&history.steps)
}

/// A method's line through a value of each step that has one.
pub(crate) fn curve(
    history: &RunHistory,
    value: impl Fn(&HistoryStep) -> Option<f64>,
) -> Shape<(f64, f64)> {
    let points = numbered(history).filter_map(|(n, step)| Some((n, value(step)?)));
    Shape::line(points.collect(), Method::of(history).stroke())
}

/// The drift floor of a history, each step's value times `factor`; empty where it has none.
pub(crate) fn drift_floor(history: &RunHistory, factor: f64) -> Shape<(f64, f64)> {
    let points =
        numbered(history).filter_map(|(n, step)| Some((n, factor * step.metrics.drift_floor_cm?)));
    Shape::line(points.collect(), FLOOR)
}

/// An entry for each method that there is.
pub(crate) fn entries(histories: &[&RunHistory]) -> Vec<Entry> {
    let mut methods: Vec<Method> = histories
        .iter()
        .map(|history| Method::of(history))
        .collect();
    methods.dedup();
    let entry = |method: &Method| Entry::new(Look::Line(method.stroke()), method.label());
    methods.iter().map(entry).collect()
}

/// Cuts the rows of a legend off the top of an area and draws it there; returns the rest.
pub(crate) fn below_legend<'a>(
    area: &Area<'a>,
    entries: &[Entry],
    width: f64,
) -> Result<Area<'a>, DrawingError> {
    let height = legend::height(entries, width) + LEGEND_GAP;
    let (top, rest) = area.split_vertically(size_in_units(height));
    legend::draw(&top, entries)?;
    Ok(rest)
}

/// The space below a legend, px.
pub(crate) const LEGEND_GAP: f64 = 4.0;
