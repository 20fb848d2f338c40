//! Line of sight: the public planner's counts, grazing rays, and what must never change it.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a failed helper is a failed test"
)]

mod common;

use std::sync::Arc;

use adslam_surface::{Surface, Topology};
use common::{Point, cube, golden, grid_point, grid_points, hull, p, point_within, polygon};
use proptest::prelude::*;

fn in_range(sensor: &Point, feature: &Point) -> bool {
    (0.1..=3.0).contains(&(feature - sensor).norm())
}

fn viewpoints() -> Vec<Point> {
    let mut all = Vec::new();
    for x in 0..7 {
        for y in 0..7 {
            for z in 0..9 {
                let v = p(f64::from(x) - 1.5, f64::from(y) - 3.0, f64::from(z) - 2.0);
                let blocked = (0.5..=2.5).contains(&v.x)
                    && (-1.0..=1.0).contains(&v.y)
                    && (0.0..=4.0).contains(&v.z);
                if !blocked {
                    all.push(v);
                }
            }
        }
    }
    all
}

fn check_against_public_planner(topology: Topology) {
    let features = golden::FEATURES.map(Point::from);
    let surface = Surface::new(&Arc::new(topology), &features).unwrap();
    let seen_from = |sensor: &Point| -> Vec<usize> {
        (0..14)
            .filter(|&i| in_range(sensor, &features[i]) && surface.sees(sensor, i))
            .collect()
    };
    let at_start: Vec<usize> = seen_from(&Point::origin())
        .into_iter()
        .filter(|&i| features[i].x > 0.0)
        .collect();
    assert_eq!(at_start, golden::SEEN_FROM_START);

    let counts: String = viewpoints()
        .iter()
        .map(|v| {
            seen_from(v)
                .iter()
                .filter(|i| !at_start.contains(i))
                .count()
                .to_string()
        })
        .collect();
    assert_eq!(counts, golden::NEWLY_SEEN);
}

#[test]
fn counts_equal_the_public_planners_on_its_own_faces() {
    let features = golden::FEATURES.map(Point::from);
    check_against_public_planner(Topology::from_faces(&features, &golden::FACES).unwrap());
}

#[test]
fn counts_equal_the_public_planners_on_our_hull() {
    let topology = Topology::convex_hull(&golden::FEATURES.map(Point::from)).unwrap();
    assert_eq!(topology.faces().len(), 24);
    check_against_public_planner(topology);
}

#[test]
fn rays_through_edges_and_corners_are_blocked() {
    let surface = hull(&polygon());
    let sees = |x, y, z, feature| surface.sees(&p(x, y, z), feature);
    // Feature 2 is at (2, -.5, 1); on the other side the edge from 5 to 11 is x = 1, y = .5.
    assert!(!sees(0.0, 1.2, 1.5, 2), "through the inside of a side");
    assert!(!sees(0.0, 1.5, 3.0, 2), "through that edge, at z = 2");
    assert!(!sees(0.0, 1.5, 1.0, 2), "through corner 5, along faces");
    assert!(!sees(0.0, 1.5, 5.0, 2), "through corner 11");
    // Along the axis, through the bottom corner, which four faces share.
    assert!(!sees(1.5, 0.0, -1.0, 13));
    assert!(sees(1.5, 0.0, -1.0, 0));
    // Along the edge from 2 to 8: 2 is in the way of 8.
    assert!(!sees(2.0, -0.5, 0.0, 8));
    // In the plane of the side x = 2, past feature 2 and over the planar side to 9.
    assert!(!sees(2.0, -1.5, 0.0, 9));
    // Grazing feature 8 exactly, from outside, to see 9 along the edge of the top.
    assert!(!sees(2.0, -1.5, 3.0, 9));
    // In the plane of the side, but to a corner of it that nothing hides.
    assert!(sees(2.0, -1.5, 0.0, 2));
    // Straight in front of a corner.
    assert!(sees(3.0, -1.5, 1.0, 2));
}

#[test]
fn a_sensor_at_the_feature_sees_it_and_unknown_features_are_not_seen() {
    let surface = hull(&polygon());
    assert!((0..14).all(|i| surface.sees(&polygon()[i], i)));
    assert!(!surface.sees(&p(0.0, 0.0, 0.0), 14));
    assert!(!surface.sees(&p(0.0, 0.0, 0.0), usize::MAX));
}

#[test]
fn positions_that_are_not_finite_are_answered_on_the_safe_side() {
    let surface = hull(&cube());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        let q = p(0.0, bad, 3.0);
        assert!(surface.crosses(&q, &p(5.0, 5.0, 5.0)) && surface.crosses(&p(5.0, 5.0, 5.0), &q));
        assert!((0..8).all(|i| !surface.sees(&q, i)));
        assert!(surface.signed_distance(&q).is_nan());
    }
}

#[test]
fn closed_segments_touch_what_they_end_on() {
    let surface = hull(&cube());
    let crosses = |a: [f64; 3], b: [f64; 3]| surface.crosses(&a.into(), &b.into());
    assert!(
        crosses([2.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        "ends inside a face"
    );
    assert!(
        crosses([1.0, 1.0, 1.0], [2.0, 2.0, 2.0]),
        "ends at a corner"
    );
    assert!(crosses([1.0, 1.0, -5.0], [1.0, 1.0, 5.0]), "along an edge");
    assert!(crosses([1.0, 0.0, -5.0], [1.0, 0.0, 5.0]), "along a face");
    assert!(crosses([0.0, 2.0, 0.0], [2.0, 0.0, 0.0]), "past an edge");
    assert!(
        crosses([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        "a point on a face"
    );
    assert!(!crosses([0.0, 0.0, 0.0], [0.5, 0.5, 0.5]), "inside");
    assert!(
        !crosses([1.0, 1.0, 1.0 + 1e-15], [2.0, 2.0, 2.0]),
        "a hair outside"
    );
    assert!(
        !crosses([0.0, 2.0 + 1e-15, 0.0], [2.0 + 1e-15, 0.0, 0.0]),
        "a hair past an edge"
    );
    assert!(
        !crosses([2.0, 0.0, 0.0], [2.0, 0.0, 0.0]),
        "a point outside"
    );
}

/// Everything that a sensor sees.
fn seen(surface: &Surface, sensor: &Point) -> Vec<bool> {
    (0..surface.points().len())
        .map(|i| surface.sees(sensor, i))
        .collect()
}

proptest! {
    #![proptest_config(common::cases(512))]

    #[test]
    fn order_of_faces_and_corners_does_not_matter(
        points in grid_points(3, 6..20),
        sensor in grid_point(5),
        order in any::<prop::sample::Index>(),
    ) {
        let surface = hull(&points);
        let mut faces = surface.topology().faces().to_vec();
        let shift = order.index(faces.len());
        faces.rotate_left(shift);
        faces.iter_mut().step_by(2).for_each(|f| f.rotate_left(1));
        faces.iter_mut().step_by(3).for_each(|f| f.swap(0, 1));
        let permuted = Arc::new(Topology::from_faces(&points, &faces).unwrap());
        let permuted = Surface::new(&permuted, &points).unwrap();
        prop_assert_eq!(seen(&surface, &sensor), seen(&permuted, &sensor));
    }

    #[test]
    fn moving_everything_by_whole_numbers_does_not_matter(
        points in grid_points(3, 6..20),
        sensor in grid_point(5),
        by in grid_point(1000),
    ) {
        let surface = hull(&points);
        let moved: Vec<Point> = points.iter().map(|q| q + by.coords).collect();
        let topology = Arc::new(surface.topology().clone());
        let moved = Surface::new(&topology, &moved).unwrap();
        prop_assert_eq!(seen(&surface, &sensor), seen(&moved, &(sensor + by.coords)));
    }

    /// From outside a convex object, a corner is seen only if it lies on a face that is not turned
    /// away from the sensor; and for certain if all its faces are turned to it.
    #[test]
    fn never_sees_through_a_convex_object(points in grid_points(4, 5..25), sensor in grid_point(7)) {
        let surface = hull(&points);
        // On the surface itself rounding may say that it is outside.
        prop_assume!(surface.signed_distance(&sensor) > 1e-9);
        for i in 0..points.len() {
            let outward = |face: &[usize; 3]| {
                let [a, b, c] = face.map(|k| points[k]);
                (b - a).cross(&(c - a)).dot(&(sensor - a))
            };
            let at: Vec<f64> = surface.topology().faces_at(i).iter()
                .map(|&f| outward(&surface.topology().faces()[f])).collect();
            let shown = at.iter().any(|&s| s >= 0.0);
            // Grid coordinates make these products exact.
            prop_assert!(!surface.sees(&sensor, i) || shown, "feature {i} seen from {sensor}");
            prop_assert!(surface.sees(&sensor, i) || at.is_empty() || at.iter().any(|&s| s <= 0.0));
        }
    }

    #[test]
    fn crossing_does_not_depend_on_the_direction(
        points in grid_points(3, 5..20),
        a in grid_point(5),
        b in point_within(5.0),
    ) {
        let surface = hull(&points);
        prop_assert_eq!(surface.crosses(&a, &b), surface.crosses(&b, &a));
    }

    /// A segment that changes sides must cross: nothing slips between faces.
    #[test]
    fn no_segment_slips_through(points in grid_points(3, 5..20), a in grid_point(6), b in grid_point(6)) {
        let surface = hull(&points);
        if surface.signed_distance(&a) * surface.signed_distance(&b) < 0.0 {
            prop_assert!(surface.crosses(&a, &b));
        }
    }

    #[test]
    fn a_feature_seen_stays_seen_on_the_way_to_it(sensor in point_within(4.0), share in 0.0..1.0) {
        let surface = hull(&polygon());
        for i in 0..14 {
            let feature = polygon()[i];
            let nearer: Point = sensor + (feature - sensor) * share;
            let slack = 1e-9;
            if surface.sees(&sensor, i) && (feature - nearer).norm() > slack
                && surface.signed_distance(&nearer).abs() > slack {
                prop_assert!(surface.sees(&nearer, i));
            }
        }
    }
}
