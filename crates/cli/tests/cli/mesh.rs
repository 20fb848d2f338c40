//! `adslam mesh`, and objects of every format

use std::fs;

use super::bad_meshes::tetrahedron;
use super::support::{Place, heart};

/// The tetrahedron of the STL files in the other formats.
const OBJ: &str = "v 0 0 0\nv 40 0 0\nv 0 40 0\nv 0 0 40\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                   property float z\nelement face 4\nproperty list uchar int vertex_index\n\
                   end_header\n0 0 0\n40 0 0\n0 40 0\n0 0 40\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

fn place() -> Place {
    Place::new(&[
        ("mesh.stl", &tetrahedron(4)),
        ("open.stl", &tetrahedron(3)),
        ("mesh.obj", OBJ),
        ("mesh.ply", PLY),
    ])
}

#[test]
fn every_format_is_described_alike() {
    let place = place();
    for (file, format) in [
        ("mesh.stl", "STL"),
        ("mesh.obj", "OBJ"),
        ("mesh.ply", "PLY"),
    ] {
        let said = place.succeeds(&format!("mesh {file} --features 4"));
        for part in [
            &format!("{file}: {format}, text, taken as mm"),
            "triangles 4",
            "closed yes",
            "size 4.00, 4.00, 4.00 cm",
            "volume 10.7 cm³",
            "It will serve as an object with 4 features.",
        ] {
            assert!(said.out.contains(part), "no {part:?} in {}", said.out);
        }
        let said = place.succeeds(&format!("mesh {file} --features 4 --json --unit m"));
        let report = serde_json::from_str::<serde_json::Value>(&said.out).unwrap()["mesh"].clone();
        assert_eq!(report["format"], format);
        assert_eq!(
            report["max_cm"],
            serde_json::json!([4000.0, 4000.0, 4000.0])
        );
        assert_eq!(
            (&report["serves"], &report["closed"]),
            (&true.into(), &true.into())
        );
        assert!(
            report["notes"][0]
                .as_str()
                .unwrap()
                .contains("is it another"),
            "{report}"
        );
    }
}

#[test]
fn what_will_not_serve_is_described_and_refused() {
    let place = place();
    let words = [
        "open.stl will not serve",
        "3 edges are not shared",
        "fill the holes",
    ];
    let said = place.refuses("mesh open.stl", &words);
    assert!(said.out.contains("boundary edges 3"), "{said:?}");
    let said = place.refuses("mesh open.stl --json", &words);
    let report = serde_json::from_str::<serde_json::Value>(&said.out).unwrap()["mesh"].clone();
    assert_eq!(
        (&report["serves"], &report["boundary_edges"]),
        (&false.into(), &3.into())
    );
    place.refuses(
        "mesh mesh.obj",
        &["no 50 of the mesh's 4 vertices", "ask for fewer features"],
    );
    place.refuses("mesh none.stl", &["none.stl", "cannot read the file"]);
    place.refuses(
        "mesh mesh.obj --unit inch",
        &["no unit of length is called", "there are mm, cm, m"],
    );
    place.refuses("mesh mesh.obj --features 3", &["3 is not in 4..=2000"]);
    fs::write(place.path("wrong.stl"), OBJ).unwrap();
    place.refuses(
        "mesh wrong.stl",
        &["the name says STL, and the content is OBJ", ".obj"],
    );
}

/// The same run, whatever the format, and turned by the scenario as a file would be turned by hand.
#[test]
fn objects_of_every_format() {
    let place = place();
    let scenario = |file: &str, extra: &str| {
        let own = format!("[object.mesh]\nfile = \"{file}\"\noffset_cm = [5.0, 0.0, 0.0]\n{extra}");
        heart(&[
            ("[object.phantom]", &own),
            ("features = 50", "features = 4"),
        ])
    };
    let mut written = Vec::new();
    for file in ["mesh.stl", "mesh.obj", "mesh.ply"] {
        fs::write(place.path("s.toml"), scenario(file, "")).unwrap();
        place.succeeds("run s.toml --planner predetermined --out run");
        written.push(place.read("run/truth.tum") + &place.read("run/features.csv"));
    }
    assert!(written.iter().all(|run| *run == written[0]));

    let turned = OBJ.replace("v 40 0 0", "v 0 40 0").replacen(
        "v 0 40 0\nv 0 40 0",
        "v 0 40 0\nv -40 0 0",
        1,
    );
    fs::write(place.path("turned.obj"), turned).unwrap();
    let mut rows = Vec::new();
    for (file, extra) in [
        ("turned.obj", ""),
        ("mesh.obj", "rotation_deg = [0.0, 0.0, 90.0]"),
    ] {
        fs::write(place.path("s.toml"), scenario(file, extra)).unwrap();
        place.succeeds("run s.toml --planner predetermined --out run");
        let table = place.read("run/features.csv");
        let numbers = table
            .lines()
            .skip(1)
            .flat_map(|row| row.split(',').skip(3).take(3));
        rows.push(
            numbers
                .map(|n| n.parse::<f64>().unwrap())
                .collect::<Vec<_>>(),
        );
    }
    assert_eq!(rows[0].len(), 12);
    for (a, b) in rows[0].iter().zip(&rows[1]) {
        assert!((a - b).abs() < 1e-9, "{rows:?}");
    }
}
