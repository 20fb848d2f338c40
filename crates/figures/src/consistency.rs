//! Consistency over many runs: the mean of a squared error or innovation against the interval of χ².

use adslam_names::{EstimatorName, Look as EstimatorLook};

use crate::axis::Axis;
use crate::chart::Chart;
use crate::error::FigureError;
use crate::figure::{Figure, Frame};
use crate::legend::Entry;
use crate::method::Method;
use crate::methods::below_legend;
use crate::shape::{Look, Shape};
use crate::style::{AXIS, BAND, Colour, FULL_WIDTH, Stroke};

/// The line of an estimator, with dashes where ours lie over each other.
fn stroke(curve: &ConsistencyCurve) -> Stroke {
    let [red, green, blue] = curve.estimator_look.colour;
    let colour = Colour(red, green, blue);
    match curve.estimator {
        EstimatorName::SO3_EKF => Stroke::dashed(colour, 1.4, (5.0, 2.0)),
        EstimatorName::RIGHT_INVARIANT_EKF => Stroke::dashed(colour, 1.2, (1.5, 1.5)),
        _ => Stroke::solid(colour, 1.6),
    }
}

/// How dark the band is.
const OPACITY: f64 = 0.4;

/// A squared error or innovation over many runs, each over its degrees of freedom.
#[derive(Clone, Debug)]
pub struct ConsistencyCurves<'a> {
    /// What it is called, such as `Pose NEES`.
    pub measure: &'a str,
    /// The environment.
    pub label: &'a str,
    /// How many runs each curve is of.
    pub runs: usize,
    /// The probability with which a consistent filter stays within the band.
    pub confidence: f64,
    /// The curves.
    pub curves: Vec<ConsistencyCurve>,
}

/// The mean over the runs of one planner and estimator.
#[derive(Clone, Debug)]
pub struct ConsistencyCurve {
    /// The planner.
    pub method: Method,
    /// The estimator.
    pub estimator: EstimatorName,
    /// What it looks like.
    pub estimator_look: EstimatorLook,
    /// The steps that have one.
    pub steps: Vec<BandedMean>,
}

/// A mean and the band within which that of a consistent filter lies.
#[derive(Clone, Copy, Debug)]
pub struct BandedMean {
    /// The step.
    pub step: usize,
    /// The mean over the runs.
    pub mean: f64,
    /// The lower end of the band.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

/// A measure against the step: a panel for each planner, in it a line for each estimator.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn consistency(of_runs: &ConsistencyCurves<'_>) -> Result<Figure, FigureError> {
    let ConsistencyCurves {
        measure,
        label,
        runs,
        confidence,
        curves,
    } = of_runs;
    let mut methods: Vec<&Method> = curves.iter().map(|curve| &curve.method).collect();
    methods.sort_by_key(|method| method.name());
    methods.dedup();
    let of = |method: &Method| {
        let method = method.clone();
        curves.iter().filter(move |curve| curve.method == method)
    };
    let all_steps = curves.iter().flat_map(|curve| &curve.steps);
    let last = all_steps.map(|step| step.step).max().unwrap_or(1);
    let steps = Axis::steps(last);
    let band = Look::Area {
        fill: BAND,
        opacity: OPACITY,
        edge: None,
    };
    let one = Look::Line(Stroke::dashed(AXIS, 1.0, (1.5, 2.0)));
    let mut legend: Vec<Entry> = Vec::new();
    for curve in curves {
        let entry = Entry::new(Look::Line(stroke(curve)), &*curve.estimator_look.label);
        if legend.iter().all(|known| known.label != entry.label) {
            legend.push(entry);
        }
    }
    let interval = format!(
        "{:.0} % interval of the mean of the runs",
        confidence * 100.0
    );
    legend.push(Entry::new(band, interval));
    let rows = methods.len().div_ceil(2).max(1);
    let key = measure.to_lowercase().replace(' ', "-");
    let frame = Frame {
        name: &format!("{label}-{key}"),
        title: &format!(
            "{measure} over its degrees of freedom against step, mean of {runs} runs, {label}",
        ),
        width: FULL_WIDTH,
        height: 40.0 + 190.0 * rows as f64,
    };
    frame.draw(|area| {
        let panels = below_legend(area, &legend, FULL_WIDTH)?.split_evenly((rows, 2));
        for ((panel, &method), letter) in panels.iter().zip(&methods).zip('a'..) {
            let mut shapes = Vec::new();
            // How many numbers were measured, and so the band of NIS, differs a little between estimators:
            // together they are as dark as the one in the legend.
            let bands = of(method).count().max(1) as f64;
            let faint = Look::Area {
                fill: BAND,
                opacity: OPACITY / bands,
                edge: None,
            };
            shapes.extend(of(method).map(|curve| Shape::new(band_of(curve), faint)));
            shapes.push(Shape::new(vec![(0.0, 1.0), (last as f64, 1.0)], one));
            for curve in of(method) {
                let points = curve.steps.iter().map(|s| (s.step as f64, s.mean));
                shapes.push(Shape::line(points.collect(), stroke(curve)));
            }
            // Each panel has its own axis: where one planner loses its way the others would be flat lines.
            let shown = of(method).flat_map(|curve| &curve.steps);
            let values = shown.flat_map(|s| [s.mean, s.low, s.high]);
            let axis = Axis::log(&format!("{measure} / dof"), values);
            let title = format!("({letter}) {}", method.label());
            Chart::new(title, steps.clone(), axis).draw(panel, shapes)?;
        }
        Ok(())
    })
}

/// The interval at every step, there and back.
fn band_of(curve: &ConsistencyCurve) -> Vec<(f64, f64)> {
    let low = curve.steps.iter().map(|s| (s.step as f64, s.low));
    let high = curve.steps.iter().map(|s| (s.step as f64, s.high));
    low.chain(high.rev()).collect()
}
