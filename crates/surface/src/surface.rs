//! A topology placed in the world at one moment.

use std::sync::{Arc, OnceLock};

use nalgebra::Point3;

use crate::predicates::segment_touches_triangle;
use crate::spatial::{Bounds, Tree, distance_to_triangle};
use crate::winding::crossing_above;
use crate::{SurfaceError, Topology, check_points, is_usable};

/// From this many faces on, a tree of boxes is built for single questions; below, trying them all is
/// faster.
const TREE_FROM_FACES: usize = 128;

/// A closed surface in the world (cm): a [`Topology`] with a position for each of its points.
///
/// Cheap to make, and cheaper to [`place`](Surface::place) again whenever the points move. It may
/// cross itself a little and have faces without area, as deformed and estimated surfaces do.
///
/// Where many segments start at one place, a [`Fan`](crate::Fan) answers for all of them at once.
///
/// Questions about positions that are not finite (or whose coordinates are beyond
/// [`MAX_COORDINATE_CM`](crate::MAX_COORDINATE_CM) or below
/// [`MIN_COORDINATE_CM`](crate::MIN_COORDINATE_CM)) are answered on the safe side: the distance is
/// NaN, which is greater than no clearance; the segment crosses; nothing is seen.
#[derive(Clone)]
pub struct Surface {
    topology: Arc<Topology>,
    points: Vec<Point3<f64>>,
    boxes: Vec<Bounds>,
    tree_from: usize,
    /// Made when the first question asks for it.
    tree: OnceLock<Tree>,
}

impl Surface {
    /// Places `points` (world, cm), one for each point of the topology.
    ///
    /// # Errors
    /// A wrong number of points, or unusable coordinates.
    pub fn new(topology: &Arc<Topology>, points: &[Point3<f64>]) -> Result<Self, SurfaceError> {
        Self::with_tree_from(TREE_FROM_FACES, topology, points)
    }

    /// As [`Surface::new`], with the tree from another number of faces on.
    fn with_tree_from(
        least_faces: usize,
        topology: &Arc<Topology>,
        points: &[Point3<f64>],
    ) -> Result<Self, SurfaceError> {
        let mut surface = Self {
            topology: Arc::clone(topology),
            points: Vec::new(),
            boxes: Vec::new(),
            tree_from: least_faces,
            tree: OnceLock::new(),
        };
        surface.place(points)?;
        Ok(surface)
    }

    /// Moves the points to new places (world, cm), as [`Surface::new`] would put them, without
    /// allocating.
    ///
    /// # Errors
    /// A wrong number of points, or unusable coordinates; the surface stays as it was.
    pub fn place(&mut self, points: &[Point3<f64>]) -> Result<(), SurfaceError> {
        let (expected, given) = (self.topology.point_count(), points.len());
        if expected != given {
            return Err(SurfaceError::PointCount { expected, given });
        }
        check_points(points)?;
        self.points.clear();
        self.points.extend_from_slice(points);
        self.boxes.clear();
        self.boxes.extend(
            self.topology
                .faces()
                .iter()
                .map(|corners| Bounds::of(corners.map(|i| &points[i]))),
        );
        self.tree = OnceLock::new();
        Ok(())
    }

    /// The distance from `p` (world) to the surface in cm: positive outside, negative inside.
    ///
    /// Inside is where the surface winds round `p`, in whichever direction: also in a pocket that
    /// a deformation has turned inside out.
    pub fn signed_distance(&self, p: &Point3<f64>) -> f64 {
        if !is_usable(p) {
            return f64::NAN;
        }
        let distance = self.distance(p);
        if self.winding_number(p) == 0 {
            distance
        } else {
            -distance
        }
    }

    /// Whether the closed segment from `a` to `b` (world) touches any face, be it at an edge or
    /// corner only. Exact.
    pub fn crosses(&self, a: &Point3<f64>, b: &Point3<f64>) -> bool {
        !is_usable(a) || !is_usable(b) || self.any_face_touched(a, b, |_| true)
    }

    /// Whether a sensor (world) has a line of sight to surface point number `point`: the closed
    /// segment between them touches no face that the point is not a corner of. Exact: a line
    /// along or through an edge or corner of such a face is blocked.
    ///
    /// A sensor at the point sees it. A number that is no point's is not seen.
    pub fn sees(&self, sensor: &Point3<f64>, point: usize) -> bool {
        let Some(target) = self.points.get(point) else {
            return false;
        };
        sensor == target
            || is_usable(sensor)
                && !self.any_face_touched(sensor, target, |corners| !corners.contains(&point))
    }

    /// Where the points are (world, cm).
    pub fn points(&self) -> &[Point3<f64>] {
        &self.points
    }

    /// Whether the surface has been made of just this topology.
    pub fn is_over(&self, topology: &Arc<Topology>) -> bool {
        Arc::ptr_eq(&self.topology, topology)
    }

    /// Which points are joined by which faces.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    pub(crate) fn corners(&self, face: usize) -> [&Point3<f64>; 3] {
        self.topology.faces()[face].map(|i| &self.points[i])
    }

    /// A box round each face.
    pub(crate) fn boxes(&self) -> &[Bounds] {
        &self.boxes
    }

    /// The tree over the faces, where there are enough of them for one.
    fn tree(&self) -> Option<&Tree> {
        (self.boxes.len() >= self.tree_from)
            .then(|| self.tree.get_or_init(|| Tree::over(&self.boxes)))
    }

    fn any_face_touched(
        &self,
        a: &Point3<f64>,
        b: &Point3<f64>,
        counts: impl Fn(&[usize; 3]) -> bool,
    ) -> bool {
        let touches = |face: usize| {
            counts(&self.topology.faces()[face])
                && segment_touches_triangle(a, b, self.corners(face))
        };
        if let Some(tree) = self.tree() {
            return tree.near_segment(a, b).any(touches);
        }
        let around = Bounds::of([a, b]);
        (0..self.boxes.len()).any(|face| self.boxes[face].touch(&around) && touches(face))
    }

    fn distance(&self, p: &Point3<f64>) -> f64 {
        match self.tree() {
            Some(tree) => tree.least_distance(p, |face| self.distance_to_face(p, face)),
            None => self.distance_face_by_face(p),
        }
    }

    fn winding_number(&self, p: &Point3<f64>) -> i32 {
        match self.tree() {
            Some(tree) => tree.above(p).map(|face| self.crossing(p, face)).sum(),
            None => self.winding_number_face_by_face(p),
        }
    }

    /// The distance from `p`, without a sign and without a tree.
    pub(crate) fn distance_face_by_face(&self, p: &Point3<f64>) -> f64 {
        let mut least = f64::INFINITY;
        for (face, bounds) in self.boxes.iter().enumerate() {
            if bounds.squared_distance(p) < least * least {
                least = least.min(self.distance_to_face(p, face));
            }
        }
        least
    }

    /// How often the surface winds round `p`, without a tree.
    pub(crate) fn winding_number_face_by_face(&self, p: &Point3<f64>) -> i32 {
        (0..self.boxes.len())
            .filter(|&face| self.boxes[face].reaches_above(p))
            .map(|face| self.crossing(p, face))
            .sum()
    }

    fn distance_to_face(&self, p: &Point3<f64>, face: usize) -> f64 {
        distance_to_triangle(p, self.corners(face))
    }

    fn crossing(&self, p: &Point3<f64>, face: usize) -> i32 {
        crossing_above(p, self.corners(face))
    }
}

impl std::fmt::Debug for Surface {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Surface")
            .field("points", &self.points)
            .field("faces", &self.topology.faces())
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A ball with every second point drawn in, placed with and without a tree.
    fn both() -> [Surface; 2] {
        let round: Vec<Point3<f64>> = (0..400_u16)
            .map(|i| {
                let i = f64::from(i);
                let (height, turn) = (1.0 - (2.0 * i + 1.0) / 400.0, 2.4 * i);
                let radius = (1.0 - height * height).sqrt();
                Point3::new(radius * turn.cos(), radius * turn.sin(), height)
            })
            .collect();
        let topology = Arc::new(Topology::convex_hull(&round).unwrap());
        let dented: Vec<Point3<f64>> = round
            .iter()
            .enumerate()
            .map(|(i, q)| Point3::from(q.coords * if i % 2 == 0 { 1.0 } else { 0.5 }))
            .collect();
        [0, usize::MAX].map(|from| Surface::with_tree_from(from, &topology, &dented).unwrap())
    }

    fn point() -> impl Strategy<Value = Point3<f64>> {
        [-1.5..1.5, -1.5..1.5, -1.5..1.5].prop_map(Point3::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

        #[test]
        fn a_tree_changes_no_answer(
            segments in prop::collection::vec((point(), point(), 0_usize..400), 50),
        ) {
            let [with, without] = both();
            prop_assert!(with.tree().is_some() && without.tree().is_none());
            for (a, b, i) in segments {
                prop_assert_eq!(with.signed_distance(&a), without.signed_distance(&a));
                prop_assert_eq!(with.crosses(&a, &b), without.crosses(&a, &b));
                prop_assert_eq!(with.sees(&a, i), without.sees(&a, i));
                // Through corners and along axes, where boxes are only just touched.
                let corner = with.points()[i];
                prop_assert!(with.crosses(&a, &corner));
                let above = Point3::new(corner.x, corner.y, a.z);
                prop_assert_eq!(with.signed_distance(&above), without.signed_distance(&above));
                prop_assert_eq!(with.crosses(&above, &corner), without.crosses(&above, &corner));
                let past = corner + (corner - a);
                prop_assert!(with.crosses(&a, &past) == without.crosses(&a, &past));
            }
        }
    }

    #[test]
    fn a_tree_is_built_for_many_faces_only() {
        let [with, without] = both();
        let anew = Surface::new(&with.topology, &without.points).unwrap();
        assert!(anew.tree().is_some());
        let few = &with.points[..40];
        let topology = Arc::new(Topology::convex_hull(few).unwrap());
        assert!(Surface::new(&topology, few).unwrap().tree().is_none());
    }
}
