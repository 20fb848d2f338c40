//! The heart phantom: closed, one piece, no handles, in its box, far enough from the robot.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a failed helper is a failed test"
)]

mod common;

use std::sync::Arc;

use adslam_surface::{
    DEFAULT_PHANTOM_SPACING_CM, Mesh, Surface, SurfaceError, Topology, heart_phantom, pick_features,
};
use common::Point;

/// V − E + F: 2 for a sphere, 2 less for every handle, 2 more for every further piece.
fn euler_characteristic(mesh: &Mesh) -> i64 {
    let count = |n: usize| i64::try_from(n).unwrap();
    count(mesh.vertices.len()) - count(mesh.faces.len() * 3 / 2) + count(mesh.faces.len())
}

/// How many vertices can be reached over edges from the first one.
fn reachable(mesh: &Mesh) -> usize {
    let topology = Topology::from_faces(&mesh.vertices, &mesh.faces).unwrap();
    let mut seen = vec![false; mesh.vertices.len()];
    let mut next = vec![0];
    let mut count = 0;
    while let Some(vertex) = next.pop() {
        if !std::mem::replace(&mut seen[vertex], true) {
            count += 1;
            next.extend(
                topology
                    .faces_at(vertex)
                    .iter()
                    .flat_map(|&f| topology.faces()[f]),
            );
        }
    }
    count
}

fn least_angle_deg(mesh: &Mesh) -> f64 {
    let mut least = f64::INFINITY;
    for face in &mesh.faces {
        for k in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|i| mesh.vertices[face[(k + i) % 3]]);
            least = least.min((b - a).angle(&(c - a)).to_degrees());
        }
    }
    least
}

#[test]
fn is_one_closed_piece_without_handles_or_slivers_at_every_spacing() {
    for spacing in [0.2, 0.3, 0.35, 0.4, 0.5, 0.55, 0.6] {
        let mesh = heart_phantom(spacing).unwrap();
        mesh.check_closed().unwrap();
        assert_eq!(euler_characteristic(&mesh), 2, "spacing {spacing}");
        assert_eq!(reachable(&mesh), mesh.vertices.len(), "spacing {spacing}");
        let angle = least_angle_deg(&mesh);
        assert!(angle > 2.0, "spacing {spacing}: an angle of {angle}°");
        assert!(
            (650.0..900.0).contains(&mesh.volume()),
            "{} cm³",
            mesh.volume()
        );
    }
}

#[test]
fn has_thousands_of_vertices_by_default_and_is_always_the_same() {
    let mesh = heart_phantom(DEFAULT_PHANTOM_SPACING_CM).unwrap();
    assert!(
        (4000..10_000).contains(&mesh.vertices.len()),
        "{}",
        mesh.vertices.len()
    );
    assert_eq!(mesh, heart_phantom(DEFAULT_PHANTOM_SPACING_CM).unwrap());
}

#[test]
fn fills_its_box_with_the_apex_low_and_the_vessels_high() {
    let mesh = heart_phantom(DEFAULT_PHANTOM_SPACING_CM).unwrap();
    let (low, high) = mesh.bounds().unwrap();
    approx::assert_abs_diff_eq!(low, Point::new(1.0, -6.0, 1.0), epsilon = 1e-12);
    approx::assert_abs_diff_eq!(high, Point::new(15.0, 6.0, 15.0), epsilon = 1e-12);
    let lowest = mesh
        .vertices
        .iter()
        .min_by(|a, b| a.z.total_cmp(&b.z))
        .unwrap();
    let highest = mesh
        .vertices
        .iter()
        .max_by(|a, b| a.z.total_cmp(&b.z))
        .unwrap();
    assert!(lowest.x > 11.0 && lowest.y < -2.0, "apex at {lowest}");
    assert!((5.0..9.0).contains(&highest.x), "aorta at {highest}");
}

#[test]
fn keeps_away_from_the_robots_start_with_any_features() {
    let mesh = heart_phantom(DEFAULT_PHANTOM_SPACING_CM).unwrap();
    let topology = Arc::new(Topology::from_faces(&mesh.vertices, &mesh.faces).unwrap());
    let heart = Surface::new(&topology, &mesh.vertices).unwrap();
    let start = Point::origin();
    assert!(
        heart.signed_distance(&start) > 3.3,
        "{}",
        heart.signed_distance(&start)
    );

    for seed in 1..=20 {
        let picked = pick_features(&mesh, 50, seed).unwrap();
        let features: Vec<Point> = picked.iter().map(|&i| mesh.vertices[i]).collect();
        let hull = common::hull(&features);
        assert_eq!(hull.topology().faces().len(), 96);
        let distance = hull.signed_distance(&start);
        assert!(distance > 3.0, "seed {seed}: {distance} cm");
    }
}

#[test]
fn refuses_spacings_out_of_range() {
    for spacing in [f64::NAN, f64::INFINITY, -1.0, 0.0, 0.1999, 0.601, 1e300] {
        assert!(matches!(
            heart_phantom(spacing),
            Err(SurfaceError::Spacing { .. })
        ));
    }
}
