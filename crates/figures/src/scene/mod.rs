//! A picture of three dimensions: orthographic, equal axes, a translucent surface that hides what
//! lies behind it.

mod camera;
mod frame;
mod solid;

use nalgebra::{Matrix3, Point3, SymmetricEigen, Vector3};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters_backend::BackendCoord;

use crate::error::DrawingError;
use crate::figure::Area;
use crate::shape::{Group, Look, Shape};
use crate::sheet::{px, text_style, units};
use crate::style::{Colour, INK, SMALL_TEXT, TEXT};

pub(crate) use camera::Camera;
pub(crate) use frame::Bounds;
pub(crate) use solid::Solid;

/// Above the box, px.
const TITLE: f64 = 18.0;

/// What is drawn in one panel.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    pub title: String,
    pub title_colour: Colour,
    pub camera: Camera,
    pub bounds: Bounds,
    pub solid: Option<Solid>,
    /// How much of what lies behind the surface it hides.
    pub opacity: f64,
    /// Drawn in this order, those that the surface hides before it, the others after it.
    pub shapes: Vec<Shape<Point3<f64>>>,
    /// Texts beside points.
    pub labels: Vec<(Point3<f64>, String)>,
}

impl Scene {
    pub(crate) fn draw(&self, area: &Area<'_>) -> Result<(), DrawingError> {
        let (width, height) = area.dim_in_pixel();
        let size = [width, height].map(|n| px(i32::try_from(n).unwrap_or(i32::MAX)));
        let view = frame::view(&self.camera, &self.bounds, size, TITLE);
        frame::draw(area, &view, &self.bounds)?;
        let solid = self.solid.as_ref().map(|solid| solid.seen_by(&view));
        let is_hidden = |p: &Point3<f64>| solid.as_ref().is_some_and(|s| s.hides(&view, p));
        let (mut hidden, mut shown) = (Vec::new(), Vec::new());
        for shape in &self.shapes {
            for (part, behind) in parts(shape, &is_hidden) {
                let place = |p: &Point3<f64>| view.place(p);
                let placed = Shape::new(part.iter().map(place).collect(), shape.look);
                if behind { &mut hidden } else { &mut shown }.push(placed);
            }
        }
        for shape in hidden {
            area.draw(&shape)?;
        }
        if let Some(solid) = &solid {
            for shape in solid.edges_behind() {
                area.draw(&shape)?;
            }
            area.draw(&Group::new(solid.faces(), self.opacity))?;
        }
        for shape in shown {
            area.draw(&shape)?;
        }
        for (at, text) in &self.labels {
            let (x, y) = view.place(at);
            let style = text_style(SMALL_TEXT, INK).pos(Pos::new(HPos::Left, VPos::Bottom));
            area.draw_text(text, &style, (x + units(3.0), y - units(1.0)))?;
        }
        let style = text_style(TEXT, self.title_colour).pos(Pos::new(HPos::Left, VPos::Top));
        area.draw_text(&self.title, &style, (units(8.0), units(3.0)))
    }
}

/// Longest piece of a line, as a share of its length in points, that is tested as a whole.
const PIECES: u8 = 4;

/// A shape in the parts that are hidden (true) and those that are not.
fn parts(
    shape: &Shape<Point3<f64>>,
    is_hidden: &impl Fn(&Point3<f64>) -> bool,
) -> Vec<(Vec<Point3<f64>>, bool)> {
    let points = &shape.points;
    match shape.look {
        Look::Line(_) => {
            let mut runs: Vec<(Vec<Point3<f64>>, bool)> = Vec::new();
            for pair in points.windows(2) {
                for k in 0..PIECES {
                    let at =
                        |k: u8| pair[0] + (pair[1] - pair[0]) * (f64::from(k) / f64::from(PIECES));
                    let (from, to) = (at(k), at(k + 1));
                    let behind = is_hidden(&nalgebra::center(&from, &to));
                    match runs.last_mut() {
                        Some((run, same)) if *same == behind => run.push(to),
                        _ => runs.push((vec![from, to], behind)),
                    }
                }
            }
            runs
        }
        Look::Area { .. } => {
            let sum: Vector3<f64> = points.iter().map(|p| p.coords).sum();
            let middle = Point3::from(sum / points.len().max(1) as f64);
            vec![(points.clone(), is_hidden(&middle))]
        }
        Look::Dots { .. } | Look::Crosses { .. } => {
            points.iter().map(|p| (vec![*p], is_hidden(p))).collect()
        }
    }
}

/// The outline that an ellipsoid of so many sigmas shows to the camera: that of its projection.
pub(crate) fn ellipsoid_outline(
    camera: &Camera,
    centre: &Point3<f64>,
    covariance: &Matrix3<f64>,
    sigmas: f64,
) -> Vec<Point3<f64>> {
    const CORNERS: u8 = 36;
    let (right, up) = (camera.right(), camera.up());
    let plane = nalgebra::Matrix2::new(
        right.dot(&(covariance * right)),
        right.dot(&(covariance * up)),
        up.dot(&(covariance * right)),
        up.dot(&(covariance * up)),
    );
    if !plane.iter().all(|x| x.is_finite()) {
        return Vec::new();
    }
    let eigen = SymmetricEigen::new(plane);
    let radii = eigen.eigenvalues.map(|v| sigmas * v.max(0.0).sqrt());
    let corner = |k: u8| {
        let angle = f64::from(k) / f64::from(CORNERS) * std::f64::consts::TAU;
        let round = nalgebra::Vector2::new(radii.x * angle.cos(), radii.y * angle.sin());
        let flat = eigen.eigenvectors * round;
        centre + right * flat.x + up * flat.y
    };
    (0..CORNERS).map(corner).collect()
}

/// A point of a view.
type Placed = BackendCoord;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::Stroke;

    #[test]
    fn an_ellipsoid_shows_its_projection() {
        let camera = Camera::new(0.0, 0.0);
        let covariance = Matrix3::from_diagonal(&Vector3::new(100.0, 4.0, 0.25));
        let outline = ellipsoid_outline(&camera, &Point3::origin(), &covariance, 3.0);
        let most = |axis: usize| outline.iter().map(|p| p[axis]).fold(0.0, f64::max);
        assert!(most(0) < 1e-9, "seen along x");
        assert!((most(1) - 6.0).abs() < 0.1 && (most(2) - 1.5).abs() < 0.1);
        let wrong = Matrix3::repeat(f64::NAN);
        assert!(ellipsoid_outline(&camera, &Point3::origin(), &wrong, 3.0).is_empty());
    }

    #[test]
    fn lines_are_cut_where_they_go_behind_the_surface() {
        let points = vec![Point3::new(-1.0, 0.0, 0.0), Point3::new(1.0, 0.0, 0.0)];
        let line = Shape::line(points, Stroke::solid(INK, 1.0));
        let cut = parts(&line, &|p: &Point3<f64>| p.x > 0.0);
        let hidden: Vec<bool> = cut.iter().map(|part| part.1).collect();
        assert_eq!(hidden, [false, true]);
        assert_eq!(cut[0].0.last(), cut[1].0.first(), "no gap");
    }
}
