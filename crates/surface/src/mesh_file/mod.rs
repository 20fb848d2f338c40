//! Mesh files: what format they are of, limits, and the joining of their corners.

mod joiner;
mod obj;
mod ply;
mod polygon;
mod stl;
mod text;

use std::fmt;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::{Mesh, SurfaceError};
use joiner::Joiner;

/// Most bytes of a mesh file that are read: 256 MiB.
pub const MAX_MESH_BYTES: u64 = 256 << 20;

/// Most triangles of a mesh file that are read.
pub const MAX_MESH_FACES: u64 = 2_000_000;

/// Most vertices of a mesh file that are read: three for each triangle.
const MOST_VERTICES: u64 = 3 * MAX_MESH_FACES;

/// A format of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MeshFormat {
    /// STL, binary or text: loose triangles of 32-bit numbers, in one solid or several.
    Stl,
    /// Wavefront OBJ, of which positions and faces are read.
    Obj,
    /// PLY, binary or text, with the elements `vertex` and `face` or `tristrips`.
    Ply,
}

/// What a mesh file holds, holes and all, in its own unit.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFile {
    /// Its format.
    pub format: MeshFormat,
    /// Whether its numbers are stored as bytes rather than as text.
    pub is_binary: bool,
    /// The triangles; polygons of more corners are cut into such. Vertices that are equal
    /// bit by bit are joined, and those of no triangle left out.
    pub mesh: Mesh,
    /// Triangles that this left without a third corner; they are not in the mesh.
    pub collapsed: usize,
    /// What of the file was passed over or may not be as meant, a sentence each, as for people.
    pub notes: Vec<String>,
}

impl MeshFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Stl, Self::Obj, Self::Ply];

    /// How names of such files end.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Stl => "stl",
            Self::Obj => "obj",
            Self::Ply => "ply",
        }
    }

    /// The format that a file's name says it is of, in capitals or not.
    #[must_use]
    pub fn of_name(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        let mut all = Self::ALL.into_iter();
        all.find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }

    /// The format that a file's first bytes, and for STL its size, say it is of; none if they say
    /// nothing, as those of a damaged file.
    #[must_use]
    pub fn of_content(bytes: &[u8]) -> Option<Self> {
        if ply::is_ply(bytes) {
            Some(Self::Ply)
        } else if stl::is_stl(bytes) {
            Some(Self::Stl)
        } else if obj::is_obj(bytes) {
            Some(Self::Obj)
        } else {
            None
        }
    }
}

impl fmt::Display for MeshFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Stl => "STL",
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
        })
    }
}

impl MeshFile {
    /// Reads a mesh file. Its name and its content must agree on what format it is of.
    ///
    /// # Errors
    /// [`SurfaceError::InFile`] with the path and the reason: unreadable, not a file, larger than
    /// [`MAX_MESH_BYTES`] or [`MAX_MESH_FACES`] (found before memory is taken), of no format known
    /// or of another than its name says, and all of [`MeshFile::parse`].
    pub fn read(path: &Path) -> Result<Self, SurfaceError> {
        read_bytes(path)
            .and_then(|bytes| Self::parse(expected_format(path, &bytes)?, &bytes))
            .map_err(|cause| SurfaceError::InFile {
                path: path.into(),
                cause: Box::new(cause),
            })
    }

    /// Reads the bytes of a mesh file.
    ///
    /// # Errors
    /// Not of this format, no triangles, too many, cut short.
    pub fn parse(format: MeshFormat, bytes: &[u8]) -> Result<Self, SurfaceError> {
        check_size(bytes.len() as u64)?;
        let (mut joiner, mut notes) = (Joiner::default(), Vec::new());
        let is_binary = match format {
            MeshFormat::Stl => stl::parse(bytes, &mut joiner, &mut notes)?,
            MeshFormat::Obj => obj::parse(bytes, &mut joiner, &mut notes).map(|()| false)?,
            MeshFormat::Ply => ply::parse(bytes, &mut joiner, &mut notes)?,
        };
        let (mesh, collapsed) = joiner.finish(&mut notes)?;
        Ok(Self {
            format,
            is_binary,
            mesh,
            collapsed,
            notes,
        })
    }
}

/// What the name says, if the content says nothing else.
fn expected_format(path: &Path, bytes: &[u8]) -> Result<MeshFormat, SurfaceError> {
    let found = MeshFormat::of_content(bytes);
    match (MeshFormat::of_name(path), found) {
        (Some(named), Some(found)) if named != found => {
            Err(SurfaceError::OtherFormat { named, found })
        }
        (Some(named), _) => Ok(named),
        (None, found) => Err(SurfaceError::UnknownFormat { found }),
    }
}

/// The whole file, if it is a regular file of acceptable size.
fn read_bytes(path: &Path) -> Result<Vec<u8>, SurfaceError> {
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

/// Fails on a polygon of more corners than make as many triangles as are read.
fn check_corners(corners: usize) -> Result<(), SurfaceError> {
    check_faces((corners as u64).saturating_sub(2))
}

/// Fails on a number of triangles beyond the limit.
fn check_faces(faces: u64) -> Result<(), SurfaceError> {
    if faces > MAX_MESH_FACES {
        return Err(SurfaceError::TooManyFaces {
            faces,
            limit: MAX_MESH_FACES,
        });
    }
    Ok(())
}
