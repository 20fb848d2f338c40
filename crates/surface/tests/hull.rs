//! Hulls and topologies: exact on common planes, and clear about what is wrong.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a failed helper is a failed test"
)]

mod common;

use adslam_surface::{Mesh, SurfaceError, Topology};
use common::{Point, cube, grid_point, hull, p, polygon, sphere};
use proptest::prelude::*;

/// How far above the plane of a face a point is, times the face's area. Exact on small grids.
fn above(points: &[Point], face: &[usize; 3], q: &Point) -> f64 {
    let [a, b, c] = face.map(|i| points[i]);
    (b - a).cross(&(c - a)).dot(&(q - a))
}

fn corners(topology: &Topology) -> Vec<usize> {
    (0..topology.point_count())
        .filter(|&i| !topology.faces_at(i).is_empty())
        .collect()
}

/// Numbers of every order of magnitude that is accepted.
fn wild() -> impl Strategy<Value = f64> {
    (-9.9..9.9, -320..9).prop_map(|(digits, power)| digits * 10_f64.powi(power))
}

#[test]
fn polygon_has_24_faces_and_every_point_is_a_corner() {
    let topology = Topology::convex_hull(&polygon()).unwrap();
    assert_eq!(topology.faces().len(), 24);
    assert!(topology.points_off_surface().is_empty());
}

#[test]
fn cube_and_subdivided_cube_have_12_faces_over_the_8_corners() {
    assert_eq!(Topology::convex_hull(&cube()).unwrap().faces().len(), 12);
    let mut grid = Vec::new();
    for i in 0..125_u8 {
        grid.push(p(f64::from(i % 5), f64::from(i / 5 % 5), f64::from(i / 25)));
    }
    let topology = Topology::convex_hull(&grid).unwrap();
    assert_eq!(topology.faces().len(), 12);
    assert_eq!(corners(&topology), [0, 4, 20, 24, 100, 104, 120, 124]);
    assert_eq!(topology.points_off_surface().len(), 117);
}

/// Up to seven of the points share a plane. The hull of parry 0.31.1 has points 3 and 19 for
/// corners as well, and three faces that fold over others: volume 32.5.
#[test]
fn many_points_on_common_planes_leave_no_fold() {
    let points = [
        [-2, 0, 2],
        [1, -2, 1],
        [2, 0, -1],
        [0, 0, -2],
        [-1, 2, 0],
        [1, -2, -2],
        [0, -1, 2],
        [-1, 2, -2],
        [-2, -2, -2],
        [1, 1, -1],
        [-2, 1, 2],
        [1, -1, 1],
        [-1, 2, 1],
        [1, 0, -1],
        [-2, 1, 1],
        [-1, 1, 1],
        [-1, -1, -1],
        [0, 1, -1],
        [-2, 0, 1],
        [-1, -1, 1],
    ];
    let points = points.map(|q: [i32; 3]| Point::from(q.map(f64::from)));
    let topology = Topology::convex_hull(&points).unwrap();
    let expected = [0, 1, 2, 5, 6, 7, 8, 9, 10, 11, 12, 14];
    assert_eq!(corners(&topology), expected);
    for face in topology.faces() {
        assert!(points.iter().all(|q| above(&points, face, q) <= 0.0));
    }
    let solid = Mesh {
        vertices: points.to_vec(),
        faces: topology.faces().to_vec(),
    };
    assert_eq!(solid.volume(), 31.5);
}

/// parry 0.31.1 takes both for flat, and gives 4 faces and 2.
#[test]
fn plates_and_rods_keep_their_eight_corners() {
    for sides in [[1.0, 1.0, 1e-6], [10.0, 0.005, 0.005]] {
        let points: Vec<Point> = cube()
            .iter()
            .map(|q| Point::from([0, 1, 2].map(|i| q[i] * sides[i])))
            .collect();
        let topology = Topology::convex_hull(&points).unwrap();
        assert_eq!(topology.faces().len(), 12);
        assert_eq!(corners(&topology).len(), 8);
    }
}

#[test]
fn topology_knows_its_faces() {
    let topology = Topology::convex_hull(&sphere(50)).unwrap();
    assert_eq!((topology.point_count(), topology.faces().len()), (50, 96));
    for point in 0..50 {
        let by_search: Vec<usize> = (0..96)
            .filter(|&f| topology.faces()[f].contains(&point))
            .collect();
        assert_eq!(topology.faces_at(point), by_search);
    }
    assert!(topology.faces_at(50).is_empty() && topology.faces_at(usize::MAX).is_empty());
}

#[test]
fn hull_errors_say_what_is_wrong() {
    let bad = |points: &[Point]| Topology::convex_hull(points).unwrap_err();
    assert!(matches!(bad(&[]), SurfaceError::TooFewPoints { count: 0 }));
    assert!(matches!(
        bad(&cube()[..3]),
        SurfaceError::TooFewPoints { count: 3 }
    ));
    assert!(matches!(bad(&cube()[..4]), SurfaceError::Flat { count: 4 }));
    let line: Vec<Point> = (0..9_u8)
        .map(|i| p(f64::from(i) * 0.1, f64::from(i) * 0.3, 1.0))
        .collect();
    assert!(matches!(bad(&line), SurfaceError::Flat { count: 9 }));
    let mut twice = cube();
    twice.push(twice[5]);
    assert!(matches!(
        bad(&twice),
        SurfaceError::RepeatedPoint {
            first: 5,
            second: 8,
            ..
        }
    ));
    twice[8].x = -0.0;
    twice.push(p(0.0, 1.0, -1.0));
    twice[8] = p(-0.0, 1.0, -1.0);
    assert!(matches!(
        bad(&twice),
        SurfaceError::RepeatedPoint {
            first: 8,
            second: 9,
            ..
        }
    ));
    for coordinate in [f64::NAN, f64::INFINITY, 1.1e9, -1e200, -1e-91, 1e-300] {
        let mut points = cube();
        points[6].y = coordinate;
        let error = bad(&points);
        assert!(
            matches!(error, SurfaceError::UnusablePoint { index: 6, .. }),
            "{error}"
        );
    }
}

#[test]
fn faces_are_turned_outward_part_by_part() {
    let mut points = cube();
    let mut faces = Topology::convex_hull(&points).unwrap().faces().to_vec();
    let second: Vec<[usize; 3]> = faces.iter().map(|f| f.map(|i| i + 8)).collect();
    points.extend(
        cube()
            .iter()
            .map(|q| q + nalgebra::Vector3::new(100.0, 0.0, 0.0)),
    );
    faces.extend(second);
    let expected = faces.clone();
    for face in faces.iter_mut().skip(1).step_by(3) {
        face.swap(0, 2);
    }
    let topology = Topology::from_faces(&points, &faces).unwrap();
    for (face, expected) in topology.faces().iter().zip(&expected) {
        let turn = face.iter().position(|i| *i == expected[0]).unwrap();
        assert_eq!([0, 1, 2].map(|k| face[(k + turn) % 3]), *expected);
    }
}

#[test]
fn topology_errors_say_what_is_wrong() {
    let points = cube();
    let faces = Topology::convex_hull(&points).unwrap().faces().to_vec();
    let bad = |faces: &[[usize; 3]]| Topology::from_faces(&points, faces).unwrap_err();
    assert!(matches!(bad(&[]), SurfaceError::NoFaces));
    assert!(matches!(
        bad(&[[0, 1, 8]]),
        SurfaceError::UnknownPoint {
            face: 0,
            point: 8,
            count: 8
        }
    ));
    for face in [[3, 3, 1], [3, 1, 3], [1, 3, 3]] {
        assert!(matches!(
            bad(&[face]),
            SurfaceError::RepeatedCorner { face: 0, point: 3 }
        ));
    }
    let error = bad(&faces[1..]);
    assert!(
        matches!(
            error,
            SurfaceError::Open {
                count: 3,
                shared: 1,
                ..
            }
        ),
        "{error}"
    );
    let mut doubled = faces.clone();
    doubled.push(faces[0]);
    assert!(matches!(
        bad(&doubled),
        SurfaceError::Open {
            count: 3,
            shared: 3,
            ..
        }
    ));
    assert!(matches!(
        bad(&[faces[0], faces[0]]),
        SurfaceError::NoVolume { face: 0, .. }
    ));
    // The projective plane with six vertices has one side only.
    let one_sided = [
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 5],
        [0, 5, 1],
        [1, 2, 4],
        [2, 3, 5],
        [3, 4, 1],
        [4, 5, 2],
        [5, 1, 3],
    ];
    assert!(matches!(bad(&one_sided), SurfaceError::OneSided { .. }));
}

#[test]
fn a_surface_needs_a_position_for_every_point() {
    let topology = std::sync::Arc::new(Topology::convex_hull(&cube()).unwrap());
    let error = adslam_surface::Surface::new(&topology, &cube()[1..]).unwrap_err();
    assert!(matches!(
        error,
        SurfaceError::PointCount {
            expected: 8,
            given: 7
        }
    ));
    let mut points = cube();
    points[2].z = f64::NAN;
    let error = adslam_surface::Surface::new(&topology, &points).unwrap_err();
    assert!(matches!(
        error,
        SurfaceError::UnusablePoint { index: 2, .. }
    ));
}

proptest! {
    #![proptest_config(common::cases(2000))]

    /// On a coarse grid nearly every point shares planes and lines with others.
    #[test]
    fn grid_hulls_contain_everything_and_have_extreme_corners_only(
        points in common::grid_points(2, 4..40),
    ) {
        let topology = Topology::convex_hull(&points).unwrap();
        for face in topology.faces() {
            prop_assert!(points.iter().all(|q| above(&points, face, q) <= 0.0));
            prop_assert!(points.iter().any(|q| above(&points, face, q) < 0.0));
        }
        let corners = corners(&topology);
        prop_assert_eq!(topology.faces().len(), 2 * corners.len() - 4);
        // Without a corner the hull of the rest does not contain it.
        for &corner in &corners {
            let mut rest = points.clone();
            rest.remove(corner);
            if let Ok(smaller) = Topology::convex_hull(&rest) {
                let outside = smaller.faces().iter().any(|f| above(&rest, f, &points[corner]) > 0.0);
                prop_assert!(outside, "corner {} is not extreme", corner);
            }
        }
    }

    #[test]
    fn any_input_gives_a_hull_or_an_error(
        coordinates in prop::collection::vec(any::<[f64; 3]>(), 0..12),
        near in prop::collection::vec(grid_point(1), 0..12),
    ) {
        let mut points: Vec<Point> = coordinates.into_iter().map(Point::from).collect();
        let _ = Topology::convex_hull(&points);
        points.extend(near);
        let _ = Topology::convex_hull(&points);
    }

    /// Even where products of coordinates underflow and the predicates cannot be exact.
    #[test]
    fn numbers_of_any_size_are_survived(
        numbers in prop::collection::vec([wild(), wild(), wild()], 4..14),
        others in prop::collection::vec([wild(), wild(), wild()], 14),
    ) {
        let points: Vec<Point> = numbers.into_iter().map(Point::from).collect();
        if let Ok(topology) = Topology::convex_hull(&points) {
            let topology = std::sync::Arc::new(topology);
            let moved: Vec<Point> = others[..points.len()].iter().map(|&q| q.into()).collect();
            let surface = adslam_surface::Surface::new(&topology, &moved).unwrap();
            for (i, q) in points.iter().enumerate() {
                prop_assert!(!surface.signed_distance(q).is_nan());
                let _ = surface.sees(q, i) || surface.crosses(q, &moved[i]);
            }
        }
    }

    #[test]
    fn any_faces_give_a_topology_or_an_error(
        faces in prop::collection::vec([0_usize..9, 0_usize..9, 0_usize..9], 0..20),
    ) {
        let _ = Topology::from_faces(&cube(), &faces);
    }

    #[test]
    fn random_points_have_closed_hulls(points in prop::collection::vec(common::point_within(1.0), 4..60)) {
        let surface = hull(&points);
        for q in &points {
            prop_assert!(surface.signed_distance(q) < 1e-12);
        }
    }
}
