//! STL: solids, and what stands beside them.

use adslam_surface::{Inspection, MeshFormat};

use super::common::{cube, mesh, sphere};
use super::{note, read, refused, solid};

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
