//! Polygons, cut into triangles.

use std::fmt::Write;

use adslam_surface::{Inspection, MeshFormat};
use proptest::prelude::*;

use super::{common, note, read, refused};

#[test]
fn polygons_that_nothing_covers_are_told() {
    let head = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\n";
    for face in ["f 1 3 2 4", "f 1 2 5 6"] {
        let said = note(MeshFormat::Obj, format!("{head}{face}\n").as_bytes());
        assert!(
            said.starts_with("1 polygons cross themselves or have no area"),
            "{said}"
        );
    }
    // Corners that repeat the one before are none.
    let found = read(MeshFormat::Obj, format!("{head}f 1 2 2 3 4 1\n").as_bytes());
    assert_eq!(found.mesh.faces.len(), 2);
    assert_eq!((found.collapsed, found.notes), (0, Vec::new()));
    let found = read(
        MeshFormat::Obj,
        format!("{head}f 1 2 3\nf 1 1 2 2\n").as_bytes(),
    );
    assert_eq!((found.mesh.faces.len(), found.collapsed), (1, 1));
}

/// A ring with its hole, as one polygon that comes back along the way it took inward.
#[test]
fn holes_stay_open() {
    let mut text = String::new();
    for (x, y) in [
        (0, 0),
        (4, 0),
        (4, 4),
        (0, 4),
        (1, 1),
        (3, 1),
        (3, 3),
        (1, 3),
    ] {
        writeln!(text, "v {x} {y} 0").unwrap();
    }
    text += "f 1 2 3 4 1 5 8 7 6 5\n";
    let found = read(MeshFormat::Obj, text.as_bytes());
    let seen = Inspection::of(&found.mesh);
    assert!(found.notes.is_empty(), "{:?}", found.notes);
    assert_eq!((seen.faces, seen.area), (8, 12.0));
    assert_eq!((seen.boundary_edges, seen.twisted_edges), (8, 0));
}

#[test]
fn concave_polygons_of_very_many_corners_are_refused() {
    let comb = |teeth: usize| {
        let mut text = format!("v 0 -1 0\nv {} -1 0\n", 2 * teeth);
        for i in (0..2 * teeth).rev() {
            writeln!(text, "v {i} {} 0", i % 2).unwrap();
        }
        let corners: Vec<String> = (1..=2 + 2 * teeth).map(|i| i.to_string()).collect();
        text + "f " + &corners.join(" ") + "\n"
    };
    let found = read(MeshFormat::Obj, comb(2499).as_bytes());
    assert_eq!((found.mesh.faces.len(), found.notes.len()), (4998, 0));
    let words = ["has 5002 corners, and 5000 are the most"];
    refused(MeshFormat::Obj, comb(2500).as_bytes(), &words);
}

proptest! {
    #![proptest_config(common::cases(300))]

    #[test]
    fn polygons_of_every_first_corner_cover_the_same(
        corners in prop::collection::vec((0.2..1.0_f64, 0.0..1.0_f64), 4..30),
        first in 0..30_usize,
        turn in 0.0..7.0_f64,
        tilt in 0.0..7.0_f64,
        is_reversed: bool,
    ) {
        // A star-shaped polygon around the origin, concave as a rule, with a corner in the middle of
        // each side, and a prism on it.
        let mut angles: Vec<f64> = corners.iter().map(|(_, part)| part * std::f64::consts::TAU).collect();
        angles.sort_by(f64::total_cmp);
        angles.dedup();
        let ring: Vec<[f64; 2]> = angles
            .iter()
            .zip(&corners)
            .map(|(angle, (radius, _))| [radius * angle.cos(), radius * angle.sin()])
            .collect();
        let widest = angles.iter().zip(angles.iter().cycle().skip(1)).map(|(a, b)| (b - a).rem_euclid(std::f64::consts::TAU));
        prop_assume!(ring.len() >= 4 && widest.fold(0.0, f64::max) < 3.0);
        let ring: Vec<[f64; 2]> = ring
            .iter()
            .zip(ring.iter().cycle().skip(1))
            .flat_map(|(a, b)| [*a, [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]])
            .collect();
        let count = ring.len();
        let turned = nalgebra::Rotation3::from_euler_angles(tilt, turn, 0.3);
        let mut text = String::new();
        for z in [0.0, 1.0] {
            for [x, y] in &ring {
                let v = turned * nalgebra::Point3::new(*x, *y, z);
                writeln!(text, "v {} {} {}", v.x, v.y, v.z).unwrap();
            }
        }
        let mut face = |corners: Vec<usize>| {
            let mut corners = corners;
            if is_reversed {
                corners.reverse();
            }
            let start = first % corners.len();
            corners.rotate_left(start);
            text += "f";
            corners.iter().for_each(|corner| write!(text, " {}", corner + 1).unwrap());
            text += "\n";
        };
        face((0..count).rev().collect());
        face((count..2 * count).collect());
        for i in 0..count {
            let next = (i + 1) % count;
            face(vec![i, next, count + next, count + i]);
        }
        let found = read(MeshFormat::Obj, text.as_bytes());
        prop_assert!(found.notes.is_empty(), "{:?}", found.notes);
        let seen = Inspection::of(&found.mesh);
        let area = |ring: &[[f64; 2]]| -> f64 {
            let sides = ring.iter().zip(ring.iter().cycle().skip(1));
            sides.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
        };
        let length: f64 = ring
            .iter()
            .zip(ring.iter().cycle().skip(1))
            .map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1]))
            .sum();
        prop_assert!(seen.is_closed(), "{seen:?}");
        prop_assert_eq!(seen.faces, 2 * (count - 2) + 2 * count);
        let volume = if is_reversed { -area(&ring) } else { area(&ring) };
        approx::assert_relative_eq!(seen.volume.unwrap(), volume, max_relative = 1e-9);
        approx::assert_relative_eq!(seen.area, 2.0 * area(&ring) + length, max_relative = 1e-9);
    }
}
