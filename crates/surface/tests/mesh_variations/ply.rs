//! PLY: strips, properties, headers.

use std::fmt::Write;

use adslam_surface::{Inspection, MeshFormat};

use super::common::{cube, mesh};
use super::{PLY_VERTICES, note, ply, read, refused};

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
