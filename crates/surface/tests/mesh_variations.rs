//! The same mesh, however a program may have written it: marks of the encoding, line ends, capitals,
//! blanks, several solids, polygons, strips, and what stands beside the mesh.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a failed helper is a failed test"
)]

mod common;

use std::fmt::Write;

use adslam_surface::{Inspection, Mesh, MeshFile, MeshFormat, SurfaceError};
use common::{cube, mesh, sphere};
use proptest::prelude::*;

fn solid(name: &str, mesh: &Mesh) -> String {
    let mut text = format!("solid {name}\n");
    for face in &mesh.faces {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for v in face.map(|i| mesh.vertices[i]) {
            writeln!(text, "      vertex {} {} {}", v.x, v.y, v.z).unwrap();
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid\n"
}

fn obj(mesh: &Mesh) -> String {
    let mut text = "# by a test\no thing\n".to_owned();
    for v in &mesh.vertices {
        writeln!(text, "v {} {} {}", v.x, v.y, v.z).unwrap();
    }
    for [a, b, c] in &mesh.faces {
        writeln!(text, "f {}//1 {}//1 {}//1", a + 1, b + 1, c + 1).unwrap();
    }
    text
}

const PLY_VERTICES: &str = "property double x\nproperty double y\nproperty double z\n";

fn ply(mesh: &Mesh) -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment by a test\nobj_info none\nelement vertex {}\n{PLY_VERTICES}\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices.len(),
        mesh.faces.len()
    );
    for v in &mesh.vertices {
        writeln!(text, "{} {} {}", v.x, v.y, v.z).unwrap();
    }
    for [a, b, c] in &mesh.faces {
        writeln!(text, "3 {a} {b} {c}").unwrap();
    }
    text
}

fn write(format: MeshFormat, mesh: &Mesh) -> String {
    match format {
        MeshFormat::Stl => solid("thing", mesh),
        MeshFormat::Obj => obj(mesh),
        MeshFormat::Ply => ply(mesh),
    }
}

#[track_caller]
fn read(format: MeshFormat, bytes: &[u8]) -> MeshFile {
    MeshFile::parse(format, bytes).unwrap_or_else(|error| {
        panic!("{error}:\n{}", String::from_utf8_lossy(bytes));
    })
}

#[track_caller]
fn refused(format: MeshFormat, bytes: &[u8], words: &[&str]) {
    let error = MeshFile::parse(format, bytes).unwrap_err().to_string();
    for word in words {
        assert!(error.contains(word), "no {word:?} in {error}");
    }
}

/// The one note on a file that is read.
#[track_caller]
fn note(format: MeshFormat, bytes: &[u8]) -> String {
    let notes = read(format, bytes).notes;
    assert_eq!(notes.len(), 1, "{notes:?}");
    notes[0].clone()
}

/// Words of a text with the letters that are chosen in capitals.
fn capitals(text: &str, chosen: &[bool]) -> String {
    let mut chosen = chosen.iter().cycle();
    text.chars()
        .map(|c| match chosen.next() {
            // Letters of numbers may be either too.
            Some(true) => c.to_ascii_uppercase(),
            _ => c,
        })
        .collect()
}

proptest! {
    #![proptest_config(common::cases(300))]

    #[test]
    fn is_read_the_same(
        format in prop::sample::select(MeshFormat::ALL.to_vec()),
        chosen in prop::collection::vec(any::<bool>(), 1..50),
        has_mark: bool,
        ending in prop::sample::select(vec!["\n", "\r\n", "\r"]),
        blanks in prop::collection::vec(prop::sample::select(vec!["", "", " ", "\t", "  \t "]), 1..9),
        empty_lines in prop::collection::vec(prop::sample::select(vec![0, 0, 0, 1, 2]), 1..9),
    ) {
        let original = mesh(sphere(12));
        let plain = read(format, write(format, &original).as_bytes());
        let text = capitals(&write(format, &original), &chosen);
        let mut varied = if has_mark { "\u{feff}".to_owned() } else { String::new() };
        let mut blanks = blanks.iter().cycle();
        let mut empty_lines = empty_lines.iter().cycle();
        for (n, line) in text.lines().enumerate() {
            // Only "ply" has to be the first line.
            if n > 0 || format != MeshFormat::Ply {
                varied += &ending.repeat(*empty_lines.next().unwrap());
                varied += blanks.next().unwrap();
            }
            varied += &line.replace(' ', &format!(" {}", blanks.next().unwrap()));
            varied += blanks.next().unwrap();
            varied += ending;
        }
        prop_assert_eq!(MeshFormat::of_content(varied.as_bytes()), Some(format));
        prop_assert_eq!(read(format, varied.as_bytes()), plain);
    }

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

#[test]
fn several_solids_are_one_mesh() {
    let (one, two) = (mesh(cube()), mesh(sphere(20)));
    let two = two.scaled_and_moved(1.0, nalgebra::Vector3::x() * 9.0);
    let text = solid("one", &one) + "\n" + &solid("two", &two);
    let found = read(MeshFormat::Stl, text.as_bytes());
    let seen = Inspection::of(&found.mesh);
    assert_eq!(
        (seen.vertices, seen.faces, seen.components),
        (8 + 20, 12 + 36, 2)
    );
    assert!(seen.is_closed() && found.notes.is_empty());
}

#[test]
fn what_stands_beside_solids_is_told() {
    let cube = mesh(cube());
    let text = solid("thing", &cube);
    let without_end = text.replace("endsolid\n", "");
    let said = note(MeshFormat::Stl, without_end.as_bytes());
    assert!(
        said.starts_with("line 1: a solid begins that no \"endsolid\" ends"),
        "{said}"
    );
    let said = note(MeshFormat::Stl, (without_end + &text).as_bytes());
    assert!(said.starts_with("line 1: a solid begins"), "{said}");
    let junk = format!("# by a test\n{text}0 left\n");
    let said = note(MeshFormat::Stl, junk.as_bytes());
    assert_eq!(
        said,
        "2 lines, the first of them line 1: outside of every solid, left out"
    );
}

#[test]
fn wrong_lines_of_stl_files_are_named() {
    let text = solid("thing", &mesh(cube()));
    for (old, new, words) in [
        (
            "endfacet",
            "",
            [
                "line 9",
                "a facet begins within the facet that begins in line 2",
            ],
        ),
        (
            "    endloop\n  endfacet\n",
            "endsolid\n",
            ["line 7", "a solid ends within"],
        ),
        (
            "    endloop\n  endfacet\n",
            "solid\n",
            ["line 7", "a solid begins within"],
        ),
        ("vertex", "vertx", ["line 4", "\"vertx\" is not understood"]),
        ("vertex ", "vertex x", ["line 4", "is not a number"]),
        ("vertex", "vertex 1", ["line 4", "more than 3 coordinates"]),
        (
            "vertex",
            "vertex 1 2\nvertex",
            ["line 4", "fewer than 3 coordinates"],
        ),
        (
            "vertex",
            "vertex 1 2 3\nvertex",
            ["line 7", "more than 3 corners"],
        ),
        (
            "vertex -1",
            "endfacet -1",
            ["line 4", "a facet with 0 corners"],
        ),
        (
            "  facet normal 0 0 0\n",
            "",
            ["line 3", "a vertex outside of every facet"],
        ),
        (
            "solid thing\n",
            "",
            ["line 1", "a facet outside of every solid"],
        ),
    ] {
        assert!(text.contains(old), "{old}");
        refused(
            MeshFormat::Stl,
            text.replacen(old, new, 1).as_bytes(),
            &words,
        );
    }
}

#[test]
fn bytes_after_a_binary_stl_are_told() {
    for header in ["", "solid thing"] {
        let mut bytes = header.as_bytes().to_vec();
        bytes.resize(80, 0);
        let cube = mesh(cube());
        bytes.extend(u32::try_from(cube.faces.len()).unwrap().to_le_bytes());
        for face in &cube.faces {
            bytes.extend([0; 12]);
            for c in face.iter().flat_map(|&i| cube.vertices[i].iter()) {
                bytes.extend(if *c > 0.0 { 1.0_f32 } else { -1.0 }.to_le_bytes());
            }
            bytes.extend([0; 2]);
        }
        let whole = read(MeshFormat::Stl, &bytes);
        assert!(whole.is_binary && whole.notes.is_empty());
        for count in [1, 49, 50, 1000] {
            let longer = [bytes.as_slice(), &vec![b'x'; count]].concat();
            let found = read(MeshFormat::Stl, &longer);
            assert_eq!(found.mesh, whole.mesh);
            let said = format!("{count} bytes after the last triangle are left out");
            assert_eq!(found.notes, [said]);
        }
    }
    let nothing = [&[0; 84][..], b"xyz"].concat();
    let words = ["announces no triangles, and 3 bytes follow"];
    refused(MeshFormat::Stl, &nothing, &words);
}

#[test]
fn text_of_two_bytes_for_each_letter_is_named() {
    for format in MeshFormat::ALL {
        let text = write(format, &mesh(cube()));
        let wide = text.encode_utf16().flat_map(u16::to_le_bytes);
        let without_mark: Vec<u8> = wide.collect();
        let with_mark = [&[0xff, 0xfe], without_mark.as_slice()].concat();
        refused(format, &with_mark, &["UTF-16"]);
        refused(format, &without_mark, &["UTF-16"]);
    }
}

#[test]
fn no_line_of_obj_files_shifts_what_follows() {
    let cube = mesh(cube());
    let plain = read(MeshFormat::Obj, obj(&cube).as_bytes());
    for (old, new) in [
        ("v ", "v\t"),
        ("v ", "\u{feff}v "),
        ("v ", "# C:\\thing\\\nv "),
        ("v ", "mtllib C:\\thing\\\nv "),
        ("v ", "o 1 2 3\nv "),
        ("v ", "vn 1 2 \\\n3\nv "),
        ("v ", "v \\\n"),
        ("\nf ", " # a corner\\\nf "),
        ("\nf ", " 0.5 0.5 0.5\nf "),
    ] {
        let text = obj(&cube);
        assert!(text.contains(old));
        let text = text.replacen(old, new, 1);
        assert_eq!(read(MeshFormat::Obj, text.as_bytes()), plain, "{text}");
    }
    let harmless = obj(&cube).replacen("\nv ", "\nExported by a test 1.2\nv ", 2);
    let found = read(MeshFormat::Obj, harmless.as_bytes());
    assert_eq!(found.mesh, plain.mesh);
    let said = "2 lines, the first of them line 3: not understood, left out";
    assert_eq!(found.notes, [said]);
    for line in [
        "vertex 1 2 3",
        "v\u{a0}1\u{a0}2\u{a0}3",
        "face 1/1 2/2 3/3",
        "x 1 2 3",
        "F1 2 3",
    ] {
        let text = obj(&cube).replacen("\nv ", &format!("\n{line}\nv "), 1);
        let words = ["line 3", "may be a vertex or a face"];
        refused(MeshFormat::Obj, text.as_bytes(), &words);
    }
}

#[test]
fn faces_may_come_before_their_vertices() {
    let text = obj(&mesh(cube()));
    let (vertices, faces): (Vec<&str>, Vec<&str>) =
        text.lines().partition(|line| line.starts_with("v "));
    let turned = [faces, vertices].concat().join("\n");
    assert_eq!(
        read(MeshFormat::Obj, turned.as_bytes()),
        read(MeshFormat::Obj, text.as_bytes())
    );
    let backwards = "v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n";
    refused(
        MeshFormat::Obj,
        backwards.as_bytes(),
        &["line 3", "vertex -3, and 2 came before it"],
    );
}

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

/// The octahedron as strips: its belt, and two pairs of triangles.
#[test]
fn strips_turn_every_second_triangle_round() {
    let places = "1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n0 0 1\n0 0 -1\n";
    let head = |count: usize| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 6\n{PLY_VERTICES}element tristrips {count}\n\
             property list int int vertex_indices\nend_header\n{places}"
        )
    };
    let strips = ["4 4 0 1 5", "4 4 1 2 5", "4 4 2 3 5", "4 4 3 0 5"];
    let apart = head(4) + &strips.join("\n") + "\n";
    let restarted = "19 4 0 1 5 -1 4 1 2 5 -1 4 2 3 5 -1 4 3 0 5\n";
    let restarted = head(1) + restarted;
    // Repeated numbers lead on from one strip to the next, an even number of them so that none is turned.
    let led_on = head(1) + "22 4 0 1 5 5 4 4 1 2 5 5 4 4 2 3 5 5 4 4 3 0 5\n";
    let expected = read(MeshFormat::Ply, apart.as_bytes());
    let seen = Inspection::of(&expected.mesh);
    assert_eq!((seen.faces, seen.twisted_edges), (8, 0));
    approx::assert_relative_eq!(seen.volume.unwrap(), 4.0 / 3.0);
    assert!(expected.notes.is_empty());
    for text in [restarted, led_on] {
        assert_eq!(read(MeshFormat::Ply, text.as_bytes()), expected);
    }
    let wrong = head(1) + "3 0 1 6\n";
    let words = ["tristrips 0", "names vertex 6, and there are 6"];
    refused(MeshFormat::Ply, wrong.as_bytes(), &words);
    let wrong = head(1) + "4 0 1 2 -2\n";
    refused(MeshFormat::Ply, wrong.as_bytes(), &["names vertex -2"]);
}

#[test]
fn unusual_ply_files() {
    let cube = mesh(cube());
    let text = ply(&cube);
    let plain = read(MeshFormat::Ply, text.as_bytes());
    for (old, new) in [
        ("uchar int", "float double"),
        ("uchar int", "int8 uint32"),
        ("vertex_indices", "vertex_index"),
        ("-1 ", "-1. "),
        ("-1 ", "-.1e+1 "),
        ("comment by a test", "comment"),
        ("element face", "element nothing 0\nelement face"),
        ("comment by a test", "comment C\u{f4}t\u{e9} \u{b0}"),
    ] {
        assert!(text.contains(old), "{old}");
        let text = text.replace(old, new);
        assert_eq!(read(MeshFormat::Ply, text.as_bytes()), plain, "{text}");
    }
    let longer = text.clone() + "\n1 2 3\n";
    let said = note(MeshFormat::Ply, longer.as_bytes());
    assert!(said.ends_with("after the last element, left out"), "{said}");
    let longer = text.replacen("-1\n", "-1 9 9\n", 1);
    let said = note(MeshFormat::Ply, longer.as_bytes());
    assert!(said.contains("longer than the header says"), "{said}");
}

#[test]
fn every_property_and_element_of_a_ply_file_has_its_place() {
    let places = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"];
    let faces = ["3 0 2 1", "3 0 1 3", "3 1 2 3", "3 0 3 2"];
    let plain = format!(
        "ply\nformat ascii 1.0\nelement vertex 4\n{PLY_VERTICES}element face 4\n\
         property list uchar int vertex_indices\nend_header\n{}\n{}\n",
        places.join("\n"),
        faces.join("\n")
    );
    // Faces first, a second property x, lists and elements of other things.
    let mut other = "ply\nformat ascii 1.0\nelement face 4\nproperty uchar red\nproperty list uchar float texture\n\
                     property list uchar int vertex_indices\nelement edge 2\nproperty list int int ends\n\
                     element vertex 4\nproperty list uchar uchar none\nproperty double x\nproperty float x\n\
                     property double y\nproperty double z\nend_header\n"
        .to_owned();
    faces
        .iter()
        .for_each(|face| writeln!(other, "255 2 0.5 0.5 {face}").unwrap());
    other += "2 0 1\n0\n";
    for place in places {
        let (x, rest) = place.split_once(' ').unwrap();
        writeln!(other, "1 9 {x} 77 {rest}").unwrap();
    }
    let plain = read(MeshFormat::Ply, plain.as_bytes());
    assert_eq!(plain.mesh.volume(), 1.0 / 6.0);
    assert_eq!(read(MeshFormat::Ply, other.as_bytes()), plain);
}

#[test]
fn the_header_of_a_binary_ply_ends_as_its_first_line_does() {
    let cube = mesh(cube());
    for ending in ["\n", "\r\n", "\r"] {
        let header = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\n\
             property float z\nelement face {}\nproperty list uchar uchar vertex_indices\nend_header\n",
            cube.faces.len()
        );
        let mut bytes = header.replace('\n', ending).into_bytes();
        for v in &cube.vertices {
            // The first byte of the body is a line feed.
            let x = if v.x > 0.0 { 1.0_f32 } else { -1.0 }.to_bits() & !0xff | 0x0a;
            bytes.extend(x.to_le_bytes());
            for c in [v.y, v.z] {
                bytes.extend(if c > 0.0 { 1.0_f32 } else { -1.0 }.to_le_bytes());
            }
        }
        for face in &cube.faces {
            bytes.push(3);
            bytes.extend(face.map(|i| u8::try_from(i).unwrap()));
        }
        let found = read(MeshFormat::Ply, &bytes);
        assert_eq!(found.mesh.vertices.len(), 8);
        found.mesh.check_closed().unwrap();
        approx::assert_relative_eq!(found.mesh.volume(), 8.0, max_relative = 1e-5);
        bytes.extend(b"more");
        let said = note(MeshFormat::Ply, &bytes);
        assert_eq!(said, "4 bytes after the last element are left out");
    }
}

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
