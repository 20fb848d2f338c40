//! Corners of triangles, joined where they are equal.

use std::collections::HashMap;

use nalgebra::Point3;

use super::check_faces;
use crate::{Mesh, SurfaceError};

/// Builds a mesh from triangles given by the places of their corners.
#[derive(Debug, Default)]
pub(super) struct Joiner {
    mesh: Mesh,
    known: HashMap<[u64; 3], usize>,
    triangles: u64,
}

impl Joiner {
    /// Adds a triangle.
    pub(super) fn add(&mut self, corners: [[f64; 3]; 3]) -> Result<(), SurfaceError> {
        self.triangles += 1;
        check_faces(self.triangles)?;
        let corners = corners.map(|place| self.vertex(place));
        let [a, b, c] = corners;
        if a != b && b != c && c != a {
            self.mesh.faces.push(corners);
        }
        Ok(())
    }

    /// Adds a polygon as a fan of triangles around its first corner.
    pub(super) fn add_polygon(&mut self, corners: &[[f64; 3]]) -> Result<(), SurfaceError> {
        let Some((first, others)) = corners.split_first() else {
            return Ok(());
        };
        others
            .windows(2)
            .try_for_each(|pair| self.add([*first, pair[0], pair[1]]))
    }

    /// The mesh, and how many triangles had no third corner.
    pub(super) fn finish(self) -> Result<(Mesh, usize), SurfaceError> {
        if self.mesh.faces.is_empty() {
            return Err(SurfaceError::EmptyMesh);
        }
        let kept = self.mesh.faces.len();
        let all = usize::try_from(self.triangles).unwrap_or(usize::MAX);
        Ok((self.mesh, all.saturating_sub(kept)))
    }

    fn vertex(&mut self, place: [f64; 3]) -> usize {
        // Adding zero makes −0 and 0 the same.
        let place = place.map(|c| c + 0.0);
        let vertices = &mut self.mesh.vertices;
        *self
            .known
            .entry(place.map(f64::to_bits))
            .or_insert_with(|| {
                vertices.push(Point3::from(place));
                vertices.len() - 1
            })
    }
}
