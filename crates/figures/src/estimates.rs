//! Figures 2 and 3: where each method believes the robot and the features to be, and where they are.

use adslam_names::PlannerName;
use adslam_record::{HistoryStep, RunHistory};
use nalgebra::{Point3, Vector3};

use crate::error::FigureError;
use crate::figure::{Figure, Frame};
use crate::legend::Entry;
use crate::method::Method;
use crate::methods::{below_legend, in_order, subject};
use crate::scene::{Bounds, Camera, Scene, Solid, ellipsoid_outline};
use crate::shape::{Look, Shape};
use crate::style::{AXIS, Colour, FULL_WIDTH, INK, SURFACE, Stroke};

/// How large covariance ellipsoids are drawn.
const SIGMAS: f64 = 3.0;

/// A finer surface is simplified to so many triangles: four of them make a file of 1 MB.
const MOST_FACES: usize = 5000;

/// Objects of more features than this have smaller marks.
const FEW_FEATURES: usize = 20;

/// The height of a panel, px.
const PANEL: f64 = 300.0;

/// A panel for each history: the true and the estimated path, the true and the estimated features
/// with their ellipsoids of three sigmas, and the surface, the latter three at the last step. All
/// panels show the same part of the world from the same side.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn estimates(name: &str, histories: &[&RunHistory]) -> Result<Figure, FigureError> {
    let histories = in_order(histories);
    let camera = Camera::new(-58.0, 24.0);
    let part = Part::of(&histories);
    let bounds = Bounds::around(histories.iter().flat_map(|h| part.extent(h)));
    let rows = histories.len().div_ceil(2).max(1);
    let frame = Frame {
        name,
        title: &format!(
            "True and estimated path and features of each method, {}",
            subject(&histories)
        ),
        width: FULL_WIDTH,
        height: 40.0 + PANEL * rows as f64,
    };
    frame.draw(|area| {
        let panels = below_legend(area, &legend(), FULL_WIDTH)?.split_evenly((rows, 2));
        for ((panel, history), letter) in panels.iter().zip(&histories).zip('a'..) {
            let method = Method::of(history);
            let method = method.label();
            let left = part.left_at(history);
            let note = left.map(|step| format!(" (leaves the picture at step {step})"));
            let scene = Scene {
                title: format!("({letter}) {method}{}", note.unwrap_or_default()),
                title_colour: INK,
                camera,
                bounds,
                solid: solid(history),
                opacity: 0.6,
                shapes: shapes(history, &part, &camera),
                labels: Vec::new(),
            };
            scene.draw(panel)?;
        }
        Ok(())
    })
}

/// The surface as it is at the last step.
fn solid(history: &RunHistory) -> Option<Solid> {
    let last = history.steps.len().checked_sub(1)?;
    let vertices = history.drawn_vertices(last);
    Some(Solid::new(vertices, history.drawn_faces(), MOST_FACES))
}

/// The part of the world that a figure shows: a ball around the object. The predetermined path,
/// which goes on and on past the object, is cut where it leaves the ball for good.
struct Part {
    centre: Point3<f64>,
    radius: f64,
}

impl Part {
    /// What the planned paths and the object take up, and a quarter more; everything where there
    /// are no planned paths.
    fn of(histories: &[&RunHistory]) -> Self {
        let object: Vec<Point3<f64>> = histories.first().map_or(Vec::new(), |h| object(h));
        let sum: Vector3<f64> = object.iter().map(|p| p.coords).sum();
        let centre = Point3::from(sum / object.len().max(1) as f64);
        let planned: Vec<&&RunHistory> = histories
            .iter()
            .filter(|h| h.planner != PlannerName::PREDETERMINED)
            .collect();
        let positions = planned.iter().flat_map(|h| positions(h));
        let distances = positions.chain(object).map(|p| (p - centre).norm());
        let radius = if planned.is_empty() {
            f64::INFINITY
        } else {
            1.25 * distances.fold(0.0, f64::max)
        };
        Self { centre, radius }
    }

    /// The first step from which on a path stays outside, if there is one.
    fn left_at(&self, history: &RunHistory) -> Option<usize> {
        let inside = |step: &HistoryStep| {
            let positions = [step.true_pose().position, step.estimate().position];
            positions
                .iter()
                .all(|p| (p - self.centre).norm() <= self.radius)
        };
        // The steps count from 1, so the one after the last inside is two past its index.
        let first_outside = history.steps.iter().rposition(inside).map_or(1, |i| i + 2);
        (first_outside <= history.steps.len()).then_some(first_outside)
    }

    /// The steps whose positions are drawn.
    fn steps<'a>(&self, history: &'a RunHistory) -> &'a [HistoryStep] {
        let all = &history.steps;
        let count = self.left_at(history).map_or(all.len(), |step| step - 1);
        all.get(..count).unwrap_or(all)
    }

    /// All that has to be in the picture.
    fn extent(&self, history: &RunHistory) -> Vec<Point3<f64>> {
        let mut points = object(history);
        for step in self.steps(history) {
            points.extend([step.true_pose().position, step.estimate().position]);
        }
        points
    }
}

/// The object at the last step.
fn object(history: &RunHistory) -> Vec<Point3<f64>> {
    let last = history.steps.len().saturating_sub(1);
    let mut points = history.drawn_vertices(last);
    points.extend(
        history
            .steps
            .last()
            .map(HistoryStep::true_features)
            .into_iter()
            .flatten(),
    );
    points
}

/// Where the robot was.
fn positions(history: &RunHistory) -> impl Iterator<Item = Point3<f64>> {
    history.steps.iter().map(|step| step.true_pose().position)
}

/// Paths, ellipsoids and features, what covers least on top.
fn shapes(history: &RunHistory, part: &Part, camera: &Camera) -> Vec<Shape<Point3<f64>>> {
    let colour = Method::of(history).colour();
    let steps = part.steps(history);
    let truth: Vec<Point3<f64>> = steps.iter().map(|step| step.true_pose().position).collect();
    let estimate = steps.iter().map(|step| step.estimate().position).collect();
    let is_whole = steps.len() == history.steps.len();
    let ends = [truth.first(), truth.last().filter(|_| is_whole)];
    let [start, end] = ends.map(|p| p.copied().into_iter().collect());
    let mut shapes = vec![
        Shape::line(truth, TRUE_PATH),
        Shape::line(estimate, estimated_path(colour)),
    ];
    if let Some(step) = history.steps.last() {
        let estimated = step.estimated_features.iter().map(|p| Point3::from(*p));
        let estimated: Vec<Point3<f64>> = estimated.collect();
        for (i, centre) in estimated.iter().enumerate() {
            if let Some(covariance) = step.feature_covariance(i) {
                let outline = ellipsoid_outline(camera, centre, &covariance, SIGMAS);
                shapes.push(Shape::new(outline, ellipsoid(colour)));
            }
        }
        let (dot, cross) = if estimated.len() > FEW_FEATURES {
            (SMALL_TRUE_FEATURE, estimated_feature(colour, 2.2, 0.9))
        } else {
            (TRUE_FEATURE, estimated_feature(colour, 3.2, 1.2))
        };
        shapes.push(Shape::new(step.true_features(), dot));
        shapes.push(Shape::new(estimated, cross));
    }
    shapes.push(Shape::new(start, START));
    shapes.push(Shape::new(end, END));
    shapes
}

const TRUE_PATH: Stroke = Stroke::solid(INK, 0.9);
const START: Look = Look::Dots {
    radius: 3.2,
    fill: Some(Colour(0xff, 0xff, 0xff)),
    edge: Some(Stroke::solid(INK, 1.2)),
};
const END: Look = Look::Dots {
    radius: 3.2,
    fill: Some(INK),
    edge: None,
};
pub(crate) const TRUE_FEATURE: Look = Look::Dots {
    radius: 1.7,
    fill: Some(INK),
    edge: None,
};

const SMALL_TRUE_FEATURE: Look = Look::Dots {
    radius: 1.1,
    fill: Some(INK),
    edge: None,
};

const fn estimated_path(colour: Colour) -> Stroke {
    Stroke::dashed(colour, 1.4, (3.5, 2.0))
}

const fn estimated_feature(colour: Colour, arm: f64, width: f64) -> Look {
    let stroke = Stroke::solid(colour, width);
    Look::Crosses { arm, stroke }
}

const fn ellipsoid(colour: Colour) -> Look {
    Look::Area {
        fill: colour,
        opacity: 0.25,
        edge: Some(Stroke::solid(colour, 0.6)),
    }
}

fn legend() -> Vec<Entry> {
    let surface = Look::Area {
        fill: SURFACE,
        opacity: 0.8,
        edge: None,
    };
    // What is estimated has the colour of its method.
    vec![
        Entry::new(Look::Line(TRUE_PATH), "true path"),
        Entry::new(Look::Line(estimated_path(AXIS)), "estimated path"),
        Entry::new(START, "start"),
        Entry::new(END, "end"),
        Entry::new(surface, "surface"),
        Entry::new(TRUE_FEATURE, "true feature"),
        Entry::new(estimated_feature(AXIS, 3.2, 1.2), "estimated feature"),
        Entry::new(ellipsoid(AXIS), "its 3σ ellipsoid"),
    ]
}
