//! The motion of an object: translation, deformation and their rotations together.

use std::sync::Arc;

use nalgebra::{IsometryMatrix3, Point3, Rotation3, Translation3, Vector3};

use crate::{AxisRotation, Clock, Deformation, NoTranslation, Rigid, Rotation, Translation};

/// How every point of an object moves: t, D, r_t and r_d of eq. (2), and what eq. (2) lacks.
///
/// The default is an object at rest. Cloning is cheap, the parts are shared.
///
/// # From displacements to eq. (2)
/// Eq. (2) moves a feature by `r_t t_n + r_d d_n`. A deformation is given here by the displacement
/// D(n), turned by r_d(n): the feature is shown at `base + r_d(n) D(n)`, its base moving by
/// `r_t(n) t_n`. The difference of two steps is eq. (2) with
///
/// ```text
/// d_n = r_d(n)ᵀ r_d(n+1) D(n+1) − D(n)
/// ```
///
/// which for a constant r_d is the plain `D(n+1) − D(n)`. So an r_d that turns carries the
/// displacement along with it, and a deformation that comes back to D = 0 comes back to the rest
/// shape, whatever r_d did in between.
///
/// # Beyond eq. (2)
/// With a [`Clock`] of its own, step n shows all this as it is at time τ(n). At step 1 the base is
/// at rest all the same; from there it takes the way that leads from T(τ(1)) to T(τ(n)), r_t staying
/// what it is from one whole time to the next. A [`Turn`] turns the object rigidly, deformed as it
/// is, by its rotation at step n.
#[derive(Debug, Clone)]
pub struct ObjectMotion {
    /// t: what shifts all points alike.
    pub translation: Arc<dyn Translation>,
    /// D: what displaces each point from its rest position.
    pub deformation: Arc<dyn Deformation>,
    /// r_t, which turns the translation.
    pub r_t: Arc<dyn Rotation>,
    /// r_d, which turns the displacement.
    pub r_d: Arc<dyn Rotation>,
    /// τ: the time of these four at each step.
    pub clock: Clock,
    /// What turns the object as a whole, if anything does.
    pub turn: Option<Turn>,
}

/// A rotation of the whole object about a point that the translation takes along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// Where that point is at step 1 (world frame, cm).
    pub centre: Point3<f64>,
    /// The rotation at each step.
    pub rotation: AxisRotation,
}

impl Default for ObjectMotion {
    fn default() -> Self {
        Self {
            translation: Arc::new(NoTranslation),
            deformation: Arc::new(Rigid),
            r_t: Arc::new(AxisRotation::default()),
            r_d: Arc::new(AxisRotation::default()),
            clock: Clock::default(),
            turn: None,
        }
    }
}

impl ObjectMotion {
    /// How far the base of every feature moves from step `n` to `n + 1` (world frame, cm):
    /// r_t(n) t_n where the clock is that of the steps.
    pub fn translation_step(&self, n: usize) -> Vector3<f64> {
        let (mut from, end) = (self.clock.time(n), self.clock.time(n.saturating_add(1)));
        let mut moved = Vector3::zeros();
        while from < end {
            let whole = from.floor();
            // A time so large that it has no neighbour one step away must not hold us up.
            let to = Some(whole + 1.0).filter(|next| (from..end).contains(next) && *next > from);
            let to = to.unwrap_or(end);
            moved += self.r_t.at(whole) * self.translation.between(from, to);
            from = to;
        }
        moved
    }

    /// r_d at step `n`.
    pub fn r_d_at(&self, n: usize) -> Rotation3<f64> {
        self.r_d.at(self.clock.time(n))
    }

    /// aₖ at step `n`: how much there is of mode `k` of the deformation.
    pub fn amount(&self, k: usize, n: usize) -> f64 {
        self.deformation.amount(k, self.clock.time(n))
    }

    /// How the turn has moved the points of the object at step `n`, its translation apart (world
    /// frame, cm); the identity where there is none.
    pub fn turn_at(&self, n: usize) -> IsometryMatrix3<f64> {
        let Some(Turn { centre, rotation }) = &self.turn else {
            return IsometryMatrix3::identity();
        };
        let rotation = rotation.at(Clock::default().time(n));
        let translation = centre.coords - rotation * centre.coords;
        IsometryMatrix3::from_parts(Translation3::from(translation), rotation)
    }

    /// Where the point that rests at `rest` is shown at step `n`, relative to its base (world frame,
    /// cm): r_d(n) D(n), turned.
    pub fn offset(&self, rest: &Point3<f64>, n: usize) -> Vector3<f64> {
        let displacement = self.deformation.displacement(rest, self.clock.time(n));
        let deformed = self.r_d_at(n) * displacement;
        if self.turn.is_none() {
            return deformed;
        }
        self.turn_at(n) * (rest + deformed) - rest
    }

    /// How far the point that rests at `rest` moves from step `n` to `n + 1` (world frame, cm),
    /// noise apart: r_t t_n + r_d d_n of eq. (2).
    pub fn feature_motion(&self, rest: &Point3<f64>, n: usize) -> Vector3<f64> {
        let deformation = self.offset(rest, n.saturating_add(1)) - self.offset(rest, n);
        self.translation_step(n) + deformation
    }
}
