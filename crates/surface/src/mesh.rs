//! A triangle mesh at rest, read from a file or generated.

use nalgebra::{Point3, Rotation3, Vector3};

use crate::edges::pair_edges;
use crate::topology::signed_volume;
use crate::{MeshFile, MeshFormat, SurfaceError, check_points};

/// Triangles over shared vertices. Coordinates are in the unit of the file until
/// [`Mesh::rotated`] and [`Mesh::scaled_and_moved`] bring them to cm in the world frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The positions.
    pub vertices: Vec<Point3<f64>>,
    /// Triangles as vertex numbers, anticlockwise seen from outside if the source says so.
    pub faces: Vec<[usize; 3]>,
}

impl Mesh {
    /// A closed mesh from the bytes of a file, in its own unit.
    ///
    /// # Errors
    /// All of [`MeshFile::parse`], unusable coordinates, not closed.
    pub fn parse(format: MeshFormat, bytes: &[u8]) -> Result<Self, SurfaceError> {
        let MeshFile { mesh, .. } = MeshFile::parse(format, bytes)?;
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

    /// Every vertex turned about the origin.
    #[must_use]
    pub fn rotated(mut self, rotation: &Rotation3<f64>) -> Self {
        for vertex in &mut self.vertices {
            *vertex = rotation * *vertex;
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
