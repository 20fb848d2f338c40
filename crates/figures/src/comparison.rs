//! Figures 4 and 5: the methods' pose errors and decision times against the step.

use adslam_experiment::run::RunHistory;

use crate::axis::Axis;
use crate::chart::Chart;
use crate::error::FigureError;
use crate::figure::{Figure, Frame};
use crate::methods::{below_legend, curve, entries, in_order, last_step, subject};
use crate::shape::Shape;
use crate::style::FULL_WIDTH;

/// Pose error, eq. (11), and decision time of each history against the step.
///
/// Both axes are logarithmic: away from the object the predetermined path's error grows to many
/// times the others'.
///
/// The times are those of the machine: the only numbers here that differ between two runs of the
/// same seed.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn comparison(name: &str, histories: &[&RunHistory]) -> Result<Figure, FigureError> {
    let histories = in_order(histories);
    let errors: Vec<_> = histories
        .iter()
        .map(|h| {
            curve(h, |step| {
                Some(step.metrics.pose_error).filter(|error| *error > 0.0)
            })
        })
        .collect();
    let times: Vec<_> = histories
        .iter()
        .map(|h| curve(h, |step| Some(step.decision.as_ref()?.milliseconds)))
        .collect();
    let steps = Axis::steps(last_step(&histories));
    let heights = |lines: &[Shape<(f64, f64)>]| -> Vec<f64> {
        let points = lines.iter().flat_map(|line| &line.points);
        points.map(|point| point.1).collect()
    };
    // The start is known exactly; its error of zero has no place on a logarithmic axis.
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
        let panels = below_legend(area, &entries(&histories), FULL_WIDTH)?;
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
