//! Picking features from a mesh.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a failed helper is a failed test"
)]

mod common;

use adslam_surface::{Mesh, SurfaceError, Topology, heart_phantom, pick_features};
use common::{Point, cube, sphere};
use proptest::prelude::*;

fn hull_of(mesh: &Mesh, picked: &[usize]) -> Topology {
    let points: Vec<Point> = picked.iter().map(|&i| mesh.vertices[i]).collect();
    Topology::convex_hull(&points).unwrap()
}

fn ball(count: usize) -> Mesh {
    Mesh {
        vertices: sphere(count),
        faces: Vec::new(),
    }
}

#[test]
fn every_count_from_4_to_200_is_met_with_corners_only() {
    let heart = heart_phantom(0.35).unwrap();
    for count in (4..20).chain((20..=200).step_by(15)) {
        let picked = pick_features(&heart, count, 7).unwrap();
        assert_eq!(picked.len(), count);
        assert!(hull_of(&heart, &picked).points_off_surface().is_empty());
        assert!(picked.is_sorted());
    }
}

#[test]
fn seeds_decide() {
    let heart = heart_phantom(0.5).unwrap();
    let picks: Vec<Vec<usize>> = (0..10)
        .map(|seed| pick_features(&heart, 50, seed).unwrap())
        .collect();
    for (seed, picked) in (0..).zip(&picks) {
        assert_eq!(*picked, pick_features(&heart, 50, seed).unwrap());
    }
    for i in 0..picks.len() {
        assert!(!picks[i + 1..].contains(&picks[i]));
    }
}

#[test]
fn flat_parts_do_not_count_as_corners() {
    // A cube with points on its faces and edges: 8 corners can be had at the very most.
    let mut vertices = cube();
    vertices.extend([[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, -1.0, 1.0]].map(Point::from));
    let block = Mesh {
        vertices,
        faces: Vec::new(),
    };
    for seed in 0..50 {
        if let Ok(picked) = pick_features(&block, 8, seed) {
            assert!(hull_of(&block, &picked).points_off_surface().is_empty());
        }
        let error = pick_features(&block, 12, seed).unwrap_err();
        assert!(matches!(
            error,
            SurfaceError::TooFewFeatures {
                wanted: 12,
                vertices: 11,
                ..
            }
        ));
    }
}

#[test]
fn impossible_requests_are_refused() {
    for count in 0..4 {
        let error = pick_features(&ball(100), count, 1).unwrap_err();
        assert!(matches!(error, SurfaceError::FeatureCount { .. }));
    }
    let error = pick_features(&ball(100), 101, 1).unwrap_err();
    assert!(matches!(
        error,
        SurfaceError::TooFewFeatures {
            wanted: 101,
            found: 100,
            vertices: 100
        }
    ));
    assert_eq!(pick_features(&ball(100), 100, 1).unwrap().len(), 100);
    let error = pick_features(&Mesh::default(), 4, 1).unwrap_err();
    assert!(matches!(error, SurfaceError::TooFewPoints { count: 0 }));
    let flat = Mesh {
        vertices: cube()[..4].to_vec(),
        faces: Vec::new(),
    };
    assert!(matches!(
        pick_features(&flat, 4, 1),
        Err(SurfaceError::Flat { .. })
    ));
    let mut broken = ball(100);
    broken.vertices[3].x = f64::NAN;
    let error = pick_features(&broken, 10, 1).unwrap_err();
    assert!(matches!(
        error,
        SurfaceError::UnusablePoint { index: 3, .. }
    ));
}

proptest! {
    #![proptest_config(common::cases(200))]

    #[test]
    fn any_seed_gives_distinct_corners(count in 4_usize..80, seed in any::<u64>()) {
        let mesh = ball(300);
        let picked = pick_features(&mesh, count, seed).unwrap();
        prop_assert_eq!(picked.len(), count);
        prop_assert!(hull_of(&mesh, &picked).points_off_surface().is_empty());
    }
}
