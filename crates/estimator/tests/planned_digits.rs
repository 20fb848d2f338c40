//! Whatever sigmas a file states, the traces that planners compare are right to six digits or refused: held against
//! numbers of 120 digits.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;
mod exact;
mod extremes;

use adslam_estimator::{DirectTrace, FeatureMeasurement, PlannedMeasurement, PosteriorTrace};
use adslam_models::{Control, FeatureId};
use common::every_pair;
use extremes::{COUNT, any_belief, any_noise, is_refusal, pairs, vector};
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const RIGHT: f64 = 1e-6;

/// The traces that planners compare are right to six digits as well, or refused.
#[test]
fn planned_traces_are_right_to_six_digits_or_refused() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut right, mut refused) = ([0, 0], [0, 0]);
    let seen: Vec<FeatureId> = (0..COUNT).map(FeatureId).collect();
    for run in 0..2000 {
        let (belief, noise) = (any_belief(&mut rng), any_noise(&mut rng));
        let control = Control {
            rotation: vector(&mut rng, 0.1),
            translation: vector(&mut rng, 1.0),
        };
        let motion = [Vector3::zeros(); COUNT];
        let structure = rng.random_range(0..2) == 1;
        let visible = &seen[..rng.random_range(0..=COUNT)];
        let fast = || {
            let mut fast = PosteriorTrace::new(&belief, &motion, &noise, structure, &seen)?;
            let set = fast.add_set(visible)?;
            fast.after(&control, set)
        };
        let direct = || {
            let isotropic = |&f| PlannedMeasurement::isotropic(f, noise.feature_measurement_sigma);
            let planned = visible
                .iter()
                .map(isotropic)
                .collect::<Result<Vec<_>, _>>()?;
            let mut direct = DirectTrace::new(&belief, &motion, &noise, structure)?;
            direct.after(&control, &planned)
        };
        let p = exact::propagated(&exact::covariance(&belief), &belief.state, &control, &noise);
        let mut predicted = belief.state.clone();
        predicted.pose = adslam_models::predicted_pose(&belief.state.pose, &control);
        let measured: Vec<FeatureMeasurement> = visible
            .iter()
            .map(|&feature| FeatureMeasurement {
                feature,
                z: Vector3::zeros(),
            })
            .collect();
        let list = if structure { every_pair(COUNT) } else { vec![] };
        let pairs = pairs(&list, &mut rng);
        let expected = exact::trace(&exact::updated(&p, &predicted, &measured, &pairs, &noise).0);
        for (which, trace) in [fast(), direct()].into_iter().enumerate() {
            match trace {
                Ok(trace) => {
                    let error = (trace / expected - 1.0).abs();
                    assert!(
                        error <= RIGHT,
                        "run {run}, {which}: {error:e} with {noise:?}"
                    );
                    right[which] += 1;
                }
                Err(error) => {
                    assert!(is_refusal(&error), "run {run}, {which}: {error}");
                    refused[which] += 1;
                }
            }
        }
    }
    println!("{right:?} right, {refused:?} refused");
    assert!(right.iter().all(|n| *n > 800) && refused.iter().all(|n| *n > 400));
}
