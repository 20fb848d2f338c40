//! What a mesh is like, whether or not it can be used.

use nalgebra::Point3;

use crate::Mesh;
use crate::edges::{Side, edges_of};

/// Counts and sizes of a mesh, in its own unit. Faces that name no vertex must not be in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// Vertices.
    pub vertices: usize,
    /// Triangles.
    pub faces: usize,
    /// Edges, however many faces share them.
    pub edges: usize,
    /// Edges of one face: the borders of holes.
    pub boundary_edges: usize,
    /// Edges that more than two faces share.
    pub crowded_edges: usize,
    /// Edges whose two faces do not turn the same way round.
    pub twisted_edges: usize,
    /// Parts that no edge joins to each other.
    pub components: usize,
    /// The least and greatest coordinates; none for a mesh without vertices.
    pub bounds: Option<(Point3<f64>, Point3<f64>)>,
    /// The area of all faces together.
    pub area: f64,
    /// The enclosed volume, negative if the faces turn inward; none unless the mesh is closed and
    /// all its faces turn the same way round.
    pub volume: Option<f64>,
}

impl Inspection {
    /// Looks at a mesh. O(n log n) in its faces.
    #[must_use]
    pub fn of(mesh: &Mesh) -> Self {
        let sides = edges_of(&mesh.faces);
        let (mut edges, mut boundary, mut crowded, mut twisted) = (0, 0, 0, 0);
        let mut parts = Parts::new(mesh.faces.len());
        for group in sides.chunk_by(|a, b| a.0 == b.0) {
            edges += 1;
            match group {
                [_] => boundary += 1,
                [(_, first), (_, second)] => twisted += usize::from(first.upward == second.upward),
                _ => crowded += 1,
            }
            for pair in group.windows(2) {
                let [(_, Side { face: a, .. }), (_, Side { face: b, .. })] = pair else {
                    continue;
                };
                parts.join(*a, *b);
            }
        }
        let is_solid = !mesh.faces.is_empty() && boundary + crowded + twisted == 0;
        Self {
            vertices: mesh.vertices.len(),
            faces: mesh.faces.len(),
            edges,
            boundary_edges: boundary,
            crowded_edges: crowded,
            twisted_edges: twisted,
            components: parts.count,
            bounds: mesh.bounds(),
            area: mesh.faces.iter().map(|face| area(mesh, *face)).sum(),
            volume: is_solid.then(|| mesh.volume()),
        }
    }

    /// Whether every edge is shared by exactly two faces.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.faces > 0 && self.boundary_edges == 0 && self.crowded_edges == 0
    }
}

fn area(mesh: &Mesh, face: [usize; 3]) -> f64 {
    let [a, b, c] = face.map(|i| mesh.vertices.get(i).copied().unwrap_or_default());
    0.5 * (b - a).cross(&(c - a)).norm()
}

/// Sets of faces that edges join.
struct Parts {
    parent: Vec<usize>,
    count: usize,
}

impl Parts {
    fn new(faces: usize) -> Self {
        Self {
            parent: (0..faces).collect(),
            count: faces,
        }
    }

    /// The face that stands for the part of `face`; halves the way there for the next time.
    fn root(&mut self, mut face: usize) -> usize {
        while self.parent[face] != face {
            self.parent[face] = self.parent[self.parent[face]];
            face = self.parent[face];
        }
        face
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        if a != b {
            self.parent[a.max(b)] = a.min(b);
            self.count -= 1;
        }
    }
}
