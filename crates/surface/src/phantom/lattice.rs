//! The zero level of a function as a triangle mesh, by marching tetrahedra on a body-centred cubic
//! lattice.
//!
//! A tetrahedron is cut in a triangle or a quadrilateral, whose corners lie on its edges and are
//! shared with all tetrahedra around: the surface is closed and manifold by construction, whatever
//! the function, as long as it is positive on the rim of the box.

use std::collections::HashMap;

use nalgebra::Point3;

use crate::Mesh;

type Point = Point3<f64>;

/// No value is nearer to zero, so that no cut falls on a node, where others would meet it.
const LEAST_VALUE: f64 = 1e-6;

/// Triangulates where `f` is zero, within a box around all points where it is negative. The faces
/// are not turned consistently, and many are small or thin.
pub(super) fn polygonise(spacing: f64, [low, high]: [Point; 2], f: impl Fn(&Point) -> f64) -> Mesh {
    let lattice = Lattice::sample(spacing, low, high, f);
    let mut cuts = Cuts {
        lattice: &lattice,
        known: HashMap::new(),
        mesh: Mesh::default(),
    };
    for tetrahedron in lattice.tetrahedra() {
        cuts.march(tetrahedron);
    }
    cuts.mesh
}

/// Number of a lattice point: corners of the cubes first, then centres.
type Node = usize;

struct Lattice {
    /// Cubes along each axis.
    cubes: [usize; 3],
    points: Vec<Point>,
    values: Vec<f64>,
}

impl Lattice {
    fn sample(spacing: f64, low: Point, high: Point, f: impl Fn(&Point) -> f64) -> Self {
        let mut cubes = [0; 3];
        for axis in 0..3 {
            // Counted up rather than rounded from a float; one more cube clears the far side.
            while low[axis] + spacing * cubes[axis] as f64 <= high[axis] {
                cubes[axis] += 1;
            }
        }
        let corners = grid(cubes.map(|n| n + 1)).map(|c| c.map(|i| i as f64));
        let centres = grid(cubes).map(|c| c.map(|i| i as f64 + 0.5));
        let points: Vec<Point> = corners
            .chain(centres)
            .map(|c| low + nalgebra::Vector3::from(c) * spacing)
            .collect();
        let away_from_zero = |value: f64| {
            if value.abs() < LEAST_VALUE {
                LEAST_VALUE
            } else {
                value
            }
        };
        let values = points.iter().map(|p| away_from_zero(f(p))).collect();
        Self {
            cubes,
            points,
            values,
        }
    }

    fn corner(&self, [i, j, k]: [usize; 3]) -> Node {
        let [_, ny, nz] = self.cubes;
        (i * (ny + 1) + j) * (nz + 1) + k
    }

    fn centre(&self, [i, j, k]: [usize; 3]) -> Node {
        let [nx, ny, nz] = self.cubes;
        (nx + 1) * (ny + 1) * (nz + 1) + (i * ny + j) * nz + k
    }

    /// Tetrahedra that the surface cuts: two neighbouring centres and an edge of the square
    /// between their cubes.
    fn tetrahedra(&self) -> impl Iterator<Item = [Node; 4]> {
        let in_all_directions = (0..3).flat_map(move |axis| {
            let mut pairs = self.cubes;
            pairs[axis] -= 1;
            grid(pairs).flat_map(move |cube| {
                let mut next = cube;
                next[axis] += 1;
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let square = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(du, dv)| {
                    let mut corner = next;
                    corner[u] += du;
                    corner[v] += dv;
                    self.corner(corner)
                });
                let centres = [self.centre(cube), self.centre(next)];
                (0..4).map(move |i| [centres[0], centres[1], square[i], square[(i + 1) % 4]])
            })
        });
        in_all_directions.filter(|nodes| nodes.iter().any(|&n| self.values[n] < 0.0))
    }

    /// Where the surface cuts the edge between nodes of different sign.
    fn cut(&self, a: Node, b: Node) -> Point {
        let (at_a, at_b) = (self.values[a], self.values[b]);
        self.points[a] + (self.points[b] - self.points[a]) * (at_a / (at_a - at_b))
    }
}

/// The mesh as far as it is known.
struct Cuts<'a> {
    lattice: &'a Lattice,
    known: HashMap<(Node, Node), usize>,
    mesh: Mesh,
}

impl Cuts<'_> {
    /// Adds the faces between the negative and the other corners of a tetrahedron.
    fn march(&mut self, nodes: [Node; 4]) {
        let is_inside = |n: &Node| self.lattice.values[*n] < 0.0;
        let (inside, outside): (Vec<Node>, Vec<Node>) = nodes.into_iter().partition(is_inside);
        match (inside.as_slice(), outside.as_slice()) {
            (&[tip], &[a, b, c]) => {
                let face = [a, b, c].map(|n| self.vertex(tip, n));
                self.mesh.faces.push(face);
            }
            (&[a, b, c], &[tip]) => {
                let face = [a, b, c].map(|n| self.vertex(n, tip));
                self.mesh.faces.push(face);
            }
            (&[a, b], &[c, d]) => {
                let [ac, ad, bd, bc] =
                    [(a, c), (a, d), (b, d), (b, c)].map(|(m, n)| self.vertex(m, n));
                self.mesh.faces.extend([[ac, ad, bd], [ac, bd, bc]]);
            }
            _ => {}
        }
    }

    /// The mesh vertex on the edge between an inside and an outside node.
    fn vertex(&mut self, inside: Node, outside: Node) -> usize {
        *self.known.entry((inside, outside)).or_insert_with(|| {
            self.mesh.vertices.push(self.lattice.cut(inside, outside));
            self.mesh.vertices.len() - 1
        })
    }
}

/// All index triples below `sizes`, the last index fastest.
fn grid(sizes: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let [nx, ny, nz] = sizes;
    (0..nx).flat_map(move |i| (0..ny).flat_map(move |j| (0..nz).map(move |k| [i, j, k])))
}
