//! How often a closed surface winds round a point: an exact count of the faces above it.
//!
//! The count is the sum over the faces that a ray along +z crosses, +1 outward and −1 inward. Rays
//! through edges and corners are moved aside by an infinitesimal (ε, ε²), so that every crossing
//! belongs to exactly one face (simulation of simplicity, Edelsbrunner and Mücke 1990). For a
//! point off the surface this equals the generalised winding number by solid angles, also where
//! the surface crosses itself.

use nalgebra::Point3;

use crate::predicates::{ALONG_Z, side_of_plane};

type Point = Point3<f64>;

/// What one face adds to the winding number of `p`: +1, −1 or 0. Arbitrary for `p` on the face.
pub(crate) fn crossing_above(p: &Point, [a, b, c]: [&Point; 3]) -> i32 {
    let turn = left_turn(a, b, p);
    if turn == 0 || left_turn(b, c, p) != turn || left_turn(c, a, p) != turn {
        return 0;
    }
    // Seen from above, the face turns anticlockwise (+1, an outward crossing) or clockwise.
    let is_above = side_of_plane(a, b, c, p) * f64::from(turn) < 0.0;
    if is_above { turn } else { 0 }
}

/// On which side of the projected line from `u` to `v` the point `p` + (ε, ε²) lies: 1 left, −1
/// right, and 0 only if the line projects to a point.
fn left_turn(u: &Point, v: &Point, p: &Point) -> i32 {
    let exact = ALONG_Z.side_of_line(u, v, p);
    let decisive = [exact, u.y - v.y, v.x - u.x]
        .into_iter()
        .find(|&s| s != 0.0);
    match decisive {
        Some(s) if s > 0.0 => 1,
        Some(_) => -1,
        None => 0,
    }
}
