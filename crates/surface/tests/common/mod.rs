//! Shapes and randomness that several test files share.
#![allow(
    dead_code,
    missing_docs,
    clippy::unwrap_used,
    reason = "shared by several test files"
)]

pub mod golden;

use std::sync::Arc;

use adslam_surface::{Mesh, Surface, Topology};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

pub type Point = Point3<f64>;

/// That many cases, and no files of past failures: those become tests of their own.
pub fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

pub fn p(x: f64, y: f64, z: f64) -> Point {
    Point::new(x, y, z)
}

/// The 14 features of the paper's polygon, exact.
pub fn polygon() -> Vec<Point> {
    let mut points = vec![p(0.0, 0.0, 0.0)];
    for z in [1.0, 3.0] {
        let ring = [
            (0.0, -1.0),
            (0.5, -0.5),
            (0.5, 0.5),
            (0.0, 1.0),
            (-0.5, 0.5),
            (-0.5, -0.5),
        ];
        points.extend(ring.map(|(x, y)| p(x, y, z)));
    }
    points.push(p(0.0, 0.0, 4.0));
    points
        .into_iter()
        .map(|q| q + Vector3::new(1.5, 0.0, 0.0))
        .collect()
}

/// The corners of the cube ±1.
pub fn cube() -> Vec<Point> {
    let sign = |bit: u8| f64::from(bit) * 2.0 - 1.0;
    (0..8)
        .map(|i| p(sign(i >> 2 & 1), sign(i >> 1 & 1), sign(i & 1)))
        .collect()
}

/// Nearly evenly spread points on the unit sphere (a Fibonacci spiral).
pub fn sphere(count: usize) -> Vec<Point> {
    let golden_angle = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count)
        .map(|i| {
            let z = 1.0 - (2 * i + 1) as f64 / count as f64;
            let radius = (1.0 - z * z).sqrt();
            let (sin, cos) = (golden_angle * i as f64).sin_cos();
            p(radius * cos, radius * sin, z)
        })
        .collect()
}

/// A star: every second point of a sphere drawn in, so that the surface has dents.
pub fn star(count: usize) -> Surface {
    let round = sphere(count);
    let topology = Arc::new(Topology::convex_hull(&round).unwrap());
    let dented: Vec<Point> = round
        .iter()
        .enumerate()
        .map(|(i, q)| {
            if i % 2 == 0 {
                *q
            } else {
                Point::from(q.coords * 0.4)
            }
        })
        .collect();
    Surface::new(&topology, &dented).unwrap()
}

pub fn hull(points: &[Point]) -> Surface {
    let topology = Arc::new(Topology::convex_hull(points).unwrap());
    Surface::new(&topology, points).unwrap()
}

/// A point with coordinates within ±`reach`.
pub fn point_within(reach: f64) -> impl Strategy<Value = Point> {
    [-reach..reach, -reach..reach, -reach..reach].prop_map(Point::from)
}

/// A point of a coarse integer grid, so that coincidences and common planes are the rule.
pub fn grid_point(reach: i32) -> impl Strategy<Value = Point> {
    let range = -reach..=reach;
    [range.clone(), range.clone(), range]
        .prop_map(|[x, y, z]| p(f64::from(x), f64::from(y), f64::from(z)))
}

/// Distinct grid points that are not on one plane.
pub fn grid_points(reach: i32, count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Point>> {
    let key = |q: &Point| format!("{q:?}");
    prop::collection::vec(grid_point(reach), count).prop_filter_map("flat", move |mut points| {
        points.sort_by_key(key);
        points.dedup();
        Topology::convex_hull(&points).is_ok().then_some(points)
    })
}

/// The generalised winding number by solid angles (van Oosterom and Strackee 1983).
pub fn winding_number(surface: &Surface, q: &Point) -> f64 {
    let solid_angles: f64 = surface
        .topology()
        .faces()
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|i| surface.points()[i] - q);
            let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
            let above = a.dot(&b.cross(&c));
            let below = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
            2.0 * above.atan2(below)
        })
        .sum();
    solid_angles / (4.0 * std::f64::consts::PI)
}

/// The hull of points as a mesh.
pub fn mesh(points: Vec<Point>) -> Mesh {
    let faces = Topology::convex_hull(&points).unwrap().faces().to_vec();
    Mesh {
        vertices: points,
        faces,
    }
}
