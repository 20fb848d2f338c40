//! OBJ: lines that are not understood, comments, faces before their vertices.

use adslam_surface::MeshFormat;

use super::common::{cube, mesh};
use super::{obj, read, refused};

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
