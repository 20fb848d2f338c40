//! STL, binary and ASCII.

use std::io::Cursor;

use super::{Joiner, MeshFormat, check_faces};
use crate::SurfaceError;

/// Bytes before the first triangle of a binary file: a free text and the count.
const HEADER: usize = 84;
/// Bytes of a binary triangle: normal, corners, attribute.
const RECORD: u64 = 50;

/// Whether this is STL by its first word, or by its size for a binary file.
pub(super) fn is_stl(bytes: &[u8]) -> bool {
    is_binary(bytes) || bytes.starts_with(b"solid")
}

/// Reads the triangles; returns whether the file is binary.
pub(super) fn parse(bytes: &[u8], joiner: &mut Joiner) -> Result<bool, SurfaceError> {
    if bytes.is_empty() {
        return Err(SurfaceError::EmptyMesh);
    }
    // Many binary files begin with "solid" too; the size tells.
    let is_ascii = !is_binary(bytes) && bytes.starts_with(b"solid");
    if !is_ascii {
        check_binary(bytes)?;
    }
    join(bytes, is_ascii, joiner)?;
    Ok(!is_ascii)
}

/// The count in the header, if the bytes are long enough to be a binary file.
fn announced_faces(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u64::from(u32::from_le_bytes(count.try_into().ok()?)))
}

fn size_of(faces: u64) -> u64 {
    HEADER as u64 + RECORD * faces
}

fn is_binary(bytes: &[u8]) -> bool {
    announced_faces(bytes).is_some_and(|faces| size_of(faces) == bytes.len() as u64)
}

fn check_binary(bytes: &[u8]) -> Result<(), SurfaceError> {
    let given = bytes.len() as u64;
    let Some(faces) = announced_faces(bytes) else {
        return Err(not_stl(
            0,
            format!("{given} bytes are fewer than the {HEADER} of a binary header"),
        ));
    };
    // The size first: of bytes that are not STL the count means nothing.
    let expected = size_of(faces);
    if expected != given {
        return Err(SurfaceError::WrongSize {
            faces,
            expected,
            given,
        });
    }
    check_faces(faces)
}

fn join(bytes: &[u8], is_ascii: bool, joiner: &mut Joiner) -> Result<(), SurfaceError> {
    // stl_io takes everything that begins with "solid " for ASCII, so a binary file's text is
    // blanked, and wants the blank where a file may have none.
    let (text, rest): (&[u8], &[u8]) = if is_ascii {
        (b"solid ", bytes.get(5..).unwrap_or_default())
    } else {
        (
            &[0; HEADER - 4],
            bytes.get(HEADER - 4..).unwrap_or_default(),
        )
    };
    let mut source = Cursor::new([text, rest].concat());
    let triangles =
        stl_io::create_stl_reader(&mut source).map_err(|e| not_stl(0, e.to_string()))?;
    for (triangle, record) in triangles.enumerate() {
        let record = record.map_err(|e| not_stl(triangle, e.to_string()))?;
        joiner.add(record.vertices.map(|vertex| vertex.0.map(f64::from)))?;
    }
    Ok(())
}

fn not_stl(triangle: usize, reason: String) -> SurfaceError {
    SurfaceError::Malformed {
        format: MeshFormat::Stl,
        place: format!("near triangle {triangle}"),
        reason,
    }
}
