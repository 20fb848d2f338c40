//! Many segments at once must be answered as one by one, on surfaces of every kind: convex, dented,
//! crossing themselves, with faces and sensors on common planes and lines.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a failed helper is a failed test"
)]

mod common;

use std::sync::Arc;

use adslam_surface::{Clearance, Fan, Surface, Topology};
use common::{Point, grid_point, grid_points, hull, p, point_within, polygon, star};
use proptest::prelude::*;

fn seen_one_by_one(surface: &Surface, sensor: &Point) -> Vec<usize> {
    (0..surface.points().len())
        .filter(|&i| surface.sees(sensor, i))
        .collect()
}

fn sorted(numbers: &[usize]) -> Vec<usize> {
    let mut numbers = numbers.to_vec();
    numbers.sort_unstable();
    numbers
}

fn clear_one_by_one(
    surface: &Surface,
    start: &Point,
    ends: &[Point],
    clearance: f64,
) -> Vec<usize> {
    (0..ends.len())
        .filter(|&i| {
            surface.signed_distance(start) > 0.0
                && surface.signed_distance(&ends[i]) > clearance
                && !surface.crosses(start, &ends[i])
        })
        .collect()
}

fn check(surface: &Surface, start: &Point, ends: &[Point], clearance: f64) {
    // The same room for everything, so that nothing may be left over from what came before.
    let (mut fan, mut room) = (Fan::default(), Clearance::default());
    let some_points = surface.points().iter().step_by(7);
    for sensor in ends.iter().chain([start]).chain(some_points) {
        let all = 0..surface.points().len();
        assert_eq!(
            sorted(fan.seen(surface, sensor, all)),
            seen_one_by_one(surface, sensor)
        );
    }
    let free: Vec<usize> = (0..ends.len())
        .filter(|&i| !surface.crosses(start, &ends[i]))
        .collect();
    assert_eq!(sorted(fan.free(surface, start, ends, 0..ends.len())), free);
    for clearance in [clearance, 0.0] {
        assert_eq!(
            room.clear_ways(surface, start, ends.iter().copied(), clearance),
            clear_one_by_one(surface, start, ends, clearance)
        );
    }
}

proptest! {
    #![proptest_config(common::cases(400))]

    #[test]
    fn on_hulls_of_a_coarse_grid(
        points in grid_points(3, 6..20),
        start in grid_point(5),
        ends in prop::collection::vec(grid_point(5), 1..20),
    ) {
        check(&hull(&points), &start, &ends, 1.0);
    }

    #[test]
    fn on_crumpled_surfaces(
        points in grid_points(3, 6..20),
        places in prop::collection::vec(grid_point(2), 20),
        start in grid_point(3),
        ends in prop::collection::vec(grid_point(3), 1..20),
    ) {
        let topology = Arc::new(Topology::convex_hull(&points).unwrap());
        let surface = Surface::new(&topology, &places[..points.len()]).unwrap();
        check(&surface, &start, &ends, 0.5);
    }

    #[test]
    fn on_dented_surfaces_of_any_size_anywhere(
        start in point_within(1.3),
        ends in prop::collection::vec(point_within(1.5), 1..40),
        away in point_within(1e3),
        scale in -6..6_i32,
    ) {
        let dented = star(150);
        let place = |q: &Point| away + q.coords * 10_f64.powi(scale);
        let points: Vec<Point> = dented.points().iter().map(place).collect();
        let surface = Surface::new(&Arc::new(dented.topology().clone()), &points).unwrap();
        let ends: Vec<Point> = ends.iter().map(place).collect();
        check(&surface, &place(&start), &ends, 0.2 * 10_f64.powi(scale));
    }
}

#[test]
fn a_hair_decides_as_one_by_one() {
    let surface = hull(&polygon());
    let corner = surface.points()[8];
    let mut fan = Fan::default();
    for step in -20..=20 {
        let by = f64::from(step) * f64::EPSILON;
        // Past a corner, along an edge, along the plane of a face.
        for sensor in [
            p(2.0 + by, -1.5, 3.0),
            p(corner.x + by, corner.y - by, 0.0),
            p(2.0 + by, -1.5, 0.5),
        ] {
            let all = 0..surface.points().len();
            assert_eq!(
                sorted(fan.seen(&surface, &sensor, all)),
                seen_one_by_one(&surface, &sensor)
            );
        }
    }
}

/// Ends as far from a face or from a corner as the clearance asks, but for a hair, each as the only way there is.
#[test]
fn a_hair_of_clearance_decides_as_one_by_one() {
    const CLEARANCE: f64 = 0.25;
    let mut room = Clearance::default();
    for away in [0.0, 1e6] {
        let move_away = |q: Point| p(q.x + away, q.y - away / 3.0, q.z + away / 7.0);
        // The centre of the first face is the origin.
        let corners = [(-1.0, -1.0, 0.0), (2.0, -1.0, 0.0), (-1.0, 2.0, 0.0)];
        let base = corners.map(|(x, y, z)| move_away(p(x, y, z)));
        let surface = hull(&[base[0], base[1], base[2], move_away(p(0.0, 0.0, -2.0))]);
        let middle = move_away(p(0.0, 0.0, -0.5));
        let mut places = Vec::new();
        for &[a, b, c] in surface.topology().faces() {
            let [a, b, c] = [a, b, c].map(|corner| surface.points()[corner]);
            let centre = Point::from((a.coords + b.coords + c.coords) / 3.0);
            places.push((centre, (b - a).cross(&(c - a)).normalize()));
        }
        places.extend(
            surface
                .points()
                .iter()
                .map(|q| (*q, (q - middle).normalize())),
        );
        for (place, outwards) in places {
            let start = place + outwards * 5.0;
            for exponent in -16..=-6 {
                for hair in [-1.0, 1.0].map(|sign| sign * 10_f64.powi(exponent)) {
                    let end = place + outwards * (CLEARANCE + hair);
                    assert_eq!(
                        room.clear_ways(&surface, &start, [end], CLEARANCE),
                        clear_one_by_one(&surface, &start, &[end], CLEARANCE),
                        "{place} {away} {hair}"
                    );
                }
            }
        }
    }
}

/// All corners on a line but for rounding, of which alone the normals are made.
#[test]
fn a_needle_is_kept_clear_of() {
    let tetrahedron = [
        (0.0, 0.0, 0.0),
        (1.0, 0.0, 0.0),
        (0.0, 1.0, 0.0),
        (0.0, 0.0, 1.0),
    ];
    let corners = tetrahedron.map(|(x, y, z)| p(x, y, z));
    let topology = Arc::new(hull(&corners).topology().clone());
    let mut room = Clearance::default();
    for length in [1.0, 1e3, 1e6] {
        let along = p(length / 3.0, length / 7.0, length / 11.0).coords;
        let points = [0.0, 0.3, 0.7, 1.0].map(|part| Point::from(along * part));
        let surface = Surface::new(&topology, &points).unwrap();
        let start = p(0.0, 0.0, length);
        let ends: Vec<Point> = (1..100)
            .map(|k| Point::from(along * (f64::from(k) / 100.0)) + start.coords * 1e-3)
            .collect();
        assert!(
            room.clear_ways(&surface, &start, ends, 2e-3 * length)
                .is_empty()
        );
    }
}

#[test]
fn unusable_places_and_numbers_are_answered_on_the_safe_side() {
    let surface = hull(&polygon());
    let (mut fan, mut room) = (Fan::default(), Clearance::default());
    let good = p(-2.0, 0.0, 1.0);
    for bad in [f64::NAN, f64::INFINITY, 1e300, 1e-91].map(|x| p(x, 0.0, 0.0)) {
        assert!(fan.seen(&surface, &bad, 0..14).is_empty());
        assert!(fan.free(&surface, &bad, &[good], [0]).is_empty());
        assert!(room.clear_ways(&surface, &bad, [good], 0.1).is_empty());
        assert_eq!(
            sorted(fan.free(&surface, &good, &[bad, good, bad], 0..3)),
            [1]
        );
        assert_eq!(room.clear_ways(&surface, &good, [bad, good], 0.1), [1]);
    }
    assert!(fan.seen(&surface, &good, [14, usize::MAX]).is_empty());
    assert!(fan.free(&surface, &good, &[good], [1]).is_empty());
}

#[test]
fn a_surface_placed_again_is_as_one_made_anew() {
    let mut surface = hull(&polygon());
    let moved: Vec<Point> = polygon().iter().map(|q| p(q.x + 5.0, q.y, q.z)).collect();
    let sensor = p(3.5, -1.0, 0.5);
    let before = surface.signed_distance(&sensor);
    assert!(surface.place(&moved[1..]).is_err());
    assert!(surface.place(&[p(f64::NAN, 0.0, 0.0); 14]).is_err());
    assert_eq!(
        surface.signed_distance(&sensor),
        before,
        "a refusal changes nothing"
    );
    surface.place(&moved).unwrap();
    let anew = Surface::new(&Arc::new(surface.topology().clone()), &moved).unwrap();
    assert_eq!(
        surface.signed_distance(&sensor),
        anew.signed_distance(&sensor)
    );
    assert_ne!(surface.signed_distance(&sensor), before);
    assert_eq!(
        seen_one_by_one(&surface, &sensor),
        seen_one_by_one(&anew, &sensor)
    );
}
