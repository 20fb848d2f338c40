//! Consistency: the normalised squared error of the pose against the bounds of χ².

use adslam_record::RunHistory;

use crate::axis::Axis;
use crate::chart::Chart;
use crate::error::FigureError;
use crate::figure::{Figure, Frame};
use crate::legend::Entry;
use crate::method::Method;
use crate::methods::{below_legend, curve, in_order, last_step, subject};
use crate::shape::{Look, Shape};
use crate::style::{AXIS, BAND, FULL_WIDTH, Stroke};

/// Where χ² of 6 degrees of freedom lies with a probability of 95 %, 2.5 % on either side.
pub const CHI_SQUARED_6_BOUNDS: (f64, f64) = (1.237_344, 14.449_375);

/// Its mean.
const DEGREES: f64 = 6.0;

/// The pose NEES of each history against the step, in the band that 95 % of the steps of a
/// consistent filter lie in.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn nees(name: &str, histories: &[&RunHistory]) -> Result<Figure, FigureError> {
    let histories = in_order(histories);
    let (low, high) = CHI_SQUARED_6_BOUNDS;
    let lines: Vec<_> = histories
        .iter()
        .map(|h| curve(h, |step| step.metrics.pose_nees))
        .collect();
    let last = last_step(&histories);
    let steps = Axis::steps(last);
    let values = lines.iter().flat_map(|line| &line.points).map(|p| p.1);
    let axis = Axis::log("Pose NEES (dimensionless)", values.chain([low, high]));
    let band = Look::Area {
        fill: BAND,
        opacity: 0.4,
        edge: None,
    };
    let mean = Look::Line(Stroke::dashed(AXIS, 1.0, (1.5, 2.0)));
    let legend = [
        Entry::new(band, "95 % bounds of χ² with 6 degrees of freedom"),
        Entry::new(mean, "its mean"),
    ];
    let rows = histories.len().div_ceil(2).max(1);
    let frame = Frame {
        name,
        title: &format!(
            "Pose NEES against step with the 95 % bounds of chi-squared, {}",
            subject(&histories)
        ),
        width: FULL_WIDTH,
        height: 40.0 + 190.0 * rows as f64,
    };
    frame.draw(|area| {
        let panels = below_legend(area, &legend, FULL_WIDTH)?.split_evenly((rows, 2));
        let of_methods = histories.iter().zip(lines).zip('a'..);
        for (panel, ((history, line), letter)) in panels.iter().zip(of_methods) {
            let method = Method::of(history);
            let method = method.label();
            let title = format!("({letter}) {method}{}", inside(&line));
            let end = last as f64;
            let corners = vec![(0.0, low), (end, low), (end, high), (0.0, high)];
            let shapes = [
                Shape::new(corners, band),
                Shape::new(vec![(0.0, DEGREES), (end, DEGREES)], mean),
                line,
            ];
            Chart::new(title, steps.clone(), axis.clone()).draw(panel, shapes)?;
        }
        Ok(())
    })
}

/// How much of a line lies between the bounds, in words.
fn inside(line: &Shape<(f64, f64)>) -> String {
    let (low, high) = CHI_SQUARED_6_BOUNDS;
    let count = line.points.len();
    if count == 0 {
        return String::new();
    }
    let inside = line.points.iter().filter(|p| (low..=high).contains(&p.1));
    let share = 100.0 * inside.count() as f64 / count as f64;
    let mean = line.points.iter().map(|p| p.1).sum::<f64>() / count as f64;
    format!(": mean {mean:.1}, {share:.0} % inside")
}
