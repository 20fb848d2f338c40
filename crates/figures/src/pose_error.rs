//! Each component of the pose error with the band that the filter claims for it.

use adslam_names::PlannerName;
use adslam_record::{HistoryStep, RunHistory};
use adslam_simulation::MEAN_NORM_OF_UNIT_GAUSSIAN;

use crate::axis::Axis;
use crate::chart::{Chart, Margins};
use crate::error::FigureError;
use crate::figure::{Figure, Frame};
use crate::legend::Entry;
use crate::method::Method;
use crate::methods::{below_legend, drift_floor, in_order, last_step, numbered, subject};
use crate::shape::{Look, Shape};
use crate::sheet::units;
use crate::style::{AXIS, FLOOR, FULL_WIDTH, Stroke};

/// The components of the pose, in the order of the state.
const COMPONENTS: [&str; 6] = [
    "roll (rad)",
    "pitch (rad)",
    "yaw (rad)",
    "x (cm)",
    "y (cm)",
    "z (cm)",
];

/// The height of a row, px, and of what the last one has more.
const ROW: f64 = 96.0;
const BELOW: f64 = 30.0;

/// The room that numbers and label at an axis take, px.
const NUMBERS: f64 = 44.0;

/// The error of roll, pitch, yaw, x, y and z against the step, estimate less truth, within ±3
/// standard deviations as the filter has them: a row for each, a column for each history. Dotted
/// lines at x, y and z are ±3 standard deviations of the drift floor, which the noise alone must cost.
/// The predetermined path has its own scale.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn pose_error(name: &str, histories: &[&RunHistory]) -> Result<Figure, FigureError> {
    let histories = in_order(histories);
    let steps = Axis::steps(last_step(&histories));
    let mut legend = vec![
        Entry::new(Look::Line(Stroke::solid(AXIS, 1.2)), "estimate − truth"),
        Entry::new(
            band(&Method::new(PlannerName::PREDETERMINED, None)),
            "±3σ of the filter",
        ),
    ];
    if histories.iter().any(|h| !floor(h, 1.0).points.is_empty()) {
        legend.push(Entry::new(Look::Line(FLOOR), "±3σ of the drift floor"));
    }
    let frame = Frame {
        name,
        title: &format!(
            "Pose error with its band of three sigmas, {}",
            subject(&histories)
        ),
        width: FULL_WIDTH,
        height: 46.0 + 6.0 * ROW + BELOW,
    };
    frame.draw(|area| {
        let grid = below_legend(area, &legend, FULL_WIDTH)?;
        let columns = columns(&histories);
        let top = 16.0;
        let lefts = columns.iter().skip(1).map(|column| units(column.left));
        let tops = (1u8..6).map(|row| units(top + ROW * f64::from(row)));
        let panels = grid.split_by_breakpoints(lefts.collect::<Vec<_>>(), tops.collect::<Vec<_>>());
        for (row, label) in COMPONENTS.into_iter().enumerate() {
            for (number, column) in columns.iter().enumerate() {
                let Some(panel) = panels.get(row * columns.len() + number) else {
                    continue;
                };
                let axis = Axis::symmetric(label, extremes(&column.shares_axis_with, row));
                let mut chart = Chart::new("", steps.bare(), axis.bare());
                chart.margins = Margins {
                    top: 4.0,
                    right: 13.0,
                    bottom: 4.0,
                    left: 0.0,
                };
                if row == 0 {
                    let method = Method::of(column.history);
                    method.label().clone_into(&mut chart.title);
                    chart.title_colour = method.line_colour();
                    chart.margins.top += top;
                }
                if row + 1 == COMPONENTS.len() {
                    chart.x = steps.clone();
                    chart.margins.bottom += BELOW;
                }
                if column.has_numbers {
                    chart.y = axis;
                    chart.margins.left += NUMBERS;
                }
                chart.draw(panel, shapes(column.history, row))?;
            }
        }
        Ok(())
    })
}

/// A method's panels, one below the other.
struct Column<'a> {
    history: &'a RunHistory,
    /// Where they begin, px.
    left: f64,
    /// Whether numbers stand at their axes.
    has_numbers: bool,
    /// The histories that are drawn to the same scale.
    shares_axis_with: Vec<&'a RunHistory>,
}

/// The columns from the left. Away from the object the predetermined path's errors are so large
/// that it has a scale of its own.
fn columns<'a>(histories: &[&'a RunHistory]) -> Vec<Column<'a>> {
    let is_apart = |history: &RunHistory| history.planner == PlannerName::PREDETERMINED;
    let has_numbers = |i: usize| i == 0 || is_apart(histories[i]) != is_apart(histories[i - 1]);
    let numbered = (0..histories.len()).filter(|i| has_numbers(*i)).count() as f64;
    let width = (FULL_WIDTH - numbered * NUMBERS) / histories.len().max(1) as f64;
    let mut left = 0.0;
    let column = |(i, &history): (usize, &&'a RunHistory)| {
        let same_scale = |other: &&&RunHistory| is_apart(other) == is_apart(history);
        let column = Column {
            history,
            left,
            has_numbers: has_numbers(i),
            shares_axis_with: histories.iter().filter(same_scale).copied().collect(),
        };
        left += width + if column.has_numbers { NUMBERS } else { 0.0 };
        column
    };
    histories.iter().enumerate().map(column).collect()
}

/// Error and sigma of a component.
fn error(step: &HistoryStep, component: usize) -> (f64, f64) {
    let error = step.estimate().error(&step.true_pose());
    let sigma = step.pose_sigma.get(component);
    (error[component], sigma.copied().unwrap_or(0.0))
}

/// What the axis of a component has to hold.
fn extremes(histories: &[&RunHistory], component: usize) -> Vec<f64> {
    let steps = histories.iter().flat_map(|h| &h.steps);
    let errors = steps
        .map(|step| error(step, component))
        .flat_map(|(error, sigma)| [error, 3.0 * sigma]);
    let floors = histories
        .iter()
        .filter(|_| is_position(component))
        .flat_map(|h| floor(h, 1.0).points)
        .map(|point| point.1);
    errors.chain(floors).collect()
}

/// Whether a component of the pose is one of the position, which alone has a floor.
fn is_position(component: usize) -> bool {
    component >= 3
}

/// Three standard deviations of the drift floor on an axis, above or below zero.
fn floor(history: &RunHistory, sign: f64) -> Shape<(f64, f64)> {
    drift_floor(history, 3.0 * sign / MEAN_NORM_OF_UNIT_GAUSSIAN)
}

fn shapes(history: &RunHistory, component: usize) -> Vec<Shape<(f64, f64)>> {
    let values: Vec<(f64, f64, f64)> = numbered(history)
        .map(|(n, step)| (n, error(step, component)))
        .map(|(n, (error, sigma))| (n, error, 3.0 * sigma))
        .collect();
    let above = values.iter().map(|&(n, _, bound)| (n, bound));
    let below = values.iter().rev().map(|&(n, _, bound)| (n, -bound));
    let line = values.iter().map(|&(n, error, _)| (n, error)).collect();
    let method = Method::of(history);
    let colour = method.line_colour();
    let mut shapes = vec![
        Shape::new(above.chain(below).collect(), band(&method)),
        Shape::line(line, Stroke::solid(colour, 1.0)),
    ];
    if is_position(component) {
        shapes.extend([1.0, -1.0].map(|sign| floor(history, sign)));
    }
    shapes
}

fn band(method: &Method) -> Look {
    Look::Area {
        fill: method.colour(),
        opacity: 0.25,
        edge: None,
    }
}
