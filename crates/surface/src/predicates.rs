//! Exact geometric decisions, all reduced to the signs of Shewchuk's orientation determinants
//! ("Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997).
//!
//! Everything here is closed: touching counts. Nothing is rounded, so two faces that share an edge
//! agree about a line through it, and nothing slips between them.

use nalgebra::Point3;
use robust::{Coord, Coord3D, orient2d, orient3d};

type Point = Point3<f64>;

/// A coordinate axis to project along, and the two that remain, in right-handed order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection(usize, usize);

/// Along x, y and z.
const PROJECTIONS: [Projection; 3] = [Projection(1, 2), Projection(2, 0), Projection(0, 1)];
/// Along z, as seen from above.
pub(crate) const ALONG_Z: Projection = PROJECTIONS[2];

fn coord(p: &Point) -> Coord3D<f64> {
    Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    }
}

impl Projection {
    fn coord(self, p: &Point) -> Coord<f64> {
        Coord {
            x: p[self.0],
            y: p[self.1],
        }
    }

    /// Positive where `c` lies to the left of the projected line from `a` to `b`.
    pub(crate) fn side_of_line(self, a: &Point, b: &Point, c: &Point) -> f64 {
        orient2d(self.coord(a), self.coord(b), self.coord(c))
    }

    /// Some projection in which the three points are not on a line; none if they are on one in
    /// space. Planes through such points are projected one to one.
    fn of_plane(a: &Point, b: &Point, c: &Point) -> Option<Self> {
        PROJECTIONS
            .into_iter()
            .find(|axes| axes.side_of_line(a, b, c) != 0.0)
    }
}

/// Positive where `p` lies on the side of the plane from which `a`, `b`, `c` turn anticlockwise
/// (the outside of an outward face), negative on the other, zero exactly on the plane.
pub(crate) fn side_of_plane(a: &Point, b: &Point, c: &Point, p: &Point) -> f64 {
    -orient3d(coord(a), coord(b), coord(c), coord(p))
}

/// Whether the three points lie on one line.
pub(crate) fn collinear(a: &Point, b: &Point, c: &Point) -> bool {
    Projection::of_plane(a, b, c).is_none()
}

/// Whether the segment `a`–`b` and the triangle have a point in common, ends, edges and corners
/// included. Zero-length segments and triangles without area are treated as the sets they are.
pub(crate) fn segment_touches_triangle(a: &Point, b: &Point, t: [&Point; 3]) -> bool {
    let side_a = side_of_plane(t[0], t[1], t[2], a);
    let side_b = side_of_plane(t[0], t[1], t[2], b);
    if same_sign(side_a, side_b) {
        return false;
    }
    if side_a == 0.0 && side_b == 0.0 {
        return match Projection::of_plane(t[0], t[1], t[2]) {
            Some(axes) => touches_in_plane(axes, a, b, t),
            None => edges(t)
                .into_iter()
                .any(|(u, v)| segments_touch(a, b, u, v)),
        };
    }
    // The line meets the plane in one point, within the segment. It lies in the triangle unless
    // the line passes two edges on different sides.
    let turns = edges(t).map(|(u, v)| side_of_plane(a, b, u, v));
    !(turns.iter().any(|&s| s > 0.0) && turns.iter().any(|&s| s < 0.0))
}

fn same_sign(a: f64, b: f64) -> bool {
    (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0)
}

fn edges(t: [&Point; 3]) -> [(&Point, &Point); 3] {
    [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]
}

/// Segment and triangle in one plane, seen in a projection that keeps the plane.
fn touches_in_plane(axes: Projection, a: &Point, b: &Point, t: [&Point; 3]) -> bool {
    let turns = edges(t).map(|(u, v)| axes.side_of_line(u, v, a));
    let a_is_within = !(turns.iter().any(|&s| s > 0.0) && turns.iter().any(|&s| s < 0.0));
    a_is_within
        || edges(t)
            .into_iter()
            .any(|(u, v)| projections_touch(axes, a, b, u, v))
}

/// Whether two segments in space have a point in common.
fn segments_touch(a: &Point, b: &Point, u: &Point, v: &Point) -> bool {
    if side_of_plane(a, b, u, v) != 0.0 {
        return false;
    }
    let plane = [(a, b, u), (a, b, v), (u, v, a), (u, v, b)]
        .into_iter()
        .find_map(|(p, q, r)| Projection::of_plane(p, q, r));
    match plane {
        Some(axes) => projections_touch(axes, a, b, u, v),
        // All four on one line: the segments touch where their shadows on every axis do.
        None => (0..3).all(|i| overlap(a[i], b[i], u[i], v[i])),
    }
}

/// Whether two segments of one plane have a point in common, seen in a projection that keeps it.
fn projections_touch(axes: Projection, a: &Point, b: &Point, u: &Point, v: &Point) -> bool {
    let boxes_meet = [axes.0, axes.1]
        .into_iter()
        .all(|i| overlap(a[i], b[i], u[i], v[i]));
    boxes_meet
        && !same_sign(axes.side_of_line(a, b, u), axes.side_of_line(a, b, v))
        && !same_sign(axes.side_of_line(u, v, a), axes.side_of_line(u, v, b))
}

/// Whether the intervals between `a`, `b` and between `u`, `v` have a number in common.
fn overlap(a: f64, b: f64, u: f64, v: f64) -> bool {
    a.min(b) <= u.max(v) && u.min(v) <= a.max(b)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    type Whole = [i64; 3];

    fn point(p: Whole) -> Point {
        Point::from(p.map(|c| f64::from(i32::try_from(c).unwrap())))
    }

    fn touches(a: Whole, b: Whole, t: [Whole; 3]) -> bool {
        let corners = t.map(point);
        segment_touches_triangle(
            &point(a),
            &point(b),
            [&corners[0], &corners[1], &corners[2]],
        )
    }

    fn minus(a: Whole, b: Whole) -> Whole {
        [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
    }

    fn cross(a: Whole, b: Whole) -> Whole {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    }

    fn dot(a: Whole, b: Whole) -> i64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    /// Whether the point where a line meets the triangle's plane is in the triangle, in whole
    /// numbers; none if the line does not meet the plane in one point.
    fn plain_answer(a: Whole, b: Whole, t: [Whole; 3]) -> Option<bool> {
        let normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
        let (at_a, at_b) = (dot(normal, minus(a, t[0])), dot(normal, minus(b, t[0])));
        if at_a == at_b {
            return None;
        }
        // The meeting point times `scale`.
        let scale = at_a - at_b;
        let meeting = [0, 1, 2].map(|i| b[i] * at_a - a[i] * at_b);
        let within = (0..3).all(|k| {
            let (u, v) = (t[k], t[(k + 1) % 3]);
            let turn = cross(minus(v, u), minus(meeting, u.map(|c| c * scale)));
            dot(normal, turn) * scale.signum() >= 0
        });
        Some(at_a.signum() * at_b.signum() <= 0 && within)
    }

    fn whole(reach: i64) -> impl Strategy<Value = Whole> {
        [-reach..=reach, -reach..=reach, -reach..=reach]
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            cases: 20_000, failure_persistence: None, ..Default::default()
        })]

        #[test]
        fn agrees_with_whole_number_arithmetic(
            a in whole(3), b in whole(3), t in [whole(3), whole(3), whole(3)],
        ) {
            if let Some(expected) = plain_answer(a, b, t) {
                prop_assert_eq!(touches(a, b, t), expected);
            }
        }

        /// Also where all lies in one plane, on one line or on one spot.
        #[test]
        fn a_segment_touches_what_one_of_its_halves_touches(
            a in whole(2), b in whole(2), t in [whole(2), whole(2), whole(2)], flat in 0_usize..4,
        ) {
            // In the plane z = 0 mostly, and in even numbers so that the middle is exact.
            let double = |p: Whole| {
                let mut p = p.map(|c| 2 * c);
                if flat > 0 { p[2] = 0; }
                p
            };
            let (a, b, t) = (double(a), double(b), t.map(double));
            let middle = [0, 1, 2].map(|i| (a[i] + b[i]) / 2);
            let whole = touches(a, b, t);
            prop_assert_eq!(whole, touches(a, middle, t) || touches(middle, b, t));
            prop_assert_eq!(whole, touches(b, a, t));
            prop_assert_eq!(whole, touches(a, b, [t[1], t[2], t[0]]));
            prop_assert_eq!(whole, touches(a, b, [t[1], t[0], t[2]]));
            if [a, b].iter().any(|end| t.contains(end)) {
                prop_assert!(whole);
            }
        }

        /// In the plane, a segment touches a triangle if it does any of the points of a fine grid
        /// on the triangle, all of which are whole after scaling.
        #[test]
        fn no_touch_in_the_plane_is_missed(
            a in whole(3), b in whole(3), t in [whole(3), whole(3), whole(3)],
        ) {
            let scaled = |p: Whole| [12 * p[0], 12 * p[1], 0];
            let (a, b, t) = (scaled(a), scaled(b), t.map(scaled));
            for u in 0..=12 {
                for v in 0..=12 - u {
                    let w = 12 - u - v;
                    let p = [0, 1, 2].map(|i| (t[0][i] * u + t[1][i] * v + t[2][i] * w) / 12);
                    prop_assert!(touches(p, p, t));
                    if touches(a, b, [p, p, p]) {
                        prop_assert!(touches(a, b, t));
                    }
                }
            }
        }
    }
}
