//! Whatever sigmas a file states, up to fifteen powers of ten apart, an update is right to six digits in
//! every direction or refused: held against numbers of 120 digits.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;
mod exact;
mod extremes;

use adslam_estimator::{
    Belief, Ekf, Estimator, EstimatorError, FeatureMeasurement, FilterNoise, Measurements,
    StructureMeasurements,
};
use adslam_models::{Control, FeatureId, Pose, feature_measurement};
use common::{NOISE, every_pair};
use extremes::{COUNT, any_belief, any_noise, is_refusal, pairs, vector};
use nalgebra::{DVector, Matrix6, Point3, Vector3, Vector6};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const RIGHT: f64 = 1e-6;

/// Steps with any sigmas, until one is refused: (right steps, refused runs, the largest error).
#[test]
fn any_sigmas_leave_six_right_digits_or_are_refused() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let (mut right, mut refused, mut largest) = (0, 0, 0.0_f64);
    for run in 0..300 {
        let noise = any_noise(&mut rng);
        let mut filter = Ekf::new(noise).unwrap();
        let mut belief = any_belief(&mut rng);
        let mut expected = exact::covariance(&belief);
        for step in 0..4 {
            let control = Control {
                rotation: vector(&mut rng, 0.1),
                translation: vector(&mut rng, 1.0),
            };
            let motion = [Vector3::x() * 0.1; COUNT];
            let before = belief.clone();
            if let Err(error) = filter.predict(&mut belief, &control, &motion) {
                assert!(is_refusal(&error), "{error}");
                refused += 1;
                break;
            }
            expected = exact::propagated(&expected, &before.state, &control, &noise);
            let predicted = belief.state.clone();
            let seen: Vec<FeatureMeasurement> = (0..rng.random_range(0..=COUNT))
                .map(|i| FeatureMeasurement {
                    feature: FeatureId(i),
                    // As expected: the state stays where the Jacobians of both sides are taken.
                    z: feature_measurement(&predicted.pose, &predicted.features[i]),
                })
                .collect();
            let list = [
                vec![],
                vec![(0, 1)],
                vec![(0, 2), (1, 2)],
                every_pair(COUNT),
            ];
            let pairs = pairs(&list[rng.random_range(0..4)], &mut rng);
            let structure = StructureMeasurements::Pairs(&pairs);
            let features = &seen;
            let measurements = Measurements {
                features,
                structure,
            };
            if let Err(error) = filter.update(&mut belief, &measurements) {
                assert!(is_refusal(&error), "{error}");
                refused += 1;
                break;
            }
            expected = exact::updated(&expected, &predicted, &seen, &pairs, &noise).0;
            let error = exact::relative_error(&belief, &expected);
            assert!(
                error <= RIGHT,
                "run {run}, step {step}: {error:e} with {noise:?}, {pairs:?}, {} seen",
                seen.len()
            );
            assert!(belief.covariance.is_positive_definite());
            largest = largest.max(error);
            right += 1;
        }
    }
    println!("{right} right to {largest:e}, {refused} refused");
    assert!(
        right > 300 && refused > 100,
        "{right} right, {refused} refused"
    );
}

/// Features known to `prior` and a pose known to 1 mm and 0.01 rad, after one update.
fn updated(
    prior: f64,
    noise: FilterNoise,
    seen: usize,
    list: &[(usize, usize)],
) -> Result<(f64, f64), EstimatorError> {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let covariance = Matrix6::from_diagonal(&Vector6::new(1e-4, 1e-4, 1e-4, 1e-2, 1e-2, 1e-2));
    let features: Vec<Point3<f64>> = (0..COUNT).map(|_| vector(&mut rng, 5.0).into()).collect();
    let start = Belief::initial(Pose::default(), features, &covariance, prior)?;
    let measured: Vec<FeatureMeasurement> = (0..seen)
        .map(|i| FeatureMeasurement {
            feature: FeatureId(i),
            z: start.state.features[i].coords + vector(&mut rng, 0.1),
        })
        .collect();
    let pairs = pairs(list, &mut rng);
    let mut belief = start.clone();
    let report = Ekf::new(noise)?.update(
        &mut belief,
        &Measurements {
            features: &measured,
            structure: StructureMeasurements::Pairs(&pairs),
        },
    )?;
    let (expected, delta) = exact::updated(
        &exact::covariance(&start),
        &start.state,
        &measured,
        &pairs,
        &noise,
    );
    // The estimate's error in sigmas, over that which was corrected.
    let difference = belief.state.pose.minus(&start.state.pose);
    let moved = belief.state.features.iter().zip(&start.state.features);
    let moved = moved.flat_map(|(a, b)| <[f64; 3]>::from(a - b));
    let delta = DVector::from_iterator(delta.len(), delta.iter().map(exact::Float::to_f64));
    let found: Vec<f64> = difference.iter().copied().chain(moved).collect();
    let error = (DVector::from_vec(found) - &delta).amax() / delta.amax();
    assert!(error < RIGHT, "the estimate is off by {error:e}");
    assert!(report.features.value.is_finite() && report.structure.value.is_finite());
    Ok((
        exact::relative_error(&belief, &expected),
        report.features.value,
    ))
}

/// Unknown features become known by what is seen of them: in stages, where one update would leave a variance of
/// exactly 0.
#[test]
fn features_that_are_unknown_at_first_are_learned_with_all_digits() {
    for prior in [1.0, 1e2, 1e4, 1e6, 1e7, 1e10] {
        let (error, nis) = updated(prior, NOISE, COUNT, &[]).unwrap();
        assert!(error <= RIGHT, "prior {prior:e}: {error:e}");
        // yᵀS⁻¹y, of innovations far smaller than the prior.
        assert!(nis * prior * prior < 1.0, "prior {prior:e}: NIS {nis}");
    }
    // Seen with structure, too: each feature is known before the pairs are.
    let (error, _) = updated(1e7, NOISE, COUNT, &every_pair(COUNT)).unwrap();
    assert!(error <= RIGHT, "{error:e}");
}

/// All features stay unknown together while their differences are known: no double-precision covariance holds
/// that.
#[test]
fn differences_of_unknown_positions_are_refused_beyond_what_numbers_hold() {
    for list in [every_pair(COUNT), vec![(0, 1)], vec![(0, 1), (1, 2)]] {
        let with = |prior: f64, sigma: f64| {
            let noise = FilterNoise {
                structure_measurement_sigma: sigma,
                ..NOISE
            };
            updated(prior, noise, 0, &list)
        };
        for (prior, sigma) in [(1e4, 1e-3), (1e5, 1e-3), (1e7, 1e-2), (1e6, 1e-9)] {
            let error = with(prior, sigma).unwrap_err();
            assert!(
                matches!(error, EstimatorError::TooPrecise { .. }),
                "{error}"
            );
            let said = error.to_string();
            assert!(
                said.contains("Make the sigma of the structure measurements larger"),
                "{said}"
            );
        }
        for (prior, sigma) in [(1.0, 1e-3), (1e4, 1.0), (1e-3, 1e-6), (1e4, 1e6)] {
            let (error, _) = with(prior, sigma).unwrap();
            assert!(error <= RIGHT, "{prior:e}, {sigma:e}: {error:e}");
        }
    }
}
