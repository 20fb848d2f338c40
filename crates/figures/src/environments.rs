//! Figure 1: the objects and their features.

use adslam_record::{DrawnSurface, RunHistory};
use nalgebra::Point3;

use crate::error::FigureError;
use crate::estimates::TRUE_FEATURE;
use crate::figure::{Figure, Frame};
use crate::legend::Entry;
use crate::methods::below_legend;
use crate::scene::{Bounds, Camera, Scene, Solid};
use crate::shape::{Look, Shape};
use crate::style::{AXIS, Colour, FULL_WIDTH, INK, SURFACE, Stroke};

/// The height of a panel, px.
const PANEL: f64 = 270.0;

/// A finer surface is simplified to so many triangles.
const MOST_FACES: usize = 16_000;

/// Objects of up to this many features have them numbered.
const NUMBERED: usize = 20;

/// Two panels for each history: the surface that is drawn, and the features with the surface that
/// they span, which is what hides them from the robot; both at the start, with the robot.
///
/// # Errors
/// [`FigureError::Layout`].
pub fn environments(name: &str, histories: &[&RunHistory]) -> Result<Figure, FigureError> {
    let scenarios: Vec<&str> = histories.iter().map(|h| h.scenario.as_str()).collect();
    let rows = histories.len().max(1);
    let surface = Look::Area {
        fill: SURFACE,
        opacity: 1.0,
        edge: None,
    };
    let legend = [
        Entry::new(surface, "surface"),
        Entry::new(TRUE_FEATURE, "feature"),
        Entry::new(ROBOT, "robot at the start"),
        Entry::new(Look::Line(HEADING), "its viewing direction"),
    ];
    let frame = Frame {
        name,
        title: &format!(
            "The environments and their features: {}",
            scenarios.join(", ")
        ),
        width: FULL_WIDTH,
        height: 24.0 + PANEL * rows as f64,
    };
    frame.draw(|area| {
        let panels = below_legend(area, &legend, FULL_WIDTH)?.split_evenly((rows, 2));
        let scenes = histories.iter().flat_map(|history| scenes(history));
        for ((panel, mut scene), letter) in panels.iter().zip(scenes).zip('a'..) {
            scene.title = format!("({letter}) {}", scene.title);
            scene.draw(panel)?;
        }
        Ok(())
    })
}

/// The surface, and the features.
fn scenes(history: &RunHistory) -> [Scene; 2] {
    let features = history
        .steps
        .first()
        .map_or(Vec::new(), |s| s.true_features());
    let drawn = history.drawn_vertices(0);
    let robot = robot(history);
    let on_show = drawn.iter().chain(&features);
    let on_show = on_show.chain(robot.iter().flat_map(|shape| &shape.points));
    let bounds = Bounds::around(on_show.copied());
    let scene = |title: String, solid: Solid, opacity: f64| Scene {
        title,
        title_colour: INK,
        camera: Camera::new(-58.0, 24.0),
        bounds,
        solid: Some(solid),
        opacity,
        shapes: robot.clone(),
        labels: Vec::new(),
    };
    let name = capitalised(&history.scenario);
    let faces = history.drawn_faces();
    let what = match &history.drawn {
        DrawnSurface::Features => format!("{name}: surface, {} triangles", faces.len()),
        DrawnSurface::Mesh { .. } => format!("{name}: mesh, {} vertices", drawn.len()),
    };
    let surface = scene(what, Solid::new(drawn, faces, MOST_FACES), 0.92);
    let spanned = Solid::new(features.clone(), &history.topology, MOST_FACES);
    let mut points = scene(
        format!("{name}: {} features", features.len()),
        spanned,
        0.55,
    );
    if features.len() <= NUMBERED {
        let numbers = features.iter().enumerate();
        points.labels = numbers.map(|(i, p)| (*p, i.to_string())).collect();
    }
    points.shapes.push(Shape::new(features, TRUE_FEATURE));
    [surface, points]
}

/// The robot and the way that it looks, at the start.
fn robot(history: &RunHistory) -> Vec<Shape<Point3<f64>>> {
    let Some(step) = history.steps.first() else {
        return Vec::new();
    };
    let pose = step.true_pose();
    let ahead = pose.orientation.rotation() * nalgebra::Vector3::x();
    let length = 0.2 * history.sensor_max_cm;
    let line = vec![pose.position, pose.position + ahead * length];
    vec![
        Shape::line(line, HEADING),
        Shape::new(vec![pose.position], ROBOT),
    ]
}

const ROBOT: Look = Look::Dots {
    radius: 3.2,
    fill: Some(Colour(0xff, 0xff, 0xff)),
    edge: Some(Stroke::solid(INK, 1.2)),
};
const HEADING: Stroke = Stroke::solid(AXIS, 1.6);

/// With a capital at the start.
fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}
