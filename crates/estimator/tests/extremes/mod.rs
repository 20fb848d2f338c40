//! Beliefs and noise with sigmas as far apart as files may state them.
#![allow(dead_code, reason = "each test file uses a part")]

use adslam_estimator::{Belief, EstimatorError, FilterNoise, PairMeasurement};
use adslam_models::{FeatureId, Pose};
use nalgebra::{Matrix6, Point3, Vector3, Vector6};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// What scenario files may state.
const EXPONENTS: std::ops::RangeInclusive<f64> = -9.0..=6.0;
pub const COUNT: usize = 3;

pub fn sigma(rng: &mut ChaCha8Rng) -> f64 {
    10_f64.powf(rng.random_range(EXPONENTS))
}

pub fn vector(rng: &mut ChaCha8Rng, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| rng.random_range(-size..size))
}

pub fn any_noise(rng: &mut ChaCha8Rng) -> FilterNoise {
    FilterNoise {
        rotation_sigma: sigma(rng).min(3.0),
        translation_sigma: sigma(rng),
        feature_motion_sigma: sigma(rng),
        feature_measurement_sigma: sigma(rng),
        structure_measurement_sigma: sigma(rng),
    }
}

/// An independent start with any sigmas.
pub fn any_belief(rng: &mut ChaCha8Rng) -> Belief {
    let sigmas = Vector6::from_fn(|k, _| {
        if k < 3 {
            sigma(rng).min(3.0)
        } else {
            sigma(rng)
        }
    });
    let covariance = Matrix6::from_diagonal(&sigmas.map(|s| s * s));
    let pose = Pose::from_vector(&Vector6::from_fn(|_, _| rng.random_range(-1.0..1.0)));
    let features = (0..COUNT).map(|_| Point3::from(vector(rng, 5.0)));
    Belief::initial(pose, features.collect(), &covariance, sigma(rng)).unwrap()
}

pub fn pairs(list: &[(usize, usize)], rng: &mut ChaCha8Rng) -> Vec<PairMeasurement> {
    list.iter()
        .map(|&(from, to)| PairMeasurement {
            from: FeatureId(from),
            to: FeatureId(to),
            z: vector(rng, 1.0),
        })
        .collect()
}

/// What a refusal for lost digits is.
pub fn is_refusal(error: &EstimatorError) -> bool {
    matches!(
        error,
        EstimatorError::TooPrecise { .. } | EstimatorError::LostInMotion { .. }
    )
}
