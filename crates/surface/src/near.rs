//! Vertices that nearly coincide, joined.

use std::collections::HashMap;

use nalgebra::Point3;

use crate::{Inspection, Mesh};

/// What joining near vertices did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NearJoin {
    /// Vertices that another one stands for now.
    pub vertices: usize,
    /// How far from it the farthest of them was, in the unit of the mesh.
    pub farthest: f64,
    /// Triangles that this left without a third corner; they are no longer in the mesh.
    pub collapsed: usize,
}

/// Of a mesh's extent, the distances within which vertices may be meant for one: beyond what the
/// rounding of 64-bit numbers leaves, below any shape.
const NEAR: std::ops::RangeInclusive<i32> = -9..=-4;

impl Mesh {
    /// Joins each vertex to the nearest earlier one within a distance, in the unit of the mesh; the
    /// first of equally near ones. No vertex moves farther than that, and those that stay are farther
    /// from each other. Nothing is joined within 0 or less.
    pub fn join_within(&mut self, distance: f64) -> NearJoin {
        let mut joined = NearJoin::default();
        let Some((low, high)) = self.bounds().filter(|_| distance > 0.0) else {
            return joined;
        };
        let mut grid = Grid::new(low, (high - low).amax(), distance);
        let mut kept: Vec<Point3<f64>> = Vec::new();
        let mut stands_for = Vec::with_capacity(self.vertices.len());
        for vertex in &self.vertices {
            match grid.nearest(vertex, &kept) {
                Some((index, away)) => {
                    joined.vertices += 1;
                    joined.farthest = joined.farthest.max(away);
                    stands_for.push(index);
                }
                None => {
                    grid.add(vertex, kept.len());
                    stands_for.push(kept.len());
                    kept.push(*vertex);
                }
            }
        }
        self.vertices = kept;
        let before = self.faces.len();
        for face in &mut self.faces {
            *face = face.map(|i| stands_for[i]);
        }
        self.faces.retain(|[a, b, c]| a != b && b != c && c != a);
        joined.collapsed = before - self.faces.len();
        if joined.collapsed > 0 {
            self.leave_out_unused_vertices();
        }
        joined
    }

    fn leave_out_unused_vertices(&mut self) {
        let mut numbers: Vec<Option<usize>> = vec![None; self.vertices.len()];
        let mut used = Vec::new();
        for corner in self.faces.iter_mut().flatten() {
            *corner = *numbers[*corner].get_or_insert_with(|| {
                used.push(self.vertices[*corner]);
                used.len() - 1
            });
        }
        self.vertices = used;
    }

    /// The least power of ten within which to join vertices closes the mesh, in its unit, and what that
    /// does; none if it is closed, or if that would take so much that triangles collapse, or more than a
    /// ten-thousandth of its extent.
    #[must_use]
    pub fn closing_distance(&self) -> Option<(f64, NearJoin)> {
        let (low, high) = self.bounds()?;
        let extent = (high - low).amax();
        if !extent.is_normal() || Inspection::of(self).is_closed() {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, reason = "at most 308")]
        let power = extent.log10().floor() as i32;
        NEAR.map(|below| power_of_ten(power + below))
            .map(|distance| {
                let mut mesh = self.clone();
                let joined = mesh.join_within(distance);
                (distance, joined, Inspection::of(&mesh).is_closed())
            })
            .find(|(_, joined, is_closed)| *is_closed && joined.collapsed == 0)
            .map(|(distance, joined, _)| (distance, joined))
    }
}

/// As it is written; products and quotients may be off by a digit.
fn power_of_ten(power: i32) -> f64 {
    format!("1e{power}").parse().unwrap_or_default()
}

/// Vertices by the cube that they lie in.
struct Grid {
    low: Point3<f64>,
    cell: f64,
    distance: f64,
    vertices: HashMap<[i64; 3], Vec<usize>>,
}

impl Grid {
    fn new(low: Point3<f64>, extent: f64, distance: f64) -> Self {
        Self {
            low,
            // Larger than the distance, so that a vertex mostly looks into one cube, and few lie in it.
            cell: (4.0 * distance).max(extent * 1e-12),
            distance,
            vertices: HashMap::new(),
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a number of a cell")]
    fn cell_of(&self, place: Point3<f64>) -> [i64; 3] {
        ((place - self.low) / self.cell)
            .map(|c| c.floor() as i64)
            .into()
    }

    fn add(&mut self, vertex: &Point3<f64>, index: usize) {
        let cell = self.cell_of(*vertex);
        self.vertices.entry(cell).or_default().push(index);
    }

    /// The nearest of the vertices that were added, if it is within the distance, and how far it is.
    fn nearest(&self, vertex: &Point3<f64>, places: &[Point3<f64>]) -> Option<(usize, f64)> {
        let reach = nalgebra::Vector3::repeat(self.distance);
        let (low, high) = (self.cell_of(vertex - reach), self.cell_of(vertex + reach));
        let mut nearest: Option<(usize, f64)> = None;
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    for &index in self.vertices.get(&[x, y, z]).into_iter().flatten() {
                        let away = (vertex - places[index]).norm();
                        let is_nearer = nearest.is_none_or(|(best, least)| {
                            away < least || (away == least && index < best)
                        });
                        if away <= self.distance && is_nearer {
                            nearest = Some((index, away));
                        }
                    }
                }
            }
        }
        nearest
    }
}
