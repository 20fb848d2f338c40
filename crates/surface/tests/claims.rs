//! What a mesh file claims takes no memory: that grows with its bytes alone.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

use adslam_surface::{MAX_MESH_FACES, MeshFile, MeshFormat};
use allocation_counter::measure;

/// The reader refuses the bytes, says `limit`, and takes no more than `most` bytes of memory.
#[track_caller]
fn refused(format: MeshFormat, bytes: &[u8], limit: &str, most: u64) {
    let mut said = String::new();
    let memory = measure(|| said = MeshFile::parse(format, bytes).unwrap_err().to_string());
    assert!(said.contains(limit), "{said}");
    assert!(memory.bytes_max < most, "{said}: {memory:?}");
}

const KIB: u64 = 1 << 10;
const MIB: u64 = 1 << 20;

fn ply(format: &str, vertices: &str, faces: &str, list: &str, body: &[u8]) -> Vec<u8> {
    let header = format!(
        "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
         property float z\nelement face {faces}\nproperty list {list} vertex_indices\nend_header\n"
    );
    [header.as_bytes(), body].concat()
}

#[test]
fn an_stl_header() {
    let header = |faces: u32| [&[0; 80][..], &faces.to_le_bytes(), &[0; 50]].concat();
    for faces in [2, 1_000_000_000, u32::MAX] {
        let announced = format!("announces {faces} triangles");
        refused(MeshFormat::Stl, &header(faces), &announced, 10 * KIB);
    }
}

#[test]
fn a_ply_header() {
    let binary = "binary_little_endian";
    for format in [binary, "ascii"] {
        let bytes = |vertices, faces| ply(format, vertices, faces, "uchar int", &[0; 40]);
        let of = |count: &str| format!("{count} of element");
        let most = "6000000 are the most";
        refused(MeshFormat::Ply, &bytes("1000000000", "1"), most, 50 * KIB);
        refused(MeshFormat::Ply, &bytes("1", "1000000000"), most, 50 * KIB);
        // More than the file has bytes, and fewer.
        refused(MeshFormat::Ply, &bytes("5000000", "1"), "bytes", 50 * KIB);
        refused(
            MeshFormat::Ply,
            &bytes("4", "5000000"),
            &of("5000000"),
            50 * KIB,
        );
        refused(MeshFormat::Ply, &bytes("100", "1"), "", 100 * KIB);
    }
}

#[test]
fn a_ply_list() {
    for (list, count) in [
        ("uint uint", &u32::MAX.to_le_bytes()[..]),
        ("ushort uint", &u16::MAX.to_le_bytes()),
    ] {
        let body = [&[0; 12], count, &[0; 8]].concat();
        let bytes = ply("binary_little_endian", "1", "1", list, &body);
        refused(MeshFormat::Ply, &bytes, "end of file", 10 * KIB);
    }
    let bytes = ply("ascii", "1", "1", "uint int", b"0 0 0\n4294967295 0 0 0\n");
    refused(MeshFormat::Ply, &bytes, "line 11", 10 * KIB);
}

/// A line of a million words takes no more than one of three.
#[test]
fn a_ply_line() {
    let line = "0 ".repeat(1_000_000);
    let bytes = ply("ascii", "1", "1", "uchar int", line.as_bytes());
    let said = "end of file after 0 of 1 elements face";
    refused(MeshFormat::Ply, &bytes, said, 10 * KIB);
}

#[test]
fn a_face_with_millions_of_corners() {
    const CORNERS: u32 = 2_000_003;
    assert_eq!(u64::from(CORNERS), MAX_MESH_FACES + 3);
    let limit = "the limit is 2000000";
    // The line twice, and its corners.
    let face = " 1".repeat(CORNERS as usize);
    let text = format!("v 0 0 0\nf{face}\n");
    refused(MeshFormat::Obj, text.as_bytes(), limit, 100 * MIB);
    let corners = vec![0; CORNERS as usize];
    let body = [&[0; 12][..], &CORNERS.to_le_bytes(), &corners].concat();
    let bytes = ply("binary_little_endian", "1", "1", "uint uchar", &body);
    refused(MeshFormat::Ply, &bytes, limit, 100 * MIB);
}
