//! What every update must keep to, whatever is measured.

mod common;
mod filters;

use adslam_estimator::{
    Belief, Covariance, EstimatorError, FeatureMeasurement, FilterNoise, Measurements,
    PairMeasurement, StructureMeasurements,
};
use adslam_models::{FeatureId, POSE_DIM, Pose, State, feature_measurement, feature_offset};
use common::{NOISE, assert_close, covariance_matrix};
use filters::{Filter, filters};
use nalgebra::{Matrix6, Point3, Vector3, Vector6};
use proptest::prelude::*;

/// More than the filter takes in one block of measurements.
const COUNT: usize = 20;

fn measured(visible: &[FeatureId], z: &[Vector3<f64>]) -> Vec<FeatureMeasurement> {
    let measure = |&feature: &FeatureId| FeatureMeasurement {
        feature,
        z: z[feature.0],
    };
    visible.iter().map(measure).collect()
}

/// The belief after measuring.
fn updated(
    filter: &mut Filter,
    belief: &Belief,
    features: &[FeatureMeasurement],
    structure: StructureMeasurements<'_>,
) -> Result<Belief, EstimatorError> {
    let mut belief = belief.clone();
    let measurements = Measurements {
        features,
        structure,
    };
    filter.update(&mut belief, &measurements)?;
    Ok(belief)
}

/// Fails unless the beliefs are the same but for rounding.
fn assert_same(a: &Belief, b: &Belief) {
    assert_close(&covariance_matrix(a), &covariance_matrix(b), 1e-9);
    assert!(a.state.pose.minus(&b.state.pose).amax() < 1e-8);
    for (a, b) in a.state.features.iter().zip(&b.state.features) {
        assert!((a - b).norm() < 1e-8, "{a} and {b}");
    }
}

/// The belief with feature `numbers[i]` as number i.
fn renumbered(belief: &Belief, numbers: &[usize]) -> Belief {
    let entry = |i: usize| match i.checked_sub(POSE_DIM) {
        None => i,
        Some(k) => feature_offset(FeatureId(numbers[k / 3])) + k % 3,
    };
    let State { pose, features } = &belief.state;
    Belief {
        state: State {
            pose: *pose,
            features: numbers.iter().map(|&i| features[i]).collect(),
        },
        covariance: Covariance::from_lower(belief.covariance.dim(), |i, j| {
            belief.covariance.entry(entry(i), entry(j))
        }),
    }
}

/// A measured pair of different features, any number of times.
fn pairs() -> impl Strategy<Value = Vec<PairMeasurement>> {
    let pair = (0..COUNT, 1..COUNT, prop::array::uniform3(-3.0..3.0));
    let pair = pair.prop_map(|(from, step, z)| PairMeasurement {
        from: FeatureId(from),
        to: FeatureId((from + step) % COUNT),
        z: Vector3::from(z),
    });
    prop::collection::vec(pair, 1..2 * COUNT)
}

/// The numbers of all features in any order.
fn any_order() -> impl Strategy<Value = Vec<usize>> {
    Just((0..COUNT).collect::<Vec<_>>()).prop_shuffle()
}

/// A sigma that a scenario may state, as likely in each power of ten.
fn sigma() -> impl Strategy<Value = f64> {
    (-9.0..6.0).prop_map(|exponent: f64| 10_f64.powf(exponent))
}

fn noise() -> impl Strategy<Value = FilterNoise> {
    (prop::array::uniform4(sigma()), -9.0..0.5).prop_map(|(sigmas, angle): (_, f64)| FilterNoise {
        rotation_sigma: 10_f64.powf(angle),
        translation_sigma: sigmas[0],
        feature_motion_sigma: sigmas[1],
        feature_measurement_sigma: sigmas[2],
        structure_measurement_sigma: sigmas[3],
    })
}

/// Whether it says that numbers of 16 digits do not hold the result.
fn is_refusal(error: &EstimatorError) -> bool {
    matches!(
        error,
        EstimatorError::TooPrecise { .. } | EstimatorError::LostInMotion { .. }
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Sigmas fifteen powers of ten apart: what is not refused is a covariance, and a measurement has not
    /// made it larger.
    #[test]
    fn any_sigmas_leave_a_covariance_or_are_refused(
        noise in noise(),
        pose in prop::array::uniform6(-1.2..1.2),
        pose_sigma in prop::array::uniform2(sigma()),
        feature_sigma in sigma(),
        points in common::vectors(COUNT, 5.0),
        control in common::control(),
        visible in common::some_features(COUNT),
        mut pairs in pairs(),
        all_pairs in any::<bool>(),
    ) {
        let sigmas = Vector6::from_fn(|k, _| pose_sigma[k / 3].min(if k < 3 { 3.0 } else { 1e6 }));
        let start = Belief::initial(
            Pose::from_vector(&Vector6::from(pose)),
            points.iter().copied().map(Point3::from).collect(),
            &Matrix6::from_diagonal(&sigmas.map(|sigma| sigma * sigma)),
            feature_sigma,
        )?;
        for (name, mut filter) in filters(noise)? {
            let mut belief = start.clone();
            for _ in 0..3 {
                let moved = filter.predict(&mut belief, &control, &[Vector3::zeros(); COUNT]);
                let State { pose, features } = &belief.state;
                let z: Vec<_> = features.iter().map(|p| feature_measurement(pose, p)).collect();
                for pair in &mut pairs {
                    pair.z = features[pair.to.0] - features[pair.from.0];
                }
                let sums: Vec<Vector3<f64>> =
                    features.iter().map(|p| features.iter().map(|q| p - q).sum()).collect();
                let structure = if all_pairs {
                    StructureMeasurements::AllPairsSummed(&sums)
                } else {
                    StructureMeasurements::Pairs(&pairs)
                };
                let before = belief.covariance.trace();
                let seen = measured(&visible, &z);
                match moved.and_then(|()| updated(&mut filter, &belief, &seen, structure)) {
                    Ok(after) => belief = after,
                    Err(error) => {
                        prop_assert!(is_refusal(&error), "{name}: {error}");
                        break;
                    }
                }
                let after = belief.covariance.trace();
                prop_assert!(belief.covariance.is_positive_definite(), "{name}: {noise:?}");
                prop_assert!(after <= before * (1.0 + 1e-6), "{name}: {after} after {before}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 32, failure_persistence: None, ..ProptestConfig::default()
    })]

    #[test]
    fn the_order_of_measurements_does_not_matter(
        belief in common::belief(COUNT),
        order in any_order(),
        kept in 1..=COUNT,
        z in common::vectors(COUNT, 3.0),
        (pairs, shuffled) in pairs().prop_flat_map(|p| (Just(p.clone()), Just(p).prop_shuffle())),
    ) {
        let order: Vec<FeatureId> = order[..kept].iter().copied().map(FeatureId).collect();
        let mut sorted = order.clone();
        sorted.sort();
        let (order, sorted) = (measured(&order, &z), measured(&sorted, &z));
        for (_, mut filter) in filters(NOISE)? {
            let a = updated(&mut filter, &belief, &order, StructureMeasurements::Pairs(&shuffled))?;
            let b = updated(&mut filter, &belief, &sorted, StructureMeasurements::Pairs(&pairs))?;
            assert_same(&a, &b);
        }
    }

    #[test]
    fn a_pair_says_the_same_from_either_end(belief in common::belief(COUNT), pairs in pairs()) {
        let turned = |pair: &PairMeasurement| PairMeasurement {
            from: pair.to,
            to: pair.from,
            z: -pair.z,
        };
        let turned: Vec<PairMeasurement> = pairs.iter().map(turned).collect();
        for (_, mut filter) in filters(NOISE)? {
            let a = updated(&mut filter, &belief, &[], StructureMeasurements::Pairs(&pairs))?;
            let b = updated(&mut filter, &belief, &[], StructureMeasurements::Pairs(&turned))?;
            assert_same(&a, &b);
        }
    }

    #[test]
    fn the_numbering_of_features_does_not_matter(
        belief in common::belief(COUNT),
        numbers in any_order(),
        control in common::control(),
        motion in common::vectors(COUNT, 0.5),
        visible in common::some_features(COUNT),
        z in common::vectors(COUNT, 3.0),
        pairs in prop::option::of(pairs()),
        noise in common::vectors(COUNT, 9.0),
    ) {
        let new = |old: FeatureId| {
            FeatureId(numbers.iter().position(|i| *i == old.0).unwrap_or(usize::MAX))
        };
        let reordered = |list: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            numbers.iter().map(|&i| list[i]).collect()
        };
        let seen = measured(&visible, &z);
        let seen_anew: Vec<FeatureMeasurement> =
            seen.iter().map(|m| FeatureMeasurement { feature: new(m.feature), z: m.z }).collect();
        // Without pairs, the sums over all of them, which add up to zero.
        let mean = noise.iter().sum::<Vector3<f64>>() / COUNT as f64;
        let sums: Vec<Vector3<f64>> = noise.iter().map(|v| v - mean).collect();
        let sums_anew = reordered(&sums);
        let pairs_anew: Option<Vec<PairMeasurement>> = pairs.as_ref().map(|pairs| {
            let anew = |p: &PairMeasurement| {
                PairMeasurement { from: new(p.from), to: new(p.to), z: p.z }
            };
            pairs.iter().map(anew).collect()
        });
        for (_, mut filter) in filters(NOISE)? {
            let mut step = |mut belief: Belief, motion: &[_], seen: &[_], pairs: &Option<Vec<_>>, sums| {
                filter.predict(&mut belief, &control, motion)?;
                let structure = match pairs {
                    Some(pairs) => StructureMeasurements::Pairs(pairs),
                    None => StructureMeasurements::AllPairsSummed(sums),
                };
                updated(&mut filter, &belief, seen, structure)
            };
            let a = step(belief.clone(), &motion, &seen, &pairs, &sums)?;
            let anew = renumbered(&belief, &numbers);
            let b = step(anew, &reordered(&motion), &seen_anew, &pairs_anew, &sums_anew)?;
            assert_same(&renumbered(&a, &numbers), &b);
        }
    }

    /// Measurements say what is expected, so that the estimate stays: where it moves, the covariance of an
    /// error in other coordinates moves with it, and its trace in the paper's may rise.
    #[test]
    fn a_measurement_more_never_raises_the_trace(
        belief in common::belief(COUNT),
        visible in common::some_features(COUNT),
        mut pairs in pairs(),
    ) {
        let State { pose, features } = &belief.state;
        let z: Vec<Vector3<f64>> = features.iter().map(|p| feature_measurement(pose, p)).collect();
        for pair in &mut pairs {
            pair.z = features[pair.to.0] - features[pair.from.0];
        }
        let sums: Vec<Vector3<f64>> =
            features.iter().map(|p| features.iter().map(|q| p - q).sum()).collect();
        for (name, mut filter) in filters(NOISE)? {
            let mut trace = |visible: &[FeatureId], structure| {
                let after = updated(&mut filter, &belief, &measured(visible, &z), structure)?;
                Ok::<_, EstimatorError>(after.covariance.trace())
            };
            let none = StructureMeasurements::None;
            let mut before = belief.covariance.trace();
            for seen in 1..=visible.len() {
                let after = trace(&visible[..seen], none)?;
                prop_assert!(after <= before, "{name}: {after} after {before}");
                before = after;
            }
            let mut with_pairs = before;
            for measured in 1..=pairs.len() {
                let after = trace(&visible, StructureMeasurements::Pairs(&pairs[..measured]))?;
                // The graph is factored anew for each number of pairs, so that rounding differs.
                prop_assert!(after <= with_pairs * (1.0 + 1e-12), "{name}: {after} after {with_pairs}");
                with_pairs = after;
            }
            let with_all = trace(&visible, StructureMeasurements::AllPairsSummed(&sums))?;
            prop_assert!(with_all <= before, "{name}: {with_all} after {before}");
        }
    }
}
