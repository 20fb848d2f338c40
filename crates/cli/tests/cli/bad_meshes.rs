//! Meshes that cannot be used, in the scenario and given with --mesh.

use std::fs::{self, File};

use super::support::{Place, heart};

/// A tetrahedron of 40 mm, or with three faces one that is open, as ASCII STL.
pub fn tetrahedron(faces: usize) -> String {
    let corners = [[0, 0, 0], [40, 0, 0], [0, 40, 0], [0, 0, 40]];
    let mut text = "solid t\n".to_owned();
    for face in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
        .iter()
        .take(faces)
    {
        text += "facet normal 0 0 0\nouter loop\n";
        for corner in face {
            let [x, y, z]: [i32; 3] = corners[*corner];
            text += &format!("vertex {x} {y} {z}\n");
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid t\n"
}

/// A place with a heart of four features, and the same with the mesh in its own file.
fn place() -> Place {
    let small = ("features = 50", "features = 4");
    let placement = (
        "offset_cm = [5.0, 18.0, 110.0]",
        "offset_cm = [5.0, 0.0, 0.0]",
    );
    let own = "[object.mesh]\nfile = \"mesh.stl\"";
    Place::new(&[
        ("heart.toml", &heart(&[small, placement])),
        ("own.toml", &heart(&[small, ("[object.phantom]", own)])),
    ])
}

/// The mesh is refused for the same reason either way, and the caret is where the file is named.
#[track_caller]
fn refused(place: &Place, words: &[&str]) {
    let given = "run heart.toml --mesh mesh.stl --planner local --out run";
    let said = place.refuses(given, &[words, &["mesh.stl", "help:"]].concat());
    assert!(
        !said.err.contains("heart.toml"),
        "the scenario is not to blame: {}",
        said.err
    );
    let own = "run own.toml --planner local --out run";
    let said = place.refuses(own, &[words, &["help:"]].concat());
    assert!(said.err.contains("[own.toml:11:8]"), "{}", said.err);
    assert!(!place.path("run").exists());
}

#[test]
fn a_mesh_takes_the_place_of_the_phantom() {
    let place = place();
    fs::write(place.path("mesh.stl"), tetrahedron(4)).unwrap();
    place.succeeds("run heart.toml --mesh mesh.stl --planner local --out run");
    assert_eq!(place.read("run/features.csv").lines().count(), 1 + 4);
}

#[test]
fn missing() {
    let place = place();
    refused(&place, &["there is no file mesh.stl"]);
    place.refuses("check own.toml", &["there is no file", "[own.toml:11:8]"]);
}

#[test]
fn no_file() {
    let place = place();
    fs::create_dir(place.path("mesh.stl")).unwrap();
    refused(
        &place,
        &[
            "this is not a regular file",
            "give the path of an STL, OBJ or PLY file",
        ],
    );
}

#[test]
fn empty() {
    let place = place();
    for content in ["", "solid t\nendsolid t\n"] {
        fs::write(place.path("mesh.stl"), content).unwrap();
        refused(
            &place,
            &["the file holds no triangles", "export the mesh again"],
        );
    }
}

#[test]
fn open() {
    let place = place();
    fs::write(place.path("mesh.stl"), tetrahedron(3)).unwrap();
    refused(
        &place,
        &["the surface is not closed: 3 edges", "fill the holes"],
    );
}

#[test]
fn not_a_mesh() {
    let place = place();
    fs::write(
        place.path("mesh.stl"),
        "Dear diary, today I learned to deform.\n",
    )
    .unwrap();
    refused(&place, &["cannot be read as STL", "export the mesh again"]);
    fs::write(place.path("mesh.stl"), "solid t\nfacet normal 0 0 here\n").unwrap();
    refused(&place, &["cannot be read as STL", "export the mesh again"]);
}

#[test]
fn enormous() {
    let place = place();
    let file = File::create(place.path("mesh.stl")).unwrap();
    file.set_len(1 << 40).unwrap(); // holes, no blocks
    refused(
        &place,
        &["the file has 1099511627776 bytes", "simplify the mesh"],
    );
}

/// The header of a small file announces four thousand million triangles.
#[test]
fn boastful() {
    let place = place();
    let mut bytes = vec![0; 80];
    bytes.extend(4_000_000_000_u32.to_le_bytes());
    bytes.extend([0; 50]);
    fs::write(place.path("mesh.stl"), bytes).unwrap();
    refused(&place, &["4000000000 triangles"]);
}

#[test]
fn too_coarse() {
    let place = place();
    fs::write(place.path("mesh.stl"), tetrahedron(4)).unwrap();
    fs::write(place.path("many.toml"), heart(&[])).unwrap();
    place.refuses(
        "run many.toml --mesh mesh.stl --planner local --out run",
        &[
            "mesh file mesh.stl: no 50 of the mesh's 4 vertices",
            "ask for fewer features",
        ],
    );
}
