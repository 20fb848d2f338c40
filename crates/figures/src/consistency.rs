//! Consistency over many runs: the mean of a squared error or innovation against the interval of χ².

use adslam_experiment::consistency::{
    CHI_SQUARED_CONFIDENCE, ConsistencyCell, ConsistencyResults, Judgement, Measure,
};
use adslam_names::{EstimatorName, PlannerName};

use crate::axis::Axis;
use crate::chart::Chart;
use crate::error::FigureError;
use crate::figure::{Figure, Frame};
use crate::legend::Entry;
use crate::methods::below_legend;
use crate::shape::{Look, Shape};
use crate::style::{AXIS, BAND, Colour, FULL_WIDTH, Stroke, method_name};

/// The line of an estimator: colours of Okabe and Ito that no method has, and other dashes where they lie
/// over each other.
const fn stroke(estimator: EstimatorName) -> Stroke {
    match estimator {
        EstimatorName::EulerEkf => Stroke::solid(Colour(0xe6, 0x9f, 0x00), 1.6),
        EstimatorName::So3Ekf => Stroke::dashed(Colour(0xcc, 0x79, 0xa7), 1.4, (5.0, 2.0)),
        EstimatorName::RightInvariantEkf => {
            Stroke::dashed(Colour(0x00, 0x00, 0x00), 1.2, (1.5, 1.5))
        }
    }
}

/// What an estimator is called in a figure.
const fn name(estimator: EstimatorName) -> &'static str {
    match estimator {
        EstimatorName::EulerEkf => "Euler EKF",
        EstimatorName::So3Ekf => "SO(3) EKF",
        EstimatorName::RightInvariantEkf => "Right-invariant EKF",
    }
}

/// How dark the band is.
const OPACITY: f64 = 0.4;

/// A measure of the experiment `label` against the step: a panel for each planner, in it a line for each
/// estimator, the mean over its runs over the degrees of freedom.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn consistency(
    label: &str,
    measure: Measure,
    results: &ConsistencyResults,
) -> Result<Figure, FigureError> {
    let cells: Vec<(&ConsistencyCell, &Judgement)> = results
        .cells
        .iter()
        .filter(|cell| cell.label == label)
        .filter_map(|cell| Some((cell, cell.judgement(measure)?)))
        .collect();
    let of = |planner: PlannerName| {
        cells
            .iter()
            .filter(move |(cell, _)| cell.planner == planner)
    };
    let planners: Vec<PlannerName> = PlannerName::ALL
        .into_iter()
        .filter(|planner| of(*planner).next().is_some())
        .collect();
    let all_steps = cells.iter().flat_map(|(_, judged)| &judged.steps);
    let last = all_steps.map(|step| step.step).max().unwrap_or(1);
    let steps = Axis::steps(last);
    let band = Look::Area {
        fill: BAND,
        opacity: OPACITY,
        edge: None,
    };
    let one = Look::Line(Stroke::dashed(AXIS, 1.0, (1.5, 2.0)));
    let mut legend: Vec<Entry> = Vec::new();
    for (cell, _) in &cells {
        let entry = Entry::new(Look::Line(stroke(cell.estimator)), name(cell.estimator));
        if legend.iter().all(|known| known.label != entry.label) {
            legend.push(entry);
        }
    }
    let interval = format!(
        "{:.0} % interval of the mean of the runs",
        CHI_SQUARED_CONFIDENCE * 100.0
    );
    legend.push(Entry::new(band, interval));
    let rows = planners.len().div_ceil(2).max(1);
    let key = measure.title().to_lowercase().replace(' ', "-");
    let frame = Frame {
        name: &format!("{label}-{key}"),
        title: &format!(
            "{} over its degrees of freedom against step, mean of {} runs, {label}",
            measure.title(),
            results.runs
        ),
        width: FULL_WIDTH,
        height: 40.0 + 190.0 * rows as f64,
    };
    frame.draw(|area| {
        let panels = below_legend(area, &legend, FULL_WIDTH)?.split_evenly((rows, 2));
        for ((panel, &planner), letter) in panels.iter().zip(&planners).zip('a'..) {
            let mut shapes = Vec::new();
            // How many numbers were measured, and so the band of NIS, differs a little between estimators:
            // together they are as dark as the one in the legend.
            let bands = of(planner).count().max(1) as f64;
            let faint = Look::Area {
                fill: BAND,
                opacity: OPACITY / bands,
                edge: None,
            };
            shapes.extend(of(planner).map(|(_, judged)| Shape::new(band_of(judged), faint)));
            shapes.push(Shape::new(vec![(0.0, 1.0), (last as f64, 1.0)], one));
            for (cell, judged) in of(planner) {
                let points = judged.steps.iter().map(|s| (s.step as f64, s.mean));
                shapes.push(Shape::line(points.collect(), stroke(cell.estimator)));
            }
            // Each panel has its own axis: where one planner loses its way the others would be flat lines.
            let shown = of(planner).flat_map(|(_, judged)| &judged.steps);
            let values = shown.flat_map(|s| [s.mean, s.interval.low, s.interval.high]);
            let axis = Axis::log(&format!("{} / dof", measure.title()), values);
            let title = format!("({letter}) {}", method_name(planner));
            Chart::new(title, steps.clone(), axis).draw(panel, shapes)?;
        }
        Ok(())
    })
}

/// The interval at every step, there and back.
fn band_of(judged: &Judgement) -> Vec<(f64, f64)> {
    let low = judged.steps.iter().map(|s| (s.step as f64, s.interval.low));
    let high = judged
        .steps
        .iter()
        .map(|s| (s.step as f64, s.interval.high));
    low.chain(high.rev()).collect()
}
