//! Figures 4 and 5: the methods' pose errors and decision times against the step.

use adslam_record::RunHistory;

use crate::axis::Axis;
use crate::chart::Chart;
use crate::error::FigureError;
use crate::figure::{Figure, Frame};
use crate::legend::Entry;
use crate::methods::{below_legend, curve, drift_floor, entries, in_order, last_step, subject};
use crate::shape::{Look, Shape};
use crate::style::{FLOOR, FULL_WIDTH};

/// Pose error, eq. (11), and decision time of each history against the step.
///
/// Beside the pose errors stands the drift floor, the position error that the noise alone must cost on
/// average. Both axes are logarithmic: away from the object the predetermined path's error grows to many
/// times the others'.
///
/// The times are those of the machine: the only numbers here that differ between two runs of the
/// same seed.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn comparison(name: &str, histories: &[&RunHistory]) -> Result<Figure, FigureError> {
    let histories = in_order(histories);
    // The start is known exactly; its error of zero has no place on a logarithmic axis.
    let mut errors: Vec<_> = histories
        .iter()
        .map(|h| {
            curve(h, |step| {
                Some(step.metrics.pose_error).filter(|error| *error > 0.0)
            })
        })
        .collect();
    let mut legend = entries(&histories);
    let mut floors = floors(&histories);
    if !floors.is_empty() {
        legend.push(Entry::new(Look::Line(FLOOR), "drift floor"));
        errors.append(&mut floors);
    }
    let times: Vec<_> = histories
        .iter()
        .map(|h| curve(h, |step| Some(step.decision.as_ref()?.milliseconds)))
        .collect();
    let steps = Axis::steps(last_step(&histories));
    let heights = |lines: &[Shape<(f64, f64)>]| -> Vec<f64> {
        let points = lines.iter().flat_map(|line| &line.points);
        points.map(|point| point.1).collect()
    };
    let error_axis = Axis::log("Pose error (cm, rad)", heights(&errors));
    let time_axis = Axis::log("Decision time (ms)", heights(&times));
    let frame = Frame {
        name,
        title: &format!(
            "Pose error and decision time against step, {}",
            subject(&histories)
        ),
        width: FULL_WIDTH,
        height: 270.0,
    };
    frame.draw(|area| {
        let panels = below_legend(area, &legend, FULL_WIDTH)?;
        let panels = panels.split_evenly((1, 2));
        let charts = [
            (
                Chart::new("(a) Pose error", steps.clone(), error_axis),
                errors,
            ),
            (Chart::new("(b) Decision time", steps, time_axis), times),
        ];
        for (panel, (chart, lines)) in panels.iter().zip(charts) {
            chart.draw(panel, lines)?;
        }
        Ok(())
    })
}

/// The drift floors of histories, one for all runs of a world.
fn floors(histories: &[&RunHistory]) -> Vec<Shape<(f64, f64)>> {
    let mut floors: Vec<Shape<(f64, f64)>> = Vec::new();
    for history in histories {
        let mut floor = drift_floor(history, 1.0);
        floor.points.retain(|point| point.1 > 0.0);
        if !floor.points.is_empty() && !floors.contains(&floor) {
            floors.push(floor);
        }
    }
    floors
}
