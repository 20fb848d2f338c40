//! Local deformations: D, whose change from step to step is d of eq. (2).

use std::fmt::Debug;
use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use crate::Amount;

/// How the points of the object are displaced from where they rest: D(τ) = Σ aₖ(τ) mₖ(rest).
///
/// The displacement is a sum of *modes*, fields that depend on the rest position alone, each times
/// an *amount* that depends on time alone. Whoever draws the object needs its modes once and
/// a few numbers a step.
pub trait Deformation: Debug + Send + Sync {
    /// How many modes there are.
    fn mode_count(&self) -> usize;

    /// mₖ: mode `k` (from 0) at the material point that rests at `rest` (world frame, cm). Zero
    /// where there is no such mode.
    fn mode(&self, k: usize, rest: &Point3<f64>) -> Vector3<f64>;

    /// aₖ(τ): how much of mode `k` there is at `time` (in steps, 1 at the start). Amount times mode
    /// is in cm.
    fn amount(&self, k: usize, time: f64) -> f64;

    /// D(τ): the displacement at `time` (in steps, 1 at the start) of the material point that rests
    /// at `rest` (world frame), in cm, before r_d turns it.
    fn displacement(&self, rest: &Point3<f64>, time: f64) -> Vector3<f64> {
        (0..self.mode_count())
            .map(|k| self.mode(k, rest) * self.amount(k, time))
            .sum()
    }
}

/// The object keeps its shape: D = 0.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Rigid;

impl Deformation for Rigid {
    fn mode_count(&self) -> usize {
        0
    }

    fn mode(&self, _k: usize, _rest: &Point3<f64>) -> Vector3<f64> {
        Vector3::zeros()
    }

    fn amount(&self, _k: usize, _time: f64) -> f64 {
        0.0
    }
}

/// A deformation whose displacements are all the same number of times as large.
#[derive(Debug, Clone)]
pub struct ScaledDeformation {
    deformation: Arc<dyn Deformation>,
    factor: f64,
}

impl ScaledDeformation {
    /// `factor` times the displacements of `deformation`.
    pub fn new(deformation: Arc<dyn Deformation>, factor: f64) -> Self {
        Self {
            deformation,
            factor,
        }
    }
}

impl Deformation for ScaledDeformation {
    fn mode_count(&self) -> usize {
        self.deformation.mode_count()
    }

    fn mode(&self, k: usize, rest: &Point3<f64>) -> Vector3<f64> {
        self.deformation.mode(k, rest)
    }

    fn amount(&self, k: usize, time: f64) -> f64 {
        self.factor * self.deformation.amount(k, time)
    }
}

/// Which way an anchored deformation moves a point.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Direction {
    /// Away from the vertical line through the anchor; a point on that line moves along z, away
    /// from the anchor. The paper's runs.
    #[default]
    Horizontal,
    /// Straight away from the anchor.
    Radial,
}

/// Below this distance (cm) two points, or a point and a vertical line, count as touching: a
/// direction between them would be rounding error.
const TOUCHING_CM: f64 = 1e-9;

impl Direction {
    /// The unit vector in which `rest` moves away from `anchor`; zero for the anchor itself.
    pub fn from_anchor(self, anchor: &Point3<f64>, rest: &Point3<f64>) -> Vector3<f64> {
        let away = rest - anchor;
        let horizontal = Vector3::new(away.x, away.y, 0.0);
        let way = match self {
            Self::Horizontal if horizontal.norm() > TOUCHING_CM => horizontal,
            Self::Horizontal | Self::Radial => away,
        };
        way.try_normalize(TOUCHING_CM)
            .unwrap_or_else(Vector3::zeros)
    }
}

/// Expansion and shrinkage around a fixed point (section IV-A of the paper): at any time every point
/// is displaced by the same amount, each in its own direction away from the anchor.
///
/// The paper's amounts are 0.2 cm × (0, 1, 2, 3, 2, 1), again and again; its public code has
/// 0.2 cm × (1, 2, 3, 3, 2, 1). Either is a [`Schedule`](crate::Schedule); a
/// [`Sinusoid`](crate::Sinusoid) serves as well.
#[derive(Debug, Clone, PartialEq)]
pub struct AnchoredDeformation<A> {
    anchor: Point3<f64>,
    direction: Direction,
    amount: A,
}

impl<A: Amount> AnchoredDeformation<A> {
    /// A deformation around `anchor`, the rest position (world frame, cm) of the anchor feature.
    pub fn new(anchor: Point3<f64>, direction: Direction, amount: A) -> Self {
        Self {
            anchor,
            direction,
            amount,
        }
    }
}

impl<A: Amount> Deformation for AnchoredDeformation<A> {
    fn mode_count(&self) -> usize {
        1
    }

    /// The one mode: the unit vector away from the anchor.
    fn mode(&self, k: usize, rest: &Point3<f64>) -> Vector3<f64> {
        match k {
            0 => self.direction.from_anchor(&self.anchor, rest),
            _ => Vector3::zeros(),
        }
    }

    fn amount(&self, k: usize, time: f64) -> f64 {
        match k {
            0 => self.amount.at(time),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Schedule, Sinusoid};
    use approx::assert_relative_eq;

    const ANCHOR: Point3<f64> = Point3::new(1.5, 0.0, 0.0);

    fn anchored(direction: Direction) -> AnchoredDeformation<Schedule> {
        AnchoredDeformation::new(ANCHOR, direction, Schedule::new(vec![0.0, 0.5]).unwrap())
    }

    #[test]
    fn horizontal_leaves_the_height_alone() {
        let moved = anchored(Direction::Horizontal).displacement(&Point3::new(4.5, 4.0, 7.0), 2.0);
        assert_relative_eq!(moved, Vector3::new(0.3, 0.4, 0.0), epsilon = 1e-12);
    }

    #[test]
    fn straight_above_and_below_the_anchor_moves_along_z() {
        let horizontal = anchored(Direction::Horizontal);
        let above = horizontal.displacement(&Point3::new(1.5, 0.0, 4.0), 2.0);
        let below = horizontal.displacement(&Point3::new(1.5, 0.0, -4.0), 2.0);
        assert_eq!(above, Vector3::new(0.0, 0.0, 0.5));
        assert_eq!(below, Vector3::new(0.0, 0.0, -0.5));
    }

    #[test]
    fn radial_moves_straight_away() {
        let moved = anchored(Direction::Radial).displacement(&Point3::new(1.5, -3.0, 4.0), 2.0);
        assert_relative_eq!(moved, Vector3::new(0.0, -0.3, 0.4), epsilon = 1e-12);
    }

    #[test]
    fn the_anchor_stays() {
        for direction in [Direction::Horizontal, Direction::Radial] {
            assert_eq!(
                anchored(direction).displacement(&ANCHOR, 2.0),
                Vector3::zeros()
            );
        }
    }

    #[test]
    fn a_sinusoid_goes_both_ways() {
        let wave = Sinusoid::new(0.5, 4.0, 0.0).unwrap();
        let breathing = AnchoredDeformation::new(ANCHOR, Direction::Radial, wave);
        let point = Point3::new(2.5, 0.0, 0.0);
        assert_relative_eq!(breathing.displacement(&point, 2.0).x, 0.5, epsilon = 1e-12);
        assert_relative_eq!(breathing.displacement(&point, 4.0).x, -0.5, epsilon = 1e-12);
    }

    #[test]
    fn scaled_is_as_many_times_as_large() {
        let plain = anchored(Direction::Radial);
        let twice = ScaledDeformation::new(Arc::new(plain.clone()), 2.0);
        let rest = Point3::new(1.5, -3.0, 4.0);
        let expected = plain.displacement(&rest, 2.0) * 2.0;
        assert_eq!(twice.displacement(&rest, 2.0), expected);
        assert_eq!(twice.mode_count(), 1);
    }

    #[test]
    fn rigid_is_rigid() {
        assert_eq!(Rigid.displacement(&ANCHOR, 3.0), Vector3::zeros());
    }
}
