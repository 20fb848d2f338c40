//! How much of the object has been seen, against the step.

use adslam_record::RunHistory;

use crate::axis::Axis;
use crate::chart::Chart;
use crate::error::FigureError;
use crate::figure::{Figure, Frame};
use crate::legend::Entry;
use crate::method::Method;
use crate::methods::{below_legend, curve, entries, in_order, last_step, numbered, subject};
use crate::shape::{Look, Shape};
use crate::style::{AXIS, Colour, FULL_WIDTH, Stroke};

/// The share of the features seen at least once, with a ring where it reaches all of them, and
/// the observed feature times so far.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn coverage(name: &str, histories: &[&RunHistory]) -> Result<Figure, FigureError> {
    let histories = in_order(histories);
    let mut shares = Vec::new();
    let mut totals = Vec::new();
    for history in &histories {
        let all = history.feature_count().max(1) as f64;
        let share = curve(history, |step| {
            Some(100.0 * step.metrics.covered as f64 / all)
        });
        let complete = share.points.iter().find(|point| point.1 >= 100.0);
        let complete =
            complete.map(|point| Shape::new(vec![*point], ring(Method::of(history).colour())));
        shares.push(share);
        shares.extend(complete);
        totals.push(observed(history));
    }
    let most = totals.iter().flat_map(|line| line.points.last());
    let most: Vec<f64> = most.map(|point| point.1).chain([0.0]).collect();
    let steps = Axis::steps(last_step(&histories));
    let frame = Frame {
        name,
        title: &format!("Coverage against step, {}", subject(&histories)),
        width: FULL_WIDTH,
        height: 270.0,
    };
    frame.draw(|area| {
        let mut legend = entries(&histories);
        legend.push(Entry::new(ring(AXIS), "all features seen"));
        let panels = below_legend(area, &legend, FULL_WIDTH)?.split_evenly((1, 2));
        let charts = [
            (
                Chart::new(
                    "(a) Features seen at least once",
                    steps.clone(),
                    Axis::linear("Features seen (%)", [0.0, 100.0]),
                ),
                shares,
            ),
            (
                Chart::new(
                    "(b) Observed feature times",
                    steps,
                    Axis::linear("Observed feature times (count)", most),
                ),
                totals,
            ),
        ];
        for (panel, (chart, lines)) in panels.iter().zip(charts) {
            chart.draw(panel, lines)?;
        }
        Ok(())
    })
}

/// Visible features summed over the steps after the first, up to each step.
fn observed(history: &RunHistory) -> Shape<(f64, f64)> {
    let mut total = 0.0;
    let points = numbered(history).map(|(n, step)| {
        if n > 1.0 {
            total += step.visible.len() as f64;
        }
        (n, total)
    });
    Shape::line(points.collect(), Method::of(history).stroke())
}

fn ring(colour: Colour) -> Look {
    Look::Dots {
        radius: 3.6,
        fill: Some(Colour(0xff, 0xff, 0xff)),
        edge: Some(Stroke::solid(colour, 1.4)),
    }
}
