//! Vertices that nearly coincide.

use adslam_surface::{Mesh, SurfaceError};
use proptest::prelude::*;

use super::common::{self, cube, mesh, sphere};

#[test]
fn what_is_joined_within_a_distance_is_told() {
    let mut loose = mesh(cube());
    loose
        .vertices
        .push(loose.vertices[0] + nalgebra::Vector3::new(0.0, 3e-5, 4e-5));
    let corner = loose.faces.iter_mut().flatten().find(|i| **i == 0).unwrap();
    *corner = 8;
    assert!(matches!(
        loose.check_closed(),
        Err(SurfaceError::Open { .. })
    ));
    let unchanged = loose.clone();
    for distance in [0.0, -1.0, f64::NAN, 4e-5] {
        assert_eq!(
            loose.join_within(distance),
            adslam_surface::NearJoin::default()
        );
        assert_eq!(loose, unchanged);
    }
    let (distance, _) = loose.closing_distance().unwrap();
    assert_eq!(distance, 1e-4);
    let joined = loose.join_within(6e-5);
    assert_eq!((joined.vertices, joined.collapsed), (1, 0));
    approx::assert_relative_eq!(joined.farthest, 5e-5, max_relative = 1e-9);
    loose.check_closed().unwrap();
    // What would take triangles away is not offered.
    let joined = loose.join_within(2.0);
    assert!(
        joined.collapsed > 0 && loose.vertices.len() < 8,
        "{joined:?}"
    );
    let mut open = mesh(cube());
    open.faces.pop();
    assert_eq!(open.closing_distance(), None);
}

proptest! {
    #![proptest_config(common::cases(300))]

    #[test]
    fn vertices_that_were_moved_apart_are_joined_again(
        count in 8..40_usize,
        moves in prop::collection::vec([-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], 1..200),
        exponent in -8..-4_i32,
    ) {
        let original = mesh(sphere(count));
        let apart = 10.0_f64.powi(exponent);
        let mut moves = moves.iter().cycle();
        let mut loose = Mesh::default();
        for face in &original.faces {
            let from = loose.vertices.len();
            loose.vertices.extend(face.map(|i| {
                original.vertices[i] + nalgebra::Vector3::from(*moves.next().unwrap()) * apart / 4.0
            }));
            loose.faces.push([from, from + 1, from + 2]);
        }
        let (distance, joined) = loose.closing_distance().unwrap();
        prop_assert!(distance <= 10.0 * apart, "{distance}");
        prop_assert_eq!(joined.collapsed, 0);
        prop_assert!(joined.farthest <= distance);
        prop_assert_eq!(loose.join_within(distance), joined);
        prop_assert_eq!(loose.vertices.len(), count);
        loose.check_closed().unwrap();
        prop_assert_eq!(loose.closing_distance(), None);
    }
}
