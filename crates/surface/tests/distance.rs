//! Signed distance against closed forms, and its sign against solid angles.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a failed helper is a failed test"
)]

mod common;

use std::sync::{Arc, LazyLock};

use adslam_surface::{Surface, Topology};
use common::{Point, cube, grid_points, hull, p, point_within, sphere, star, winding_number};
use nalgebra::Vector3;
use proptest::prelude::*;

fn to_cube(q: &Point) -> f64 {
    let beyond = q.coords.abs() - Vector3::repeat(1.0);
    beyond.sup(&Vector3::zeros()).norm() + beyond.max().min(0.0)
}

/// The distance of an inner point from a convex surface is that from the nearest face's plane.
fn depth_in_convex(surface: &Surface, q: &Point) -> f64 {
    let planes = surface.topology().faces().iter().map(|f| {
        let [a, b, c] = f.map(|i| surface.points()[i]);
        (b - a).cross(&(c - a)).normalize().dot(&(q - a))
    });
    planes.fold(f64::NEG_INFINITY, f64::max)
}

/// The least distance to points spread over all faces: never less than the true distance.
fn sampled_distance(surface: &Surface, q: &Point) -> f64 {
    const N: i32 = 12;
    let mut least = f64::INFINITY;
    for face in surface.topology().faces() {
        let [a, b, c] = face.map(|i| surface.points()[i]);
        for u in 0..=N {
            for v in 0..=N - u {
                let (u, v) = (f64::from(u) / f64::from(N), f64::from(v) / f64::from(N));
                least = least.min((a + (b - a) * u + (c - a) * v - q).norm());
            }
        }
    }
    least
}

static FINE_SPHERE: LazyLock<Surface> = LazyLock::new(|| hull(&sphere(2000)));

#[test]
fn tetrahedron_at_known_places() {
    let corners = [
        p(0.0, 0.0, 0.0),
        p(3.0, 0.0, 0.0),
        p(0.0, 3.0, 0.0),
        p(0.0, 0.0, 3.0),
    ];
    let surface = hull(&corners);
    let check = |q: Point, expected: f64| {
        approx::assert_abs_diff_eq!(surface.signed_distance(&q), expected, epsilon = 1e-14);
    };
    check(p(1.0, 1.0, -2.0), 2.0); // below a face
    check(p(3.0, 3.0, 3.0), 6.0 / 3.0_f64.sqrt()); // above the slanted face
    check(p(1.0, -3.0, -4.0), 5.0); // beside an edge
    check(p(-2.0, -3.0, -6.0), 7.0); // beyond a corner
    check(p(0.5, 0.5, 0.5), -0.5); // inside
    check(p(1.0, 1.0, 1.0), 0.0); // on the slanted face
    check(p(0.0, 0.0, 1.0), 0.0); // on an edge
}

#[test]
fn zero_on_every_corner_and_never_negative_zero_confusion() {
    let surface = hull(&sphere(50));
    for q in surface.points() {
        assert_eq!(surface.signed_distance(q).abs(), 0.0);
    }
}

#[test]
fn faces_without_area_are_harmless() {
    // A cube whose features were estimated so that two corners of every pair coincide: flat.
    let topology = Arc::new(Topology::convex_hull(&cube()).unwrap());
    let flat: Vec<Point> = cube().iter().map(|q| p(q.x, q.y, 0.0)).collect();
    let surface = Surface::new(&topology, &flat).unwrap();
    approx::assert_abs_diff_eq!(surface.signed_distance(&p(0.0, 0.0, 2.0)), 2.0);
    approx::assert_abs_diff_eq!(surface.signed_distance(&p(4.0, 0.0, 4.0)), 5.0);
    assert!(surface.crosses(&p(0.1, 0.2, 1.0), &p(0.1, 0.2, -1.0)));
    assert!(
        surface.crosses(&p(0.1, -3.0, 0.0), &p(0.1, 3.0, 0.0)),
        "within the plane"
    );
    assert!(
        !surface.crosses(&p(1.5, -3.0, 0.0), &p(1.5, 3.0, 0.0)),
        "past it in the plane"
    );

    let spot = vec![p(1.0, 2.0, 3.0); 8];
    let surface = Surface::new(&topology, &spot).unwrap();
    approx::assert_abs_diff_eq!(surface.signed_distance(&p(1.0, 2.0, 5.0)), 2.0);
    assert!(
        surface.crosses(&p(0.0, 2.0, 3.0), &p(2.0, 2.0, 3.0)),
        "through the spot"
    );
    assert!(
        !surface.crosses(&p(0.0, 2.0, 3.0), &p(2.0, 2.1, 3.0)),
        "past the spot"
    );
}

#[test]
fn a_pocket_turned_inside_out_counts_as_inside() {
    let topology = Arc::new(Topology::convex_hull(&cube()).unwrap());
    let mirrored: Vec<Point> = cube().iter().map(|q| p(-q.x, q.y, q.z)).collect();
    let surface = Surface::new(&topology, &mirrored).unwrap();
    approx::assert_abs_diff_eq!(surface.signed_distance(&p(0.25, 0.0, 0.0)), -0.75);
}

proptest! {
    #![proptest_config(common::cases(1000))]

    #[test]
    fn cube_in_closed_form(q in point_within(3.0)) {
        let surface = hull(&cube());
        prop_assert!((surface.signed_distance(&q) - to_cube(&q)).abs() < 1e-12);
    }

    /// The hull of sphere points lies between the sphere and a slightly smaller one.
    #[test]
    fn fine_sphere_is_nearly_a_sphere(q in point_within(2.0)) {
        let distance = FINE_SPHERE.signed_distance(&q);
        let to_ball = q.coords.norm() - 1.0;
        prop_assert!(distance >= to_ball - 1e-12 && distance <= to_ball + 0.01, "{distance} {to_ball}");
    }

    #[test]
    fn inside_a_convex_surface_it_is_the_nearest_plane(
        points in grid_points(4, 5..25),
        q in point_within(4.0),
    ) {
        let surface = hull(&points);
        let depth = depth_in_convex(&surface, &q);
        let distance = surface.signed_distance(&q);
        prop_assert_eq!(depth < 0.0, distance < 0.0);
        if depth < 0.0 {
            prop_assert!((distance - depth).abs() < 1e-12);
        } else {
            prop_assert!(distance >= depth - 1e-12);
        }
    }

    #[test]
    fn size_agrees_with_samples_of_a_dented_surface(q in point_within(2.0)) {
        let surface = star(24);
        let (distance, sampled) = (surface.signed_distance(&q).abs(), sampled_distance(&surface, &q));
        prop_assert!(distance <= sampled + 1e-12 && sampled <= distance + 0.1);
    }

    #[test]
    fn sign_agrees_with_solid_angles_on_dented_surfaces(q in point_within(1.2), count in 20_usize..300) {
        let surface = star(count);
        let winding = winding_number(&surface, &q);
        prop_assert_eq!(surface.signed_distance(&q) < 0.0, winding.abs() > 0.5, "winding {}", winding);
    }

    /// Also where a deformation has pushed the surface through itself.
    #[test]
    fn sign_agrees_with_solid_angles_on_surfaces_that_cross_themselves(
        points in grid_points(3, 5..20),
        moves in prop::collection::vec(common::grid_point(2), 20),
        q in point_within(5.0),
    ) {
        let topology = Arc::new(Topology::convex_hull(&points).unwrap());
        let moved: Vec<Point> = points.iter().zip(&moves).map(|(a, b)| a + b.coords).collect();
        let surface = Surface::new(&topology, &moved).unwrap();
        let winding = winding_number(&surface, &q);
        prop_assert_eq!(surface.signed_distance(&q) < 0.0, winding.abs() > 0.5, "winding {}", winding);
    }

    /// Straight above edges and corners, where a ray upward meets several faces at once.
    #[test]
    fn sign_agrees_with_solid_angles_on_grid_points(
        points in grid_points(3, 5..20),
        q in common::grid_point(4),
    ) {
        let surface = hull(&points);
        let distance = surface.signed_distance(&q);
        prop_assume!(distance.abs() > 1e-9);
        prop_assert_eq!(distance < 0.0, winding_number(&surface, &q).abs() > 0.5);
    }
}
