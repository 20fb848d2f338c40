//! Which of many short ways from one place keep off a surface.

use nalgebra::{Point3, Vector3};

use crate::spatial::distance_to_triangle;
use crate::{Fan, Surface, is_usable};

type Point = Point3<f64>;

/// Bounds are given away by this much, relatively, so that rounding decides nothing.
const SLACK: f64 = 1e-9;

/// Room for the ways from one place, kept from place to place.
#[derive(Clone, Debug, Default)]
pub struct Clearance {
    fan: Fan,
    /// The faces that some way may come near to.
    near: Vec<NearFace>,
    /// The ways that are clear: the numbers of their ends.
    clear: Vec<usize>,
    ends: Vec<Point>,
}

/// What bounds the distance to a face from below.
#[derive(Clone, Copy, Debug)]
struct NearFace {
    face: usize,
    /// Of length one, or zero for a face without area.
    normal: Vector3<f64>,
    /// A ball round the face.
    centre: Point,
    radius: f64,
}

impl Clearance {
    /// The numbers of the `ends` (world, cm), in their order, to which a robot at `start` can go
    /// straight and keep clear: the start is outside, the way does not touch the surface, and the end
    /// is farther than `clearance` (cm, not negative) from it.
    ///
    /// The answers are those of [`Surface::signed_distance`] and [`Surface::crosses`] for each: along
    /// a way that touches nothing the inside stays the inside. Allocates only where there is
    /// more to hold than ever before.
    pub fn clear_ways(
        &mut self,
        surface: &Surface,
        start: &Point,
        ends: impl IntoIterator<Item = Point>,
        clearance: f64,
    ) -> &[usize] {
        self.ends.clear();
        self.ends.extend(ends);
        self.clear.clear();
        if !is_usable(start) || surface.winding_number_face_by_face(start) != 0 {
            return &self.clear;
        }
        let usable = (0..self.ends.len()).filter(|&i| is_usable(&self.ends[i]));
        self.clear.extend(usable);
        let length = |end: &Point| (end - start).norm();
        let longest = self
            .clear
            .iter()
            .fold(0.0_f64, |most, &i| most.max(length(&self.ends[i])));
        let reach = (clearance + longest) * (1.0 + SLACK);
        if surface.distance_face_by_face(start) > reach {
            return &self.clear;
        }
        self.find_near(surface, start, reach);
        let (near, ends) = (&self.near, &self.ends);
        self.clear.retain(|&i| {
            let end = &ends[i];
            near.iter().all(|face| {
                face.is_surely_beyond(end, clearance)
                    || distance_to_triangle(end, surface.corners(face.face)) > clearance
            })
        });
        let free = self
            .fan
            .free(surface, start, ends, self.clear.iter().copied());
        self.clear.clear();
        self.clear.extend_from_slice(free);
        self.clear.sort_unstable();
        &self.clear
    }

    fn find_near(&mut self, surface: &Surface, start: &Point, reach: f64) {
        self.near.clear();
        for (face, bounds) in surface.boxes().iter().enumerate() {
            if bounds.squared_distance(start) <= reach * reach {
                self.near.push(NearFace::of(surface, face));
            }
        }
        // The nearest refuse most ends.
        let distance = |face: &NearFace| (face.centre - start).norm() - face.radius;
        self.near
            .sort_unstable_by(|a, b| distance(a).total_cmp(&distance(b)));
    }
}

impl NearFace {
    fn of(surface: &Surface, face: usize) -> Self {
        let [a, b, c] = surface.corners(face);
        let centre = Point::from((a.coords + b.coords + c.coords) / 3.0);
        let radius = [a, b, c]
            .iter()
            .fold(0.0_f64, |r, p| r.max((*p - centre).norm()));
        let normal = (b - a).cross(&(c - a));
        // A sliver's normal is mostly rounding.
        let is_sliver = normal.norm() <= 1e-6 * radius * radius;
        let normal = if is_sliver {
            Vector3::zeros()
        } else {
            normal.normalize()
        };
        Self {
            face,
            normal,
            centre,
            radius,
        }
    }

    /// Whether the face is farther from `p` than `clearance` beyond doubt.
    fn is_surely_beyond(&self, p: &Point, clearance: f64) -> bool {
        let from_centre = p - self.centre;
        let size = p.coords.amax().max(self.centre.coords.amax());
        let limit = clearance + SLACK * (clearance + size + self.radius);
        let ball = limit + self.radius;
        self.normal.dot(&from_centre).abs() > limit || from_centre.norm_squared() > ball * ball
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::Topology;

    /// A tetrahedron whose face z = 0 is this triangle.
    fn below(triangle: [[f64; 2]; 3], depth: f64) -> Surface {
        let [a, b, c] = triangle.map(|[x, y]| Point::new(x, y, 0.0));
        let corners = [a, b, c, Point::new(0.0, 0.0, -depth)];
        let topology = Arc::new(Topology::convex_hull(&corners).unwrap());
        Surface::new(&topology, &corners).unwrap()
    }

    fn top(surface: &Surface) -> NearFace {
        let is_top = |face: &usize| surface.corners(*face).iter().all(|p| p.z == 0.0);
        NearFace::of(surface, (0..4).find(is_top).unwrap())
    }

    #[test]
    fn bounds_pass_over_what_is_beyond_them_by_more_than_rounding() {
        let face = top(&below(
            [[-100.0, -100.0], [200.0, -100.0], [-100.0, 200.0]],
            50.0,
        ));
        for beside in [Point::new(0.0, 0.0, 101.0), Point::new(330.0, 0.0, 0.0)] {
            assert!(face.is_surely_beyond(&beside, 100.0));
        }
        // The slack is a part of the largest length, of no product of two.
        assert!(face.is_surely_beyond(&Point::new(0.0, 0.0, 100.0 + 1e-6), 100.0));
    }

    #[test]
    fn a_small_thin_face_has_a_normal() {
        let face = top(&below([[-0.1, 0.0], [0.1, 0.0], [0.0, 0.01]], 0.1));
        assert!((face.normal.norm() - 1.0).abs() < 1e-12);
        assert!((face.normal.z.abs() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_nearest_faces_come_first_and_none_of_a_surface_out_of_reach() {
        let surface = below([[-1.0, -1.0], [2.0, -1.0], [-1.0, 2.0]], 0.2);
        let mut room = Clearance::default();
        for (x, y) in (-6..=6).flat_map(|x| (-6..=6).map(move |y| (f64::from(x), f64::from(y)))) {
            let start = Point::new(x, y, 1.0);
            room.find_near(&surface, &start, 100.0);
            assert_eq!(room.near.len(), 4);
            let bound = |face: &NearFace| (face.centre - start).norm() - face.radius;
            assert!(room.near.is_sorted_by_key(bound));
        }
        let (start, end) = (Point::new(0.0, 0.0, 1.0), Point::new(0.0, 0.0, 1.5));
        let mut room = Clearance::default();
        assert_eq!(room.clear_ways(&surface, &start, [end], 0.1), [0]);
        assert!(room.near.is_empty());
    }
}
