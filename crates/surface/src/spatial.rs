//! The boundary to parry: boxes, the distance to a triangle, and a tree of boxes for surfaces
//! with many faces. Positions cross it as nalgebra points.

use nalgebra::Point3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::Triangle;

type Point = Point3<f64>;

fn vector(p: &Point) -> Vector {
    Vector::new(p.x, p.y, p.z)
}

/// The distance from `p` to the nearest point of a triangle.
pub(crate) fn distance_to_triangle(p: &Point, [a, b, c]: [&Point; 3]) -> f64 {
    let p = vector(p);
    let triangle = Triangle::new(vector(a), vector(b), vector(c));
    (triangle.project_local_point(p, false).point - p).length()
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
}

impl Bounds {
    /// The smallest box round some points.
    pub(crate) fn of<const N: usize>(points: [&Point; N]) -> Self {
        let mut bounds = Self {
            low: [f64::INFINITY; 3],
            high: [f64::NEG_INFINITY; 3],
        };
        for p in points {
            bounds.include(p);
        }
        bounds
    }

    /// Grows the box to hold `p`.
    pub(crate) fn include(&mut self, p: &Point) {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(p[axis]);
            self.high[axis] = self.high[axis].max(p[axis]);
        }
    }

    fn of_aabb(aabb: &Aabb) -> Self {
        Self {
            low: aabb.mins.into(),
            high: aabb.maxs.into(),
        }
    }

    /// Whether the boxes have a point in common.
    pub(crate) fn touch(&self, other: &Self) -> bool {
        (0..3).all(|i| self.low[i] <= other.high[i] && other.low[i] <= self.high[i])
    }

    /// Whether a ray from `p` along +z touches the box.
    pub(crate) fn reaches_above(&self, p: &Point) -> bool {
        (0..2).all(|i| self.low[i] <= p[i] && p[i] <= self.high[i]) && p.z <= self.high[2]
    }

    /// The distance from `p` to the nearest point of the box, squared.
    pub(crate) fn squared_distance(&self, p: &Point) -> f64 {
        (0..3)
            .map(|i| (self.low[i] - p[i]).max(p[i] - self.high[i]).max(0.0))
            .map(|gap| gap * gap)
            .sum()
    }

    /// Whether the segment surely passes the box by; rounding errs towards no.
    fn surely_missed_by(&self, a: &Point, b: &Point) -> bool {
        // Separating axes across the segment and each coordinate axis.
        let half = [0, 1, 2].map(|i| 0.5 * (self.high[i] - self.low[i]));
        let from_centre = [0, 1, 2].map(|i| 0.5 * (a[i] - self.low[i] + a[i] - self.high[i]));
        let along = [0, 1, 2].map(|i| b[i] - a[i]);
        // Differences are as uncertain as the coordinates that they come from.
        let corners = self.low.iter().chain(&self.high);
        let coordinate = corners.fold(a.coords.amax().max(b.coords.amax()), |most, x| {
            most.max(x.abs())
        });
        [(0, 1), (1, 2), (2, 0)].into_iter().any(|(i, j)| {
            let gap = (from_centre[i] * along[j] - from_centre[j] * along[i]).abs();
            let reach = half[i] * along[j].abs() + half[j] * along[i].abs();
            let lengths = [i, j].map(|k| half[k] + from_centre[k].abs() + along[k].abs());
            let rounding = 16.0 * f64::EPSILON * coordinate * (lengths[0] + lengths[1]);
            gap > reach + rounding
        })
    }
}

/// A tree of boxes over the faces of a surface. No query allocates.
#[derive(Clone)]
pub(crate) struct Tree(Bvh);

impl Tree {
    pub(crate) fn over(boxes: &[Bounds]) -> Self {
        let leaves: Vec<Aabb> = boxes
            .iter()
            .map(|b| Aabb::new(Vector::from(b.low), Vector::from(b.high)))
            .collect();
        Self(Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves))
    }

    /// The faces whose box the segment may touch.
    pub(crate) fn near_segment(&self, a: &Point, b: &Point) -> impl Iterator<Item = usize> {
        let around = Bounds::of([a, b]);
        self.faces(move |bounds| bounds.touch(&around) && !bounds.surely_missed_by(a, b))
    }

    /// The faces whose box a ray from `p` along +z touches.
    pub(crate) fn above(&self, p: &Point) -> impl Iterator<Item = usize> {
        self.faces(|bounds| bounds.reaches_above(p))
    }

    /// The least `distance` (from `p`) of any face; infinite without faces.
    pub(crate) fn least_distance(&self, p: &Point, distance: impl Fn(usize) -> f64) -> f64 {
        let to_box = |aabb: &Aabb, _: f64| Bounds::of_aabb(aabb).squared_distance(p).sqrt();
        self.0
            .find_best(
                f64::MAX,
                |node, best| to_box(&node.aabb(), best),
                |face, _| Some(distance(face as usize)),
            )
            .map_or(f64::INFINITY, |(_, least)| least)
    }

    fn faces(&self, may_touch: impl Fn(&Bounds) -> bool) -> impl Iterator<Item = usize> {
        self.0
            .leaves(move |node| may_touch(&Bounds::of_aabb(&node.aabb())))
            .map(|face| face as usize)
    }
}
