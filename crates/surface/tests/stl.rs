//! STL files, good and bad.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a failed helper is a failed test"
)]

mod common;

use std::path::Path;

use adslam_surface::{MAX_MESH_FACES, Mesh, MeshFile, MeshFormat, SurfaceError};
use common::{Point, cube, mesh, sphere};
use nalgebra::Vector3;
use proptest::prelude::*;

#[expect(clippy::cast_possible_truncation, reason = "STL stores 32-bit numbers")]
fn binary(mesh: &Mesh, header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend((mesh.faces.len() as u32).to_le_bytes());
    for face in &mesh.faces {
        bytes.extend([0; 12]);
        for c in face.iter().flat_map(|&i| mesh.vertices[i].iter()) {
            bytes.extend((*c as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii(mesh: &Mesh) -> String {
    let mut text = String::from("solid thing\n");
    for face in &mesh.faces {
        text += "facet normal 0 0 0\n outer loop\n";
        for &i in face {
            let v = mesh.vertices[i];
            text += &format!("  vertex {} {} {}\n", v.x, v.y, v.z);
        }
        text += " endloop\nendfacet\n";
    }
    text + "endsolid thing\n"
}

#[test]
fn binary_and_ascii_give_the_same_mesh() {
    let original = mesh(cube());
    let from_binary = Mesh::parse(MeshFormat::Stl, &binary(&original, b"made by a test")).unwrap();
    let from_ascii = Mesh::parse(MeshFormat::Stl, ascii(&original).as_bytes()).unwrap();
    assert_eq!(from_binary, from_ascii);
    assert_eq!(
        (from_binary.vertices.len(), from_binary.faces.len()),
        (8, 12)
    );
    approx::assert_abs_diff_eq!(from_binary.volume(), 8.0);
    let named = "solid\n".to_owned() + ascii(&original).split_once('\n').unwrap().1;
    assert_eq!(
        Mesh::parse(MeshFormat::Stl, named.as_bytes()).unwrap(),
        from_binary
    );
}

#[test]
fn binary_files_may_begin_with_solid() {
    let original = mesh(sphere(30));
    for header in [
        &b"solid"[..],
        b"solid exported",
        b"solid \nfacet normal 0 0 0\n",
    ] {
        assert_eq!(
            Mesh::parse(MeshFormat::Stl, &binary(&original, header))
                .unwrap()
                .faces
                .len(),
            56
        );
    }
}

#[test]
fn collapsed_triangles_are_dropped_and_zeros_of_both_signs_merged() {
    let mut original = mesh(vec![
        Point::new(0.0, 0.0, 0.0),
        Point::new(1.0, -0.0, 0.0),
        Point::new(-0.0, 1.0, 0.0),
        Point::new(0.0, -0.0, 1.0),
    ]);
    original.faces.push([0, 0, 1]);
    let read = Mesh::parse(MeshFormat::Stl, &binary(&original, b"")).unwrap();
    assert_eq!((read.vertices.len(), read.faces.len()), (4, 4));
    approx::assert_abs_diff_eq!(read.volume(), 1.0 / 6.0);
}

#[test]
fn bad_bytes_are_refused_with_the_reason() {
    let good = binary(&mesh(cube()), b"");
    let bad = |bytes: &[u8]| Mesh::parse(MeshFormat::Stl, bytes).unwrap_err();
    assert!(matches!(bad(b""), SurfaceError::EmptyMesh));
    assert!(matches!(bad(b"not a mesh"), SurfaceError::Malformed { .. }));
    assert!(matches!(
        bad(b"solid nothing\nendsolid nothing\n"),
        SurfaceError::EmptyMesh
    ));
    assert!(matches!(
        bad(b"solid nothing\nfacet normal"),
        SurfaceError::Malformed { .. }
    ));
    assert!(matches!(bad(&[0; 84]), SurfaceError::EmptyMesh));

    let error = bad(&good[..good.len() - 1]);
    assert!(matches!(
        error,
        SurfaceError::WrongSize {
            faces: 12,
            expected: 684,
            given: 683
        }
    ));
    assert!(error.to_string().contains("684"), "{error}");
    let text = ascii(&mesh(cube()));
    let error = bad(&text.as_bytes()[..text.len() / 2]);
    assert!(
        matches!(error, SurfaceError::Malformed { ref place, .. } if place == "line 43"),
        "{error}"
    );

    // Of a count that the size does not bear out, nothing is believed.
    let mut huge = good.clone();
    huge[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(matches!(
        bad(&huge),
        SurfaceError::WrongSize {
            faces: 4_294_967_295,
            ..
        }
    ));
    let letters = [b'x'; 1000];
    assert!(matches!(bad(&letters), SurfaceError::Malformed { .. }));
    let faces = MAX_MESH_FACES + 1;
    let mut many = vec![0; 84 + 50 * usize::try_from(faces).unwrap()];
    many[80..84].copy_from_slice(&u32::try_from(faces).unwrap().to_le_bytes());
    assert!(matches!(
        bad(&many),
        SurfaceError::TooManyFaces {
            limit: MAX_MESH_FACES,
            ..
        }
    ));
    let mut infinite = good.clone();
    infinite[84 + 12..84 + 16].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert!(matches!(
        bad(&infinite),
        SurfaceError::UnusablePoint { index: 0, .. }
    ));
    for word in ["NaN", "inf", "1e39"] {
        let text = text.replacen("vertex -1", &format!("vertex {word}"), 1);
        let error = bad(text.as_bytes());
        let is_first = matches!(error, SurfaceError::UnusablePoint { index: 0, .. });
        assert!(is_first, "{word}: {error}");
    }

    let mut open = mesh(cube());
    open.faces.pop();
    let error = bad(&binary(&open, b""));
    assert!(
        matches!(
            error,
            SurfaceError::Open {
                count: 3,
                shared: 1,
                ..
            }
        ),
        "{error}"
    );
    assert!(error.to_string().contains("3 edges"), "{error}");
}

#[test]
fn bad_files_are_named_in_the_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mesh.stl");
    let inner = |path: &Path| match MeshFile::read(path).unwrap_err() {
        SurfaceError::InFile { path: named, cause } => {
            assert_eq!(named, path);
            *cause
        }
        other => panic!("{other}"),
    };
    assert!(matches!(inner(&path), SurfaceError::Unreadable { .. }));
    assert!(matches!(inner(folder.path()), SurfaceError::NotAFile));
    if Path::new("/dev/zero").exists() {
        assert!(matches!(
            inner(Path::new("/dev/zero")),
            SurfaceError::NotAFile
        ));
    }
    // A sparse file takes no space, and must take no memory either.
    std::fs::File::create(&path)
        .unwrap()
        .set_len(1 << 40)
        .unwrap();
    let error = inner(&path);
    assert!(
        matches!(
            error,
            SurfaceError::TooManyBytes {
                bytes: 1_099_511_627_776,
                ..
            }
        ),
        "{error}"
    );
    std::fs::write(&path, b"").unwrap();
    assert!(matches!(inner(&path), SurfaceError::EmptyMesh));
    std::fs::write(&path, binary(&mesh(cube()), b"")).unwrap();
    assert_eq!(MeshFile::read(&path).unwrap().mesh.faces.len(), 12);
}

#[test]
fn meshes_are_scaled_then_moved() {
    let moved = mesh(cube()).scaled_and_moved(0.5, Vector3::new(10.0, 0.0, -1.0));
    let (low, high) = moved.bounds().unwrap();
    assert_eq!(
        (low, high),
        (Point::new(9.5, -0.5, -1.5), Point::new(10.5, 0.5, -0.5))
    );
    approx::assert_abs_diff_eq!(moved.volume(), 1.0);
    moved.check_closed().unwrap();
    let mirrored = mesh(cube()).scaled_and_moved(-1.0, Vector3::zeros());
    approx::assert_abs_diff_eq!(mirrored.volume(), 8.0);
    assert_eq!(Mesh::default().bounds(), None);
    assert_eq!(Mesh::default().volume(), 0.0);
    assert!(
        mesh(cube())
            .scaled_and_moved(f64::NAN, Vector3::zeros())
            .check_closed()
            .is_err()
    );
}

/// The heart segmented from CT that the published experiments used; not part of the repository.
#[test]
fn ct_heart_where_there_is_one() {
    let Some(path) = std::env::var_os("ADSLAM_HEART_STL") else {
        println!("skipped: ADSLAM_HEART_STL does not name a file");
        return;
    };
    let heart = MeshFile::read(Path::new(&path)).unwrap().mesh;
    assert_eq!((heart.faces.len(), heart.vertices.len()), (19086, 9543));
    let heart = heart.scaled_and_moved(0.1, Vector3::new(5.0, 18.0, 110.0));
    let nearest = heart
        .vertices
        .iter()
        .map(|v| v.coords.norm())
        .fold(f64::INFINITY, f64::min);
    approx::assert_abs_diff_eq!(nearest, 3.6, epsilon = 0.05);
    assert!(heart.volume() > 500.0, "{} cm³", heart.volume());
    assert_eq!(
        adslam_surface::pick_features(&heart, 50, 1).unwrap().len(),
        50
    );
}

proptest! {
    #![proptest_config(common::cases(2000))]

    #[test]
    fn any_bytes_give_a_mesh_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        prop_assert!(Mesh::parse(MeshFormat::Stl, &bytes).is_err());
        let _ = Mesh::parse(MeshFormat::Stl, &[b"solid ", bytes.as_slice()].concat());
    }

    #[test]
    fn damaged_files_give_a_mesh_or_an_error(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
        cut in any::<prop::sample::Index>(),
    ) {
        for mut bytes in [binary(&mesh(cube()), b""), ascii(&mesh(cube())).into_bytes()] {
            for (at, value) in &changes {
                let at = at.index(bytes.len());
                bytes[at] = *value;
            }
            let _ = Mesh::parse(MeshFormat::Stl, &bytes);
            let _ = Mesh::parse(MeshFormat::Stl, &bytes[..cut.index(bytes.len())]);
        }
    }

    #[test]
    fn meshes_survive_the_file(count in 4_usize..60) {
        let original = mesh(sphere(count));
        let read = Mesh::parse(MeshFormat::Stl, &binary(&original, b"")).unwrap();
        prop_assert_eq!(read.vertices.len(), count);
        prop_assert!((read.volume() - original.volume()).abs() < 1e-5);
        prop_assert_eq!(&read, &Mesh::parse(MeshFormat::Stl, ascii(&read).as_bytes()).unwrap());
    }
}
