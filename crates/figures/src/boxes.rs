//! Box plots over many runs of every number that the tables show.

use adslam_simulation::RunSummary;
use plotters::coord::ranged1d::Ranged;

use crate::axis::Axis;
use crate::chart::{Chart, Margins};
use crate::error::{DrawingError, FigureError};
use crate::figure::{Area, Figure, Frame};
use crate::method::Method;
use crate::shape::{Look, Shape};
use crate::statistics::Quartiles;
use crate::style::{Colour, FLOOR, FULL_WIDTH, INK, Stroke};

/// The runs of one planner.
#[derive(Clone, Debug)]
pub struct RunsOfMethod<'a> {
    /// Which planner.
    pub method: Method,
    /// Its runs.
    pub runs: &'a [RunSummary],
}

/// A row of the tables.
struct Column {
    title: &'static str,
    label: &'static str,
    scale: Scale,
    of_run: fn(&RunSummary) -> Option<f64>,
    /// What it cannot be below on average, if there is such a thing.
    floor: Option<fn(&RunSummary) -> f64>,
}

/// What its axis is like.
enum Scale {
    FromZero,
    /// From zero to 5 at least.
    Count,
    Log,
}

const fn column(
    title: &'static str,
    label: &'static str,
    scale: Scale,
    of_run: fn(&RunSummary) -> Option<f64>,
) -> Column {
    Column {
        title,
        label,
        scale,
        of_run,
        floor: None,
    }
}

use Scale::{Count, FromZero, Log};

/// Every row of the tables, in their order, but for the drift floor, which is the same in every run: it
/// is a line in the panel of the pose error.
const COLUMNS: [Column; 15] = [
    column("Observed feature times", "count", Count, |r| {
        Some(r.observed as f64)
    }),
    column("Steps to see all features", "steps", Count, |r| {
        r.steps_to_full_coverage.map(|n| n as f64)
    }),
    column("Pose error, mean", "cm, rad", Log, |r| {
        Some(r.pose_error_mean)
    })
    .above(|r| r.drift_floor_mean),
    column("Pose error, maximum", "cm, rad", Log, |r| {
        Some(r.pose_error_max)
    }),
    column("Feature error, mean", "cm", FromZero, |r| {
        Some(r.feature_error_mean)
    }),
    column("Feature error, maximum", "cm", FromZero, |r| {
        Some(r.feature_error_max)
    }),
    column("Object-relative pose error", "cm, rad", Log, |r| {
        Some(r.relative_pose_error_mean)
    }),
    column("Object-relative feature error", "cm", FromZero, |r| {
        Some(r.relative_feature_error_mean)
    }),
    column("Pose NEES, mean", "dimensionless", FromZero, |r| {
        r.pose_nees_mean
    }),
    column("Feature NEES, mean", "dimensionless", FromZero, |r| {
        r.feature_nees_mean
    }),
    column("Inside the object", "steps", Count, |r| {
        Some(r.steps_inside_object as f64)
    }),
    column("Nearer than the clearance", "steps", Count, |r| {
        Some(r.steps_below_clearance as f64)
    }),
    column("Without a safe action", "decisions", Count, |r| {
        Some(r.compromised_decisions as f64)
    }),
    column("Decision time, median", "ms", Log, |r| {
        r.decision_ms.map(|times| times.median)
    }),
    column("Decision time, 95th percentile", "ms", Log, |r| {
        r.decision_ms.map(|times| times.p95)
    }),
];

const ROWS: usize = COLUMNS.len() / 3;

/// The height of a row, px.
const HEIGHT: f64 = 148.0;

/// A panel for each row of the tables of the experiment `label`, a box for each planner: the quartiles, the
/// farthest values within 1.5 times their distance, and every run as a dot. A dotted line is the drift
/// floor. Runs without a value,
/// such as those that never see all features, are left out, and how many are
/// left stands above their box.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn boxes(
    name: &str,
    label: &str,
    planners: &[RunsOfMethod<'_>],
) -> Result<Figure, FigureError> {
    let runs = planners.iter().map(|p| p.runs.len()).max();
    let frame = Frame {
        name,
        title: &format!(
            "Every number of the tables over {} runs, {label} environment",
            runs.unwrap_or(0),
        ),
        width: FULL_WIDTH,
        height: HEIGHT * ROWS as f64 + 4.0,
    };
    frame.draw(|area| {
        let panels = area.split_evenly((ROWS, COLUMNS.len() / ROWS));
        for ((panel, column), letter) in panels.iter().zip(&COLUMNS).zip('a'..) {
            column.draw(panel, letter, planners)?;
        }
        Ok(())
    })
}

impl Column {
    const fn above(mut self, floor: fn(&RunSummary) -> f64) -> Self {
        self.floor = Some(floor);
        self
    }

    fn draw(
        &self,
        area: &Area<'_>,
        letter: char,
        planners: &[RunsOfMethod<'_>],
    ) -> Result<(), DrawingError> {
        let values: Vec<Vec<f64>> = planners
            .iter()
            .map(|p| p.runs.iter().filter_map(self.of_run).collect())
            .collect();
        let names: Vec<String> = planners.iter().map(|p| p.method.short_label()).collect();
        let floor = self.floor.and_then(|floor| {
            let runs = planners.iter().flat_map(|p| p.runs);
            runs.map(floor).find(|floor| *floor > 0.0)
        });
        let all = values.iter().flatten().copied().chain(floor);
        let most = all.clone().fold(0.0, f64::max);
        let incomplete = incomplete(planners, &values);
        // The counts of runs stand above everything else.
        let top = if incomplete.is_empty() {
            most
        } else {
            1.15 * most
        };
        let y = match self.scale {
            FromZero => Axis::linear(self.label, [0.0, top]),
            Count => Axis::linear(self.label, [0.0, top.max(5.0)]),
            Log => Axis::log(self.label, all),
        };
        let at_top = y.range().end;
        let mut chart = Chart::new(format!("({letter}) {}", self.title), Axis::names(&names), y);
        chart.notes = incomplete
            .into_iter()
            .map(|(middle, text)| ((middle, at_top), text))
            .collect();
        chart.margins = Margins {
            bottom: 18.0,
            right: 8.0,
            ..Margins::USUAL
        };
        let shapes = planners
            .iter()
            .zip(&values)
            .zip(0u32..)
            .flat_map(|((p, v), k)| {
                let middle = f64::from(k) + 0.5;
                shapes(v, middle, p.method.colour())
            });
        let end = planners.len() as f64;
        let floor = floor.map(|y| Shape::line(vec![(0.0, y), (end, y)], FLOOR));
        chart.draw(area, floor.into_iter().chain(shapes))
    }
}

/// Where planners stand that have runs without a value, and how many of their runs have one.
fn incomplete(planners: &[RunsOfMethod<'_>], values: &[Vec<f64>]) -> Vec<(f64, String)> {
    let places = (0u32..).map(|k| f64::from(k) + 0.5);
    places
        .zip(planners.iter().zip(values))
        .filter(|(_, (planner, values))| values.len() < planner.runs.len())
        .map(|(x, (planner, values))| (x, format!("{} of {}", values.len(), planner.runs.len())))
        .collect()
}

/// Box, whiskers and runs around a place on the axis.
fn shapes(values: &[f64], middle: f64, colour: Colour) -> Vec<Shape<(f64, f64)>> {
    let Some(q) = Quartiles::of(values) else {
        return Vec::new();
    };
    let half = 0.28;
    let line = Stroke::solid(INK, 0.9);
    let (left, right) = (middle - half, middle + half);
    let level = |y: f64, half: f64| vec![(middle - half, y), (middle + half, y)];
    let whisker = |from: f64, to: f64| Shape::line(vec![(middle, from), (middle, to)], line);
    let corners = vec![
        (left, q.first),
        (right, q.first),
        (right, q.third),
        (left, q.third),
    ];
    let look = Look::Area {
        fill: colour,
        opacity: 0.35,
        edge: Some(Stroke::solid(colour, 1.1)),
    };
    let runs = Look::Dots {
        radius: 1.1,
        fill: Some(INK),
        edge: None,
    };
    let count = values.len().max(2) as f64 - 1.0;
    let spread = |(k, v): (u32, &f64)| (middle + (f64::from(k) / count - 0.5) * half, *v);
    vec![
        whisker(q.low_whisker, q.first),
        whisker(q.third, q.high_whisker),
        Shape::line(level(q.low_whisker, half / 2.0), line),
        Shape::line(level(q.high_whisker, half / 2.0), line),
        Shape::new(corners, look),
        Shape::line(level(q.median, half), Stroke::solid(INK, 1.6)),
        Shape::new((0u32..).zip(values).map(spread).collect(), runs),
    ]
}
