//! Corners of triangles, joined where they are equal.

use std::collections::HashMap;

use nalgebra::Point3;

use super::check_faces;
use super::polygon::{Cut, Cutter, MOST_CLIPPED};
use crate::{Mesh, SurfaceError};

/// Builds a mesh from triangles given by the places of their corners.
#[derive(Debug, Default)]
pub(super) struct Joiner {
    mesh: Mesh,
    known: HashMap<[u64; 3], usize>,
    triangles: u64,
    cutter: Cutter,
    /// Corners of the polygon that is added.
    corners: Vec<[f64; 3]>,
    crossed: usize,
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

    /// Adds a polygon, cut into triangles.
    pub(super) fn add_polygon(&mut self, corners: &[[f64; 3]]) -> Result<(), SurfaceError> {
        if let &[a, b, c] = corners {
            return self.add([a, b, c]);
        }
        let mut distinct = std::mem::take(&mut self.corners);
        distinct.clear();
        distinct.extend_from_slice(corners);
        distinct.dedup();
        if distinct.first() == distinct.last() {
            distinct.pop();
        }
        if distinct.len() < 3 {
            self.triangles += 1;
            check_faces(self.triangles)?;
        } else {
            let mut cutter = std::mem::take(&mut self.cutter);
            let (triangles, cut) = cutter.cut(&distinct);
            if cut == Cut::TooLong {
                return Err(SurfaceError::LongPolygon {
                    corners: distinct.len(),
                    limit: MOST_CLIPPED,
                });
            }
            self.crossed += usize::from(cut == Cut::Crossed);
            triangles
                .iter()
                .try_for_each(|triangle| self.add(triangle.map(|i| distinct[i])))?;
            self.cutter = cutter;
        }
        self.corners = distinct;
        Ok(())
    }

    /// The mesh, and how many triangles had no third corner.
    pub(super) fn finish(self, notes: &mut Vec<String>) -> Result<(Mesh, usize), SurfaceError> {
        if self.mesh.faces.is_empty() {
            return Err(SurfaceError::EmptyMesh);
        }
        if self.crossed > 0 {
            notes.push(format!(
                "{} polygons cross themselves or have no area, so that no triangles cover them: fans from their \
                 first corners stand in their places",
                self.crossed
            ));
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
