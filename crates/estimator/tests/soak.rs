//! Filters that run for long: the covariance stays a covariance, the errors stay within it, and memory
//! does not grow.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;
mod filters;
mod world;

use adslam_estimator::{Belief, EstimatorError, FilterNoise};
use adslam_models::State;
use allocation_counter::measure;
use common::NOISE;
use filters::filters;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use world::{StructureKind, World};

/// Steps of each run: a hundred of the paper's.
const STEPS: usize = 10_000;

const KINDS: [StructureKind; 3] = [
    StructureKind::None,
    StructureKind::SomePairs,
    StructureKind::AllPairs,
];

/// χ̂ − χ in the order of the state.
fn difference(belief: &Belief, truth: &State) -> Vec<f64> {
    let pose = belief.state.pose.minus(&truth.pose);
    let features = belief.state.features.iter().zip(&truth.features);
    let features = features.flat_map(|(a, b)| <[f64; 3]>::from(a - b));
    pose.iter().copied().chain(features).collect()
}

#[track_caller]
fn assert_is_covariance(belief: &Belief, when: &str) {
    let p = &belief.covariance;
    let asymmetric = (0..p.dim())
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .find(|&(i, j)| p.entry(i, j).to_bits() != p.entry(j, i).to_bits());
    assert_eq!(asymmetric, None, "{when}: not exactly symmetric");
    assert!(p.is_positive_definite(), "{when}: not positive definite");
}

/// Each sigma between these powers of ten on its own, as likely in each of them.
fn any_noise(rng: &mut ChaCha8Rng, exponents: std::ops::Range<f64>) -> FilterNoise {
    let mut sigma = || 10_f64.powf(rng.random_range(exponents.clone()));
    FilterNoise {
        rotation_sigma: sigma(),
        translation_sigma: sigma(),
        feature_motion_sigma: sigma(),
        feature_measurement_sigma: sigma(),
        structure_measurement_sigma: sigma(),
    }
}

/// Features that walk by 1 cm a step are after 400 steps so little known together that a sensor of 10⁻⁴ cm leaves six
/// digits no more: that may be refused, see below.
#[test]
fn the_covariance_stays_positive_definite_whatever_the_noise_and_the_measurements() {
    const FEATURES: usize = 8;
    const WORLDS: usize = 20;
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for seed in 0..WORLDS {
        let noise = any_noise(&mut rng, -3.0..0.0);
        for (name, mut filter) in filters(noise).unwrap() {
            let mut world = World::new(FEATURES, noise, seed as u64);
            let mut belief = world.first_belief().unwrap();
            for step in 0..STEPS / WORLDS {
                let seen = rng.random_range(0..=FEATURES);
                let kind = KINDS[rng.random_range(0..KINDS.len())];
                let step_said = || format!("{name}, step {step} with {noise:?}");
                let made = world.step(seen, kind).run(&mut filter, &mut belief);
                assert_eq!(made, Ok(()), "{}", step_said());
                assert_is_covariance(&belief, &step_said());
            }
        }
    }
}

/// Beyond that a filter may refuse, at any step, but never goes on with what is no covariance.
#[test]
fn sigmas_of_any_file_keep_a_covariance_or_are_refused() {
    const FEATURES: usize = 5;
    const WORLDS: usize = 60;
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let (mut whole, mut refused) = (0, 0);
    for seed in 0..WORLDS {
        let noise = any_noise(&mut rng, -9.0..1.0);
        for (name, mut filter) in filters(noise).unwrap() {
            let mut world = World::new(FEATURES, noise, seed as u64);
            let mut belief = world.first_belief().unwrap();
            let mut stopped = false;
            for step in 0..100 {
                let seen = rng.random_range(0..=FEATURES);
                let kind = KINDS[rng.random_range(0..KINDS.len())];
                if let Err(error) = world.step(seen, kind).run(&mut filter, &mut belief) {
                    let said = matches!(
                        error,
                        EstimatorError::TooPrecise { .. }
                            | EstimatorError::LostInMotion { .. }
                            | EstimatorError::PitchNearRightAngle { .. }
                    );
                    assert!(said, "{name}, step {step} with {noise:?}: {error}");
                    stopped = true;
                    break;
                }
                let step_said = format!("{name}, step {step} with {noise:?}");
                assert_is_covariance(&belief, &step_said);
            }
            (whole, refused) = if stopped {
                (whole, refused + 1)
            } else {
                (whole + 1, refused)
            };
        }
    }
    assert!(
        whole > 30 && refused > 10,
        "{whole} whole, {refused} refused"
    );
}

#[test]
fn ten_thousand_steps_leave_a_sound_belief_and_take_no_memory() {
    const FEATURES: usize = 50;
    const SEEN: usize = 10;
    for (name, mut filter) in filters(NOISE).unwrap() {
        let mut world = World::new(FEATURES, NOISE, 1);
        let mut belief = world.first_belief().unwrap();
        let (mut nees, mut worst_angle, mut worst_relative) = (0.0, 0.0_f64, 0.0_f64);
        for n in 0..STEPS {
            let step = world.step(SEEN, StructureKind::AllPairs);
            let memory = measure(|| step.run(&mut filter, &mut belief).unwrap());
            let is_first = n == 0;
            assert_eq!(
                memory.count_total > 0,
                is_first,
                "{name}, step {n}: {memory:?}"
            );
            let error = difference(&belief, &world.truth);
            worst_angle = error[..3].iter().fold(worst_angle, |w, e| w.max(e.abs()));
            // The common walk of all features is unobservable: what is compared is relative to it.
            for axis in 0..3 {
                let features = error[6 + axis..].iter().step_by(3);
                let drift = features.sum::<f64>() / FEATURES as f64;
                worst_relative = worst_relative.max((error[3 + axis] - drift).abs());
            }
            if n % 20 == 0 {
                let error = filter.error(&belief.state, &world.truth);
                nees += belief.covariance.mahalanobis_squared(&error).unwrap();
            }
        }
        let nees = nees / (STEPS / 20) as f64 / belief.covariance.dim() as f64;
        assert_is_covariance(&belief, name);
        assert!(
            (0.95..1.05).contains(&nees),
            "{name}: NEES {nees} per entry"
        );
        assert!(worst_angle < 0.03, "{name}: {worst_angle} rad");
        assert!(worst_relative < 0.15, "{name}: {worst_relative} cm");
    }
}
