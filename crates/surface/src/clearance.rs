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
