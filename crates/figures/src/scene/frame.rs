//! The box around a scene: its back walls with a grid, and its axes with units.

use nalgebra::{Point3, Vector3};
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::camera::{Camera, View};
use crate::axis::bounds;
use crate::error::DrawingError;
use crate::figure::Area;
use crate::shape::{Look, Shape};
use crate::sheet::{text_style, units};
use crate::style::{AXIS, Colour, GRID, INK, SMALL_TEXT, Stroke, TEXT};
use crate::ticks::tick_labels;

const WALL: Colour = Colour(0xf8, 0xf8, 0xf8);

/// Room for the numbers and labels of the axes, px.
const SIDE: f64 = 34.0;
const BELOW: f64 = 26.0;

/// The part of the world that a scene shows, cm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub min: Point3<f64>,
    pub max: Point3<f64>,
}

impl Bounds {
    /// What holds all finite points, with a little room around them.
    pub(crate) fn around(points: impl IntoIterator<Item = Point3<f64>>) -> Self {
        let points: Vec<Point3<f64>> = points.into_iter().collect();
        let range = |axis: usize| bounds(points.iter().map(|p| p[axis]));
        let ranges = [range(0), range(1), range(2)];
        let ranges = ranges.map(|r| if r.start <= r.end { r } else { 0.0..0.0 });
        let size = ranges.iter().map(|r| r.end - r.start).fold(0.0, f64::max);
        let room = if size > 0.0 { 0.03 * size } else { 1.0 };
        let [x, y, z] = ranges;
        Self {
            min: Point3::new(x.start - room, y.start - room, z.start - room),
            max: Point3::new(x.end + room, y.end + room, z.end + room),
        }
    }

    fn corner(&self, at_max: [bool; 3]) -> Point3<f64> {
        let pick = |k: usize| if at_max[k] { self.max[k] } else { self.min[k] };
        Point3::new(pick(0), pick(1), pick(2))
    }

    fn corners(&self) -> impl Iterator<Item = Point3<f64>> {
        (0u8..8).map(|n| self.corner([n & 1 != 0, n & 2 != 0, n & 4 != 0]))
    }

    /// Distance between two ticks: the same on all axes.
    fn ticks(&self) -> [Vec<(f64, String)>; 3] {
        let size = (self.max - self.min).max();
        [0, 1, 2].map(|k| tick_labels(self.min[k]..self.max[k], size / 5.0))
    }
}

/// A view that holds the bounds in a panel of this size (px) below a title.
pub(super) fn view(camera: &Camera, shown: &Bounds, [width, height]: [f64; 2], title: f64) -> View {
    let flat: Vec<[f64; 2]> = shown.corners().map(|p| camera.flat(&p)).collect();
    let [x, y] = [0, 1].map(|k| bounds(flat.iter().map(|p| p[k])));
    let room = [width - 2.0 * SIDE, height - title - BELOW];
    let scale = (room[0] / (x.end - x.start)).min(room[1] / (y.end - y.start));
    let scale = if scale.is_finite() {
        scale.max(0.0)
    } else {
        1.0
    };
    let middle = [(x.start + x.end) / 2.0, (y.start + y.end) / 2.0];
    let origin = [
        width / 2.0 - scale * middle[0],
        title + room[1] / 2.0 + scale * middle[1],
    ];
    View {
        camera: *camera,
        scale,
        origin,
    }
}

/// Draws walls, grid and axes.
pub(super) fn draw(area: &Area<'_>, view: &View, shown: &Bounds) -> Result<(), DrawingError> {
    let toward = view.camera.toward();
    // On each axis the camera looks at the far wall.
    let front = [toward.x > 0.0, toward.y > 0.0, toward.z > 0.0];
    let back = front.map(|at_max| !at_max);
    let ticks = shown.ticks();
    for wall in 0..3 {
        let [a, b] = [(wall + 1) % 3, (wall + 2) % 3];
        let at = |a_max: bool, b_max: bool| {
            let mut corner = back;
            (corner[a], corner[b]) = (a_max, b_max);
            view.place(&shown.corner(corner))
        };
        let corners = vec![
            at(false, false),
            at(true, false),
            at(true, true),
            at(false, true),
        ];
        let look = Look::Area {
            fill: WALL,
            opacity: 1.0,
            edge: Some(Stroke::solid(GRID, 0.8)),
        };
        area.draw(&Shape::new(corners, look))?;
        for (along, across) in [(a, b), (b, a)] {
            for (tick, _) in &ticks[along] {
                let mut from = shown.corner(back);
                from[along] = *tick;
                let mut to = from;
                to[across] = if front[across] { shown.max } else { shown.min }[across];
                let ends = vec![view.place(&from), view.place(&to)];
                area.draw(&Shape::line(ends, Stroke::solid(GRID, 0.6)))?;
            }
        }
    }
    let floor = if front[2] { shown.min.z } else { shown.max.z };
    for (axis, name) in [(0, "x (cm)"), (1, "y (cm)")] {
        let other = 1 - axis;
        let mut start = shown.min;
        start.z = floor;
        start[other] = if front[other] { shown.max } else { shown.min }[other];
        Edge::new(axis, start, shown).draw(area, view, &ticks[axis], name)?;
    }
    // The vertical edge farthest left.
    let sides = [[front[0], back[1], false], [back[0], front[1], false]];
    let starts = sides.map(|side| shown.corner(side));
    let left = |p: &Point3<f64>| view.pixel(p)[0];
    let start = if left(&starts[0]) < left(&starts[1]) {
        starts[0]
    } else {
        starts[1]
    };
    Edge::new(2, start, shown).draw(area, view, &ticks[2], "z (cm)")
}

/// An edge of the box that has the numbers of an axis.
struct Edge {
    axis: usize,
    start: Point3<f64>,
    end: Point3<f64>,
    middle_of_box: Point3<f64>,
}

impl Edge {
    fn new(axis: usize, start: Point3<f64>, shown: &Bounds) -> Self {
        let mut end = start;
        end[axis] = shown.max[axis];
        Self {
            axis,
            start,
            end,
            middle_of_box: nalgebra::center(&shown.min, &shown.max),
        }
    }

    fn draw(
        &self,
        area: &Area<'_>,
        view: &View,
        ticks: &[(f64, String)],
        name: &str,
    ) -> Result<(), DrawingError> {
        let out = self.outward(view);
        let beside = |p: &Point3<f64>, distance: f64| {
            let [x, y] = view.pixel(p);
            (units(x + out[0] * distance), units(y + out[1] * distance))
        };
        let ends = vec![view.place(&self.start), view.place(&self.end)];
        area.draw(&Shape::line(ends, Stroke::solid(AXIS, 0.8)))?;
        // Beside a steep edge numbers stand at its side, below a flat one in the middle.
        let h_pos = if out[0] < -0.8 {
            HPos::Right
        } else if out[0] > 0.8 {
            HPos::Left
        } else {
            HPos::Center
        };
        let style = text_style(SMALL_TEXT, INK).pos(Pos::new(h_pos, VPos::Center));
        let (number, label) = if h_pos_is_center(out) {
            (10.0, 23.0)
        } else {
            (5.0, 24.0)
        };
        for (tick, text) in ticks {
            let mut at = self.start;
            at[self.axis] = *tick;
            let mark = vec![view.place(&at), beside(&at, 2.5)];
            area.draw(&Shape::line(mark, Stroke::solid(AXIS, 0.8)))?;
            area.draw_text(text, &style, beside(&at, number))?;
        }
        let mut style = text_style(TEXT, INK).pos(Pos::new(HPos::Center, VPos::Center));
        if !h_pos_is_center(out) {
            style = style.transform(plotters::style::FontTransform::Rotate270);
        }
        let middle = nalgebra::center(&self.start, &self.end);
        area.draw_text(name, &style, beside(&middle, label))
    }

    /// The direction in the picture, px, square to the edge and away from the box.
    fn outward(&self, view: &View) -> [f64; 2] {
        let flat = |v: &Vector3<f64>| {
            let (camera, up) = (&view.camera, view.camera.up());
            nalgebra::Vector2::new(camera.right().dot(v), -up.dot(v))
        };
        let along = flat(&(self.end - self.start));
        let away = flat(&(nalgebra::center(&self.start, &self.end) - self.middle_of_box));
        let square = nalgebra::Vector2::new(-along.y, along.x);
        let out = square * square.dot(&away).signum();
        out.try_normalize(1e-9).map_or([0.0, 1.0], Into::into)
    }
}

fn h_pos_is_center(out: [f64; 2]) -> bool {
    out[0].abs() <= 0.8
}
