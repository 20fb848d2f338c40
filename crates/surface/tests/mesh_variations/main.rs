//! The same mesh, however a program may have written it: marks of the encoding, line ends, capitals,
//! blanks, several solids, polygons, strips, and what stands beside the mesh.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a failed helper is a failed test"
)]

#[path = "../common/mod.rs"]
mod common;
mod near;
mod obj;
mod ply;
mod polygons;
mod stl;

use std::fmt::Write;

use adslam_surface::{Mesh, MeshFile, MeshFormat};
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
