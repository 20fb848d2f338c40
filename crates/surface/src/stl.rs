//! STL files: limits, the two formats, and the merging of their loose triangles into a mesh.

use std::collections::HashMap;
use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use nalgebra::Point3;

use crate::{Mesh, SurfaceError};

/// Most bytes of a mesh file that are read: 256 MiB.
pub const MAX_MESH_BYTES: u64 = 256 << 20;

/// Most triangles of a mesh file that are read.
pub const MAX_MESH_FACES: u64 = 2_000_000;

/// Bytes before the first triangle of a binary file: a free text and the count.
const HEADER: usize = 84;
/// Bytes of a binary triangle: normal, corners, attribute.
const RECORD: u64 = 50;

/// The whole file, if it is a regular file of acceptable size.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, SurfaceError> {
    // Asked before opening: opening a named pipe would wait for a writer.
    if !std::fs::metadata(path)?.is_file() {
        return Err(SurfaceError::NotAFile);
    }
    let file = File::open(path)?;
    check_size(file.metadata()?.len())?;
    let mut bytes = Vec::new();
    // The file may grow while it is read.
    file.take(MAX_MESH_BYTES + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn check_size(bytes: u64) -> Result<(), SurfaceError> {
    if bytes > MAX_MESH_BYTES {
        return Err(SurfaceError::TooManyBytes {
            bytes,
            limit: MAX_MESH_BYTES,
        });
    }
    Ok(())
}

/// The triangles, joined at equal vertices; not yet checked for holes.
pub(crate) fn parse(bytes: &[u8]) -> Result<Mesh, SurfaceError> {
    let given = bytes.len() as u64;
    check_size(given)?;
    if bytes.is_empty() {
        return Err(SurfaceError::EmptyMesh);
    }
    let announced = announced_faces(bytes);
    let fits = announced.is_some_and(|faces| HEADER as u64 + RECORD * faces == given);
    // Many binary files begin with "solid" too; the size tells.
    let is_ascii = !fits && bytes.starts_with(b"solid");
    if !is_ascii {
        let Some(faces) = announced else {
            let reason = format!("{given} bytes are fewer than the {HEADER} of a binary header");
            return Err(SurfaceError::NotStl {
                triangle: 0,
                reason,
            });
        };
        if faces > MAX_MESH_FACES {
            return Err(SurfaceError::TooManyFaces {
                faces,
                limit: MAX_MESH_FACES,
            });
        }
        if !fits {
            let expected = HEADER as u64 + RECORD * faces;
            return Err(SurfaceError::WrongSize {
                faces,
                expected,
                given,
            });
        }
    }
    join(bytes, is_ascii)
}

/// The count in the header, if the bytes are long enough to be a binary file.
fn announced_faces(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u64::from(u32::from_le_bytes(count.try_into().ok()?)))
}

fn join(bytes: &[u8], is_ascii: bool) -> Result<Mesh, SurfaceError> {
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
    let triangles = stl_io::create_stl_reader(&mut source).map_err(|e| SurfaceError::NotStl {
        triangle: 0,
        reason: e.to_string(),
    })?;

    let mut mesh = Mesh::default();
    let mut known: HashMap<[u32; 3], usize> = HashMap::new();
    for (triangle, record) in triangles.enumerate() {
        if triangle as u64 >= MAX_MESH_FACES {
            let faces = triangle as u64 + 1;
            return Err(SurfaceError::TooManyFaces {
                faces,
                limit: MAX_MESH_FACES,
            });
        }
        let record = record.map_err(|e| SurfaceError::NotStl {
            triangle,
            reason: e.to_string(),
        })?;
        let corners = record.vertices.map(|vertex| {
            // Adding zero makes −0 and 0 the same.
            let place = vertex.0.map(|c| c + 0.0);
            *known.entry(place.map(f32::to_bits)).or_insert_with(|| {
                mesh.vertices.push(Point3::from(place.map(f64::from)));
                mesh.vertices.len() - 1
            })
        });
        let [a, b, c] = corners;
        if a != b && b != c && c != a {
            mesh.faces.push(corners);
        }
    }
    if mesh.faces.is_empty() {
        Err(SurfaceError::EmptyMesh)
    } else {
        Ok(mesh)
    }
}
