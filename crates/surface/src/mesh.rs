//! A triangle mesh at rest, read from a file or generated.

use std::path::Path;

use nalgebra::{Point3, Vector3};

use crate::edges::pair_edges;
use crate::topology::signed_volume;
use crate::{SurfaceError, check_points, stl};

/// Triangles over shared vertices. Coordinates are in the unit of the file until
/// [`Mesh::scaled_and_moved`] brings them to cm in the world frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The positions.
    pub vertices: Vec<Point3<f64>>,
    /// Triangles as vertex numbers, anticlockwise seen from outside if the source says so.
    pub faces: Vec<[usize; 3]>,
}

impl Mesh {
    /// Reads an STL file, binary or ASCII, in its own unit. Vertices that are equal bit by bit are
    /// merged, and triangles that this leaves without a third corner are dropped.
    ///
    /// # Errors
    /// [`SurfaceError::InFile`] with the path and the reason: unreadable, not a file, larger than
    /// [`MAX_MESH_BYTES`](crate::MAX_MESH_BYTES) or [`MAX_MESH_FACES`](crate::MAX_MESH_FACES)
    /// (found before memory is taken), and all of [`Mesh::parse_stl`].
    pub fn read_stl(path: &Path) -> Result<Self, SurfaceError> {
        stl::read_bytes(path)
            .and_then(|bytes| Self::parse_stl(&bytes))
            .map_err(|cause| SurfaceError::InFile {
                path: path.into(),
                cause: Box::new(cause),
            })
    }

    /// As [`Mesh::read_stl`], from the bytes of a file.
    ///
    /// # Errors
    /// Not STL, no triangles, too many, cut short, unusable coordinates, not closed.
    pub fn parse_stl(bytes: &[u8]) -> Result<Self, SurfaceError> {
        let mesh = stl::parse(bytes)?;
        mesh.check_closed()?;
        Ok(mesh)
    }

    /// Every vertex times `scale`, plus an offset: 0.1 and a position turn a file in mm into cm in
    /// the world frame. A negative scale mirrors the mesh; its faces still turn outward.
    #[must_use]
    pub fn scaled_and_moved(mut self, scale: f64, offset_cm: Vector3<f64>) -> Self {
        for vertex in &mut self.vertices {
            *vertex = Point3::from(vertex.coords * scale + offset_cm);
        }
        if scale < 0.0 {
            self.faces.iter_mut().for_each(|face| face.swap(1, 2));
        }
        self
    }

    /// The least and greatest coordinates of the vertices; none for a mesh without vertices.
    pub fn bounds(&self) -> Option<(Point3<f64>, Point3<f64>)> {
        let first = *self.vertices.first()?;
        Some(
            self.vertices
                .iter()
                .fold((first, first), |(low, high), v| (low.inf(v), high.sup(v))),
        )
    }

    /// The enclosed volume, in the cube of the unit: positive if the faces turn outward. Faces
    /// that name no vertex count nothing.
    pub fn volume(&self) -> f64 {
        let count = self.vertices.len();
        let valid = self
            .faces
            .iter()
            .copied()
            .filter(|f| f.iter().all(|&i| i < count));
        signed_volume(&self.vertices, valid)
    }

    /// Checks what every other function of this crate needs of a mesh.
    ///
    /// # Errors
    /// Unusable coordinates, no faces, corners that are no vertices or repeated, and edges that
    /// are not shared by exactly two faces (how many, and where the first is).
    pub fn check_closed(&self) -> Result<(), SurfaceError> {
        check_points(&self.vertices)?;
        pair_edges(&self.vertices, &self.faces).map(|_| ())
    }
}
