//! The surface of the object: shaded, simplified where it is fine, and opaque to what lies behind.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Point3, Vector3};

use super::Placed;
use super::camera::View;
use crate::axis::bounds;
use crate::shape::{Look, Shape};
use crate::style::{Colour, GRID, SURFACE, SURFACE_EDGE, Stroke};

/// Surfaces of up to this many triangles are drawn with their edges.
const FACETED: usize = 200;

/// What is noise off the surface lies on it: so much of the object's size.
const SKIN: f64 = 0.03;

/// A triangle surface.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    vertices: Vec<Point3<f64>>,
    faces: Vec<[usize; 3]>,
}

impl Solid {
    /// Of vertices and anticlockwise triangles, simplified to at most so many of them; triangles
    /// with missing vertices are left out.
    pub(crate) fn new(vertices: Vec<Point3<f64>>, faces: &[[usize; 3]], most: usize) -> Self {
        let exists = |face: &&[usize; 3]| face.iter().all(|&v| v < vertices.len());
        let faces: Vec<[usize; 3]> = faces.iter().filter(exists).copied().collect();
        let full = Self { vertices, faces };
        full.simplified(most)
    }

    /// The same shape with at most so many triangles: vertices that share a cell of a grid become
    /// one, in ever larger cells.
    fn simplified(self, most: usize) -> Self {
        let mut cell = 0.0;
        let mut simpler = self.clone();
        while simpler.faces.len() > most {
            let area: f64 = self.faces.iter().map(|f| self.normal(f).norm() / 2.0).sum();
            cell = if cell > 0.0 {
                cell * 1.15
            } else {
                (area / most as f64).sqrt()
            };
            if !(cell > 0.0 && cell.is_finite()) {
                break;
            }
            simpler = self.clustered(cell);
        }
        simpler
    }

    fn clustered(&self, cell: f64) -> Self {
        #[allow(
            clippy::cast_possible_truncation,
            reason = "a cell's number; beyond all bounds cells merge"
        )]
        let key = |p: &Point3<f64>| [p.x, p.y, p.z].map(|c| (c / cell).floor() as i64);
        let mut numbers: BTreeMap<[i64; 3], usize> = BTreeMap::new();
        let mut sums: Vec<(Vector3<f64>, f64)> = Vec::new();
        let mut number_of = Vec::with_capacity(self.vertices.len());
        for p in &self.vertices {
            let number = *numbers.entry(key(p)).or_insert(sums.len());
            if number == sums.len() {
                sums.push((Vector3::zeros(), 0.0));
            }
            sums[number].0 += p.coords;
            sums[number].1 += 1.0;
            number_of.push(number);
        }
        let mut seen = BTreeSet::new();
        let mut faces = Vec::new();
        for face in &self.faces {
            let [a, b, c] = face.map(|v| number_of[v]);
            let mut corners = [a, b, c];
            corners.sort_unstable();
            if a != b && b != c && c != a && seen.insert(corners) {
                faces.push([a, b, c]);
            }
        }
        let vertices = sums.iter().map(|(sum, n)| Point3::from(sum / *n)).collect();
        Self { vertices, faces }
    }

    fn corners(&self, face: &[usize; 3]) -> [Point3<f64>; 3] {
        face.map(|v| self.vertices[v])
    }

    /// Outward, as long as the triangle's area twice.
    fn normal(&self, face: &[usize; 3]) -> Vector3<f64> {
        let [a, b, c] = self.corners(face);
        (b - a).cross(&(c - a))
    }

    /// For each vertex the mean direction of the surface there.
    fn vertex_normals(&self) -> Vec<Vector3<f64>> {
        let mut normals = vec![Vector3::zeros(); self.vertices.len()];
        for face in &self.faces {
            let normal = self.normal(face);
            for &v in face {
                normals[v] += normal;
            }
        }
        normals
    }

    /// The surface as it is seen.
    pub(super) fn seen_by(&self, view: &View) -> SeenSolid {
        let toward = view.camera.toward();
        let is_faceted = self.faces.len() <= FACETED;
        let normals = self.vertex_normals();
        let mut seen = SeenSolid {
            front: Vec::new(),
            back: Vec::new(),
            is_faceted,
            skin: SKIN * bounds_size(&self.vertices),
        };
        for face in &self.faces {
            let corners = self.corners(face);
            let normal = self.normal(face);
            let smooth: Vector3<f64> = face.iter().map(|&v| normals[v]).sum();
            let facing = if is_faceted { normal } else { smooth };
            let face = SeenFace {
                pixels: corners.map(|p| view.pixel(&p)),
                placed: corners.map(|p| view.place(&p)),
                nearness: corners.map(|p| view.camera.nearness(&p)),
                colour: shaded(&facing, view),
            };
            if normal.dot(&toward) > 0.0 {
                seen.front.push(face);
            } else {
                seen.back.push(face);
            }
        }
        // The far ones first.
        let depth = |face: &SeenFace| face.nearness.iter().sum::<f64>();
        seen.front.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
        seen
    }
}

/// The largest extent along an axis, cm.
fn bounds_size(points: &[Point3<f64>]) -> f64 {
    let extent = |axis: usize| {
        let range = bounds(points.iter().map(|p| p[axis]));
        (range.end - range.start).max(0.0)
    };
    extent(0).max(extent(1)).max(extent(2))
}

/// The surface's colour where it faces this way, lit from the camera's upper left.
fn shaded(normal: &Vector3<f64>, view: &View) -> Colour {
    let camera = &view.camera;
    let light = camera.toward() * 0.75 + camera.up() * 0.55 - camera.right() * 0.35;
    let lit = match (normal.try_normalize(1e-12), light.try_normalize(1e-12)) {
        (Some(normal), Some(light)) => normal.dot(&light).max(0.0),
        _ => 0.5,
    };
    let brightness = 0.62 + 0.44 * lit;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to a byte"
    )]
    let shade = |c: u8| (f64::from(c) * brightness).round().clamp(0.0, 255.0) as u8;
    Colour(shade(SURFACE.0), shade(SURFACE.1), shade(SURFACE.2))
}

/// A surface in a view.
#[derive(Clone, Debug)]
pub(super) struct SeenSolid {
    front: Vec<SeenFace>,
    back: Vec<SeenFace>,
    is_faceted: bool,
    /// How far below the surface something still counts as lying on it, cm.
    skin: f64,
}

#[derive(Clone, Debug)]
struct SeenFace {
    pixels: [[f64; 2]; 3],
    placed: [Placed; 3],
    nearness: [f64; 3],
    colour: Colour,
}

impl SeenSolid {
    /// The triangles that face the camera, far ones first.
    pub(super) fn faces(&self) -> Vec<Shape<Placed>> {
        let shape = |face: &SeenFace| {
            // Without a stroke the paper would shine through between two triangles.
            let edge = if self.is_faceted {
                Stroke::solid(SURFACE_EDGE, 0.8)
            } else {
                Stroke::solid(face.colour, 0.5)
            };
            let look = Look::Area {
                fill: face.colour,
                opacity: 1.0,
                edge: Some(edge),
            };
            Shape::new(face.placed.to_vec(), look)
        };
        self.front.iter().map(shape).collect()
    }

    /// The edges on the far side, where edges are drawn at all.
    pub(super) fn edges_behind(&self) -> Vec<Shape<Placed>> {
        if !self.is_faceted {
            return Vec::new();
        }
        let outline = |face: &SeenFace| {
            let [a, b, c] = face.placed;
            Shape::line(vec![a, b, c, a], Stroke::solid(GRID, 0.6))
        };
        self.back.iter().map(outline).collect()
    }

    /// Whether a point lies behind the surface.
    pub(super) fn hides(&self, view: &View, p: &Point3<f64>) -> bool {
        let (pixel, nearness) = (view.pixel(p), view.camera.nearness(p));
        let behind = |surface: f64| surface > nearness + self.skin;
        self.front
            .iter()
            .any(|face| face.nearness_at(pixel).is_some_and(behind))
    }
}

impl SeenFace {
    /// How near the triangle is where it covers a pixel.
    fn nearness_at(&self, [x, y]: [f64; 2]) -> Option<f64> {
        let [[ax, ay], [bx, by], [cx, cy]] = self.pixels;
        let within = |a: f64, b: f64, c: f64, v: f64| v >= a.min(b).min(c) && v <= a.max(b).max(c);
        if !(within(ax, bx, cx, x) && within(ay, by, cy, y)) {
            return None;
        }
        let double_area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
        if double_area.abs() < 1e-12 {
            return None;
        }
        let b = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / double_area;
        let c = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / double_area;
        let a = 1.0 - b - c;
        let [na, nb, nc] = self.nearness;
        (a >= 0.0 && b >= 0.0 && c >= 0.0).then_some(a * na + b * nb + c * nc)
    }
}
