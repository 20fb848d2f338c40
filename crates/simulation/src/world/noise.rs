//! The noise of the true world.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use nalgebra::Vector3;
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

/// How the deformation noise `w_d` acts on the true features.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeformationNoise {
    /// It shakes each feature about its place, afresh at every step, as in the published results.
    Fresh,
    /// It adds up from step to step, as eq. (2) reads.
    Accumulating,
}

/// Standard deviations of the true noise, on each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldNoise {
    /// Of each angle of the robot's motion, radians.
    pub rotation_sigma: f64,
    /// Of the robot's translation, cm.
    pub translation_sigma: f64,
    /// σ_t of the features' global translation, cm.
    pub feature_translation_sigma: f64,
    /// σ_d of the features' local deformation, cm.
    pub feature_deformation_sigma: f64,
    /// Of a feature measurement, cm.
    pub feature_measurement_sigma: f64,
    /// Of a structure measurement, cm.
    pub structure_measurement_sigma: f64,
    /// Of the first estimate of a feature, cm.
    pub initial_feature_sigma: f64,
    /// How the deformation noise acts.
    pub deformation: DeformationNoise,
    /// Draws beyond this many sigmas are drawn again; nothing is cut where absent.
    pub truncate_at_sigmas: Option<f64>,
}

impl WorldNoise {
    /// A standard normal number, truncated if so asked.
    pub fn standard(&self, generator: &mut impl Rng) -> f64 {
        loop {
            let x: f64 = StandardNormal.sample(generator);
            if self.truncate_at_sigmas.is_none_or(|limit| x.abs() <= limit) {
                return x;
            }
        }
    }

    /// The variance of such a number: 1, or less where it is truncated.
    #[must_use]
    pub fn variance_of_standard(&self) -> f64 {
        self.truncate_at_sigmas.map_or(1.0, |limit| {
            let density = (-limit * limit / 2.0).exp() / TAU.sqrt();
            1.0 - 2.0 * limit * density / libm::erf(limit * FRAC_1_SQRT_2)
        })
    }

    /// Three of them.
    pub fn standard_vector(&self, generator: &mut impl Rng) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.standard(generator))
    }
}

/// The paper's noise on the polygon, for tests.
#[cfg(test)]
pub const NOISE: WorldNoise = WorldNoise {
    rotation_sigma: 0.02,
    translation_sigma: 0.03,
    feature_translation_sigma: 0.03,
    feature_deformation_sigma: 0.05,
    feature_measurement_sigma: 0.02,
    structure_measurement_sigma: 0.5,
    initial_feature_sigma: 0.02,
    deformation: DeformationNoise::Fresh,
    truncate_at_sigmas: None,
};
