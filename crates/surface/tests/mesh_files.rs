//! OBJ and PLY files, good and bad, how formats are distinguished, and what is said of a mesh.
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

fn obj(mesh: &Mesh) -> String {
    let mut text = "# Café\nmtllib none.mtl\no thing\n".to_owned();
    for v in &mesh.vertices {
        writeln!(text, "v {} {} {}", v.x, v.y, v.z).unwrap();
    }
    text += "vn 0 0 1\ng part\nusemtl none\ns off\n";
    for [a, b, c] in &mesh.faces {
        writeln!(text, "f {}//1 {}//1 {}//1", a + 1, b + 1, c + 1).unwrap();
    }
    text
}

fn ply_header(format: &str, vertices: usize, faces: usize) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment by a test\nelement vertex {vertices}\n\
         property double x\nproperty double y\nproperty double z\nproperty uchar red\n\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

fn ascii_ply(mesh: &Mesh) -> String {
    let mut text = ply_header("ascii", mesh.vertices.len(), mesh.faces.len());
    for v in &mesh.vertices {
        writeln!(text, "{} {} {} 7", v.x, v.y, v.z).unwrap();
    }
    for [a, b, c] in &mesh.faces {
        writeln!(text, "3 {a} {b} {c}").unwrap();
    }
    text
}

fn binary_ply(mesh: &Mesh, is_big: bool) -> Vec<u8> {
    let name = if is_big { "big" } else { "little" };
    let header = ply_header(
        &format!("binary_{name}_endian"),
        mesh.vertices.len(),
        mesh.faces.len(),
    );
    let mut bytes = header.into_bytes();
    for v in &mesh.vertices {
        for c in v.iter() {
            bytes.extend(if is_big {
                c.to_be_bytes()
            } else {
                c.to_le_bytes()
            });
        }
        bytes.push(7);
    }
    for face in &mesh.faces {
        bytes.push(3);
        for &i in face {
            let i = i32::try_from(i).unwrap();
            bytes.extend(if is_big {
                i.to_be_bytes()
            } else {
                i.to_le_bytes()
            });
        }
    }
    bytes
}

fn all_files(mesh: &Mesh) -> Vec<(MeshFormat, bool, Vec<u8>)> {
    vec![
        (MeshFormat::Obj, false, obj(mesh).into_bytes()),
        (MeshFormat::Ply, false, ascii_ply(mesh).into_bytes()),
        (MeshFormat::Ply, true, binary_ply(mesh, false)),
        (MeshFormat::Ply, true, binary_ply(mesh, true)),
    ]
}

/// The faces as places, which do not depend on how vertices are numbered.
fn places(mesh: &Mesh) -> Vec<[[f64; 3]; 3]> {
    let place = |i: usize| <[f64; 3]>::from(mesh.vertices[i]);
    mesh.faces.iter().map(|face| face.map(place)).collect()
}

#[test]
fn every_format_gives_the_same_faces_with_all_digits() {
    let original = mesh(sphere(40));
    for (format, is_binary, bytes) in all_files(&original) {
        let read = MeshFile::parse(format, &bytes).unwrap();
        assert_eq!((read.format, read.is_binary), (format, is_binary));
        assert_eq!(places(&read.mesh), places(&original), "{format}");
        assert_eq!(read.mesh.vertices.len(), 40);
        assert_eq!(MeshFormat::of_content(&bytes), Some(format));
    }
}

#[test]
fn polygons_are_cut_and_equal_vertices_joined() {
    // A cube of squares, as modellers write it, each with corners of its own, counted backwards.
    let corners = [
        "0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1",
    ];
    let squares = [
        [0, 3, 2, 1],
        [4, 5, 6, 7],
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
    ];
    let mut text = String::new();
    for square in squares {
        for i in square {
            writeln!(text, "v {} 1.0", corners[i]).unwrap();
        }
        text += "f -4 -3/2 \\\n -2/1/1 -1\r\n";
    }
    let read = MeshFile::parse(MeshFormat::Obj, text.as_bytes()).unwrap();
    assert_eq!((read.mesh.vertices.len(), read.mesh.faces.len()), (8, 12));
    read.mesh.check_closed().unwrap();
    approx::assert_abs_diff_eq!(read.mesh.volume(), 1.0);
    text += "f 1 1 2\n";
    let read = MeshFile::parse(MeshFormat::Obj, text.as_bytes()).unwrap();
    assert_eq!((read.collapsed, read.mesh.faces.len()), (1, 12));
}

#[track_caller]
fn refused(format: MeshFormat, bytes: &[u8], words: &[&str]) {
    let error = MeshFile::parse(format, bytes).unwrap_err().to_string();
    for word in words {
        assert!(error.contains(word), "no {word:?} in {error}");
    }
    assert!(!error.contains('\n') && error.len() < 500, "{error}");
}

#[test]
fn bad_lines_of_obj_files_are_named() {
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (line, words) in [
        ("v 1 x 0", ["line 4", "\"x\" is not a number"]),
        ("v 1 0", ["line 4", "fewer than 3 coordinates"]),
        ("f 1 2", ["line 4", "a face with 2 corners"]),
        ("f 1 2 4", ["line 4", "names vertex 4, and there are 3"]),
        ("f 0 1 2", ["line 4", "names vertex 0, and there are 3"]),
        ("f -4 1 2", ["line 4", "names vertex -4, and 3 came before"]),
        ("f 1 2 three", ["line 4", "\"three\" is not the number"]),
        ("f 1 2 9223372036854775807", ["line 4", "and there are 3"]),
        (
            "f 1 2 -9223372036854775808",
            ["line 4", "and 3 came before"],
        ),
    ] {
        refused(
            MeshFormat::Obj,
            format!("{three}{line}\n").as_bytes(),
            &words,
        );
    }
    refused(MeshFormat::Obj, three.as_bytes(), &["no triangles"]);
    let nan = three.replace("v 1 0 0", "v NaN 0 0") + "f 1 2 3\n";
    let error = Mesh::parse(MeshFormat::Obj, nan.as_bytes()).unwrap_err();
    assert!(
        matches!(error, SurfaceError::UnusablePoint { .. }),
        "{error}"
    );
}

#[test]
fn headers_of_ply_files_are_believed_only_as_far_as_there_are_bytes() {
    let good = ascii_ply(&mesh(cube()));
    for (old, new, words) in [
        (
            "vertex 8",
            "vertex 5000000",
            ["5000000 of element vertex", "bytes"],
        ),
        (
            "vertex 8",
            "vertex 99999999999999",
            ["in the header", "are the most"],
        ),
        ("face 12", "face 9999999999999999999999", ["line 9", "face"]),
        (
            "double z",
            "list uchar double z",
            ["in the header", "no number z"],
        ),
        (
            "vertex_indices",
            "corners",
            ["in the header", "no list vertex_indices"],
        ),
        (
            "element face 12",
            "element side 12",
            ["in the header", "no element face or tristrips"],
        ),
        ("\n3 ", "\n3 -1 ", ["face 0", "names vertex -1"]),
        ("\n3 ", "\n200 ", ["line 20", "fewer numbers"]),
        ("\n3 ", "\n-3 ", ["line 20", "a list of -3"]),
        (" 7\n", "\n", ["line 12", "fewer numbers"]),
        ("7\n", "x\n", ["line 12", "\"x\" is not a number"]),
        (
            "uchar red",
            "colour red",
            ["line 8", "\"colour\" is no type"],
        ),
        (
            "end_header",
            "end",
            ["line 11", "\"end\" is not understood"],
        ),
        (
            "format ascii 1.0\n",
            "",
            ["in the header", "no line \"format\""],
        ),
        ("format ascii", "format morse", ["line 2", "morse"]),
    ] {
        assert!(good.contains(old));
        refused(MeshFormat::Ply, good.replace(old, new).as_bytes(), &words);
    }
    let with_empty = good.replace("element face", "element nothing 4000\nelement face");
    refused(
        MeshFormat::Ply,
        with_empty.as_bytes(),
        &["nothing has no properties"],
    );
    let wrong = good.replace("\n3 ", "\n3 9 ").replace("\n3 9 ", "\n4 9 ");
    refused(
        MeshFormat::Ply,
        wrong.as_bytes(),
        &["face 0", "names vertex 9, and there are 8"],
    );
    let binary = binary_ply(&mesh(cube()), false);
    let cut = &binary[..binary.len() - 1];
    refused(MeshFormat::Ply, cut, &["face 11", "end of file"]);
    let cut = &good.as_bytes()[..good.len() - 5];
    refused(MeshFormat::Ply, cut, &["line 31", "fewer numbers"]);
}

#[test]
fn name_and_content_must_agree() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        MeshFile::read(&path).map_err(|error| error.to_string())
    };
    let original = mesh(cube());
    for (format, _, bytes) in all_files(&original) {
        let extension = format.extension();
        for name in [
            format!("mesh.{extension}"),
            format!("MESH.{}", extension.to_uppercase()),
        ] {
            assert_eq!(read(&name, &bytes).unwrap().format, format);
        }
        let error = read("mesh.stl", &bytes).unwrap_err();
        let said = format!(
            "the name says STL, and the content is {format}; let the name end in .{extension}"
        );
        assert!(error.ends_with(&said), "{error}");
        let error = read("mesh.step", &bytes).unwrap_err();
        assert!(error.contains(&format!("looks like {format}")), "{error}");
    }
    let error = read("mesh", b"Dear diary").unwrap_err();
    assert!(error.contains("none of .stl, .obj and .ply"), "{error}");
    let error = read("mesh.obj", b"Dear diary").unwrap_err();
    assert!(error.contains("no triangles"), "{error}");
    let error = read("mesh.ply", b"Dear diary").unwrap_err();
    assert!(error.contains("cannot be read as PLY, line 1"), "{error}");
    let error = read("mesh.stl", b"Dear diary").unwrap_err();
    assert!(
        error.contains("cannot be read as STL, at its start"),
        "{error}"
    );
}

#[test]
fn inspections_tell_what_is_wrong() {
    let good = mesh(cube());
    let seen = Inspection::of(&good);
    assert_eq!(
        (seen.vertices, seen.faces, seen.edges, seen.components),
        (8, 12, 18, 1)
    );
    assert!(seen.is_closed() && seen.twisted_edges == 0);
    approx::assert_abs_diff_eq!(seen.area, 24.0);
    assert_eq!(seen.volume, Some(good.volume()));

    let mut open = good.clone();
    open.faces.pop();
    let seen = Inspection::of(&open);
    assert_eq!((seen.boundary_edges, seen.crowded_edges), (3, 0));
    assert!(!seen.is_closed() && seen.volume.is_none());

    let mut twisted = good.clone();
    twisted.faces[0].swap(0, 1);
    let seen = Inspection::of(&twisted);
    assert!(seen.is_closed() && seen.volume.is_none());
    assert_eq!(seen.twisted_edges, 3);

    let mut two = good.clone();
    two.vertices.extend(
        good.vertices
            .iter()
            .map(|v| v + nalgebra::Vector3::x() * 9.0),
    );
    two.faces
        .extend(good.faces.iter().map(|face| face.map(|i| i + 8)));
    let seen = Inspection::of(&two);
    assert_eq!(seen.components, 2);
    approx::assert_abs_diff_eq!(seen.volume.unwrap(), 16.0, epsilon = 1e-12);
    two.faces.push(good.faces[0]);
    assert_eq!(Inspection::of(&two).crowded_edges, 3);
    assert_eq!(Inspection::of(&Mesh::default()).components, 0);
}

proptest! {
    #![proptest_config(common::cases(1000))]

    #[test]
    fn any_text_gives_a_mesh_or_an_error(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "v", "f", "g", "vn", "\n", "\n", "\n", "1", "-1", "2", "3", "0.5", "1/0/-9", "1//4", "\\\n", "é",
                "99999999999999999999",
            ]),
            0..60,
        ),
    ) {
        let text = words.join(" ");
        if let Ok(read) = MeshFile::parse(MeshFormat::Obj, text.as_bytes()) {
            prop_assert!(read.mesh.faces.iter().flatten().all(|&i| i < read.mesh.vertices.len()));
            let _ = Inspection::of(&read.mesh);
        }
    }

    #[test]
    fn damaged_files_give_a_mesh_or_an_error(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5),
        cut in any::<prop::sample::Index>(),
    ) {
        for (format, _, mut bytes) in all_files(&mesh(cube())) {
            for (at, value) in &changes {
                let at = at.index(bytes.len());
                bytes[at] = *value;
            }
            let _ = MeshFile::parse(format, &bytes);
            let _ = MeshFile::parse(format, &bytes[..cut.index(bytes.len())]);
        }
    }
}
