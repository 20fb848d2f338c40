//! Better triangles for a closed surface, without a change of its shape or connectivity: short
//! edges are collapsed, and vertices spread evenly and settled on the surface again.

use nalgebra::{Point3, Vector3};

use crate::Mesh;

type Point = Point3<f64>;

/// Least cosine of the angle by which a collapse may turn a face.
const LEAST_TURN: f64 = 0.5;
/// How often vertices are spread and settled.
const RELAXATIONS: usize = 6;
/// Newton steps towards the surface; the function is nearly a distance, so few are enough.
const SETTLINGS: usize = 1;

/// Collapses edges shorter than `shortest` and evens out the triangles. `f` is zero on the
/// surface and roughly the distance from it nearby.
pub(super) fn tidy(mesh: Mesh, shortest: f64, f: impl Fn(&Point) -> f64) -> Mesh {
    let mut surface = Collapsible::new(mesh);
    while surface.sweep(shortest) {}
    let rings = surface.rings();
    for _ in 0..RELAXATIONS {
        surface.spread(&rings);
        for (vertex, ring) in surface.points.iter_mut().zip(&rings) {
            if !ring.is_empty() {
                settle(vertex, shortest, &f);
            }
        }
    }
    surface.into_mesh()
}

/// A closed mesh whose edges can be collapsed. A face that is gone has no corners, a vertex that
/// is gone no faces.
struct Collapsible {
    points: Vec<Point>,
    faces: Vec<Option<[usize; 3]>>,
    faces_at: Vec<Vec<usize>>,
}

impl Collapsible {
    fn new(mesh: Mesh) -> Self {
        let mut faces_at = vec![Vec::new(); mesh.vertices.len()];
        for (face, corners) in mesh.faces.iter().enumerate() {
            for &corner in corners {
                faces_at[corner].push(face);
            }
        }
        let faces = mesh.faces.into_iter().map(Some).collect();
        Self {
            points: mesh.vertices,
            faces,
            faces_at,
        }
    }

    /// Tries to collapse the shortest edge at every vertex; says whether any was.
    fn sweep(&mut self, shortest: f64) -> bool {
        let mut any = false;
        for vertex in 0..self.points.len() {
            let mut short: Vec<(f64, usize)> = self
                .ring(vertex)
                .into_iter()
                .map(|other| ((self.points[other] - self.points[vertex]).norm(), other))
                .filter(|&(length, _)| length < shortest)
                .collect();
            short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            any |= short
                .into_iter()
                .any(|(_, other)| self.collapse(vertex, other));
        }
        any
    }

    /// The neighbours of a vertex, in ascending order.
    fn ring(&self, vertex: usize) -> Vec<usize> {
        let mut ring: Vec<usize> = self.faces_at[vertex]
            .iter()
            .filter_map(|&face| self.faces[face])
            .flatten()
            .filter(|&corner| corner != vertex)
            .collect();
        ring.sort_unstable();
        ring.dedup();
        ring
    }

    fn rings(&self) -> Vec<Vec<usize>> {
        (0..self.points.len())
            .map(|vertex| self.ring(vertex))
            .collect()
    }

    /// Merges the ends of an edge in its middle, unless that would pinch the surface or fold it.
    fn collapse(&mut self, kept: usize, gone: usize) -> bool {
        let (ring, other) = (self.ring(kept), self.ring(gone));
        let shared = ring
            .iter()
            .filter(|v| other.binary_search(v).is_ok())
            .count();
        // The link condition: only the two vertices across the edge are next to both ends.
        if shared != 2 || ring.len() < 4 || other.len() < 4 {
            return false;
        }
        let middle = nalgebra::center(&self.points[kept], &self.points[gone]);
        if self.would_fold(kept, gone, middle) || self.would_fold(gone, kept, middle) {
            return false;
        }
        self.points[kept] = middle;
        for face in std::mem::take(&mut self.faces_at[gone]) {
            let Some(corners) = self.faces[face] else {
                continue;
            };
            if corners.contains(&kept) {
                self.faces[face] = None;
                for corner in corners {
                    self.faces_at[corner].retain(|&f| f != face);
                }
            } else {
                self.faces[face] = Some(corners.map(|c| if c == gone { kept } else { c }));
                self.faces_at[kept].push(face);
            }
        }
        true
    }

    /// Whether moving a vertex would turn a face around it too far, not counting those that
    /// vanish because they have `partner` too.
    fn would_fold(&self, vertex: usize, partner: usize, to: Point) -> bool {
        self.faces_at[vertex]
            .iter()
            .filter_map(|&face| self.faces[face])
            .any(|corners| {
                let before = corners.map(|c| self.points[c]);
                let after = corners.map(|c| if c == vertex { to } else { self.points[c] });
                let (before, after) = (area_vector(before), area_vector(after));
                let turned = before.dot(&after) <= LEAST_TURN * before.norm() * after.norm();
                !corners.contains(&partner) && turned
            })
    }

    /// Moves every vertex half-way towards the middle of its neighbours.
    fn spread(&mut self, rings: &[Vec<usize>]) {
        let moved = rings.iter().zip(&self.points).map(|(ring, &here)| {
            let sum: Vector3<f64> = ring.iter().map(|&v| self.points[v] - here).sum();
            here + sum / (2 * ring.len().max(1)) as f64
        });
        self.points = moved.collect();
    }

    fn into_mesh(self) -> Mesh {
        let mut number = vec![None; self.points.len()];
        let mut mesh = Mesh::default();
        for corners in self.faces.into_iter().flatten() {
            let corners = corners.map(|c| {
                *number[c].get_or_insert_with(|| {
                    mesh.vertices.push(self.points[c]);
                    mesh.vertices.len() - 1
                })
            });
            mesh.faces.push(corners);
        }
        mesh
    }
}

fn area_vector([a, b, c]: [Point; 3]) -> Vector3<f64> {
    (b - a).cross(&(c - a))
}

/// Moves a point onto the surface along the gradient, by `longest` at most.
fn settle(p: &mut Point, longest: f64, f: impl Fn(&Point) -> f64) {
    let reach = 1e-4;
    for _ in 0..SETTLINGS {
        let slope = Vector3::from(
            [Vector3::x(), Vector3::y(), Vector3::z()]
                .map(|axis| (f(&(*p + axis * reach)) - f(&(*p - axis * reach))) / (2.0 * reach)),
        );
        let steepness = slope.norm_squared();
        // In a crease between parts there is no direction to go.
        if steepness > 0.01 {
            let step = slope * (f(p) / steepness);
            *p -= step.cap_magnitude(longest);
        }
    }
}
