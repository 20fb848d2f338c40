//! The motion of an object: translation, deformation and their rotations together.

use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use crate::{AxisRotation, Deformation, NoTranslation, Rigid, Rotation, Translation};

/// How every point of an object moves: t, D, r_t and r_d of eq. (2).
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
}

impl Default for ObjectMotion {
    fn default() -> Self {
        Self {
            translation: Arc::new(NoTranslation),
            deformation: Arc::new(Rigid),
            r_t: Arc::new(AxisRotation::default()),
            r_d: Arc::new(AxisRotation::default()),
        }
    }
}

impl ObjectMotion {
    /// r_t(n) t_n: how far the base of every feature moves from step `n` to `n + 1` (world frame,
    /// cm).
    pub fn translation_step(&self, n: usize) -> Vector3<f64> {
        self.r_t.at(n) * self.translation.step(n)
    }

    /// r_d(n) D(n): where the point that rests at `rest` is shown at step `n`, relative to its
    /// base (world frame, cm).
    pub fn offset(&self, rest: &Point3<f64>, n: usize) -> Vector3<f64> {
        self.r_d.at(n) * self.deformation.displacement(rest, n)
    }

    /// r_t t_n + r_d d_n of eq. (2): how far the point that rests at `rest` moves from step `n` to
    /// `n + 1` (world frame, cm), noise apart.
    pub fn feature_motion(&self, rest: &Point3<f64>, n: usize) -> Vector3<f64> {
        let deformation = self.offset(rest, n.saturating_add(1)) - self.offset(rest, n);
        self.translation_step(n) + deformation
    }
}
