//! The planner's objective against the trace of Algorithm 1 as printed.

mod common;
#[path = "../benches/common/mod.rs"]
mod synthetic;

use adslam_estimator::{
    Belief, DirectTrace, EstimatorError, FeatureMeasurement, FilterNoise, PairMeasurement,
    PlannedMeasurement, PosteriorTrace,
};
use adslam_models::{Control, FeatureId, Pose};
use common::{NOISE, covariance_matrix};
use nalgebra::{DMatrix, Matrix3, Matrix6, Point3, Vector3};
use proptest::prelude::*;

const COUNT: usize = 7;

/// Pairs for the oracle; their z is of no interest to the covariance.
fn pairs(with_structure: bool) -> Vec<PairMeasurement> {
    common::every_pair(COUNT)
        .into_iter()
        .filter(|_| with_structure)
        .map(|(i, j)| PairMeasurement {
            from: FeatureId(i),
            to: FeatureId(j),
            z: Vector3::zeros(),
        })
        .collect()
}

/// The printed trace, every row stacked.
fn textbook(
    belief: &Belief,
    noise: &FilterNoise,
    motion: &[Vector3<f64>],
    with_structure: bool,
    control: &Control,
    measurements: &[PlannedMeasurement],
) -> f64 {
    let p = covariance_matrix(belief);
    let (state, p) = common::propagate(&belief.state, &p, control, motion, noise);
    let features: Vec<FeatureMeasurement> = measurements
        .iter()
        .map(|m| FeatureMeasurement {
            feature: m.feature,
            z: Vector3::zeros(),
        })
        .collect();
    let pairs = pairs(with_structure);
    if features.is_empty() && pairs.is_empty() {
        return p.trace();
    }
    let (h, o, _) = common::stacked(&state, &features, &pairs, noise);
    let mut o = DMatrix::from_diagonal(&o);
    for (i, m) in measurements.iter().enumerate() {
        o.fixed_view_mut::<3, 3>(3 * i, 3 * i)
            .copy_from(&m.covariance);
    }
    let s = &h * &p * h.transpose() + o;
    let gain = &p * h.transpose() * s.try_inverse().expect("S is invertible");
    let n = p.nrows();
    ((DMatrix::identity(n, n) - gain * h) * p).trace()
}

fn isotropic(visible: &[FeatureId]) -> Vec<PlannedMeasurement> {
    visible
        .iter()
        .map(|&f| {
            PlannedMeasurement::isotropic(f, NOISE.feature_measurement_sigma).expect("a sigma")
        })
        .collect()
}

proptest! {
    #[test]
    fn fast_and_direct_are_the_trace_of_algorithm_1(
        belief in common::belief(COUNT),
        actions in prop::collection::vec((common::control(), common::some_features(COUNT)), 4),
        motion in common::vectors(COUNT, 0.3),
        with_structure in any::<bool>()
    ) {
        let seen: Vec<FeatureId> = (0..COUNT).rev().map(FeatureId).collect();
        let mut fast = PosteriorTrace::new(&belief, &motion, &NOISE, with_structure, &seen)?;
        let mut direct = DirectTrace::new(&belief, &motion, &NOISE, with_structure)?;
        for (control, visible) in &actions {
            let measurements = isotropic(visible);
            let expected =
                textbook(&belief, &NOISE, &motion, with_structure, control, &measurements);
            let set = fast.add_set(visible)?;
            let traces = [fast.after(control, set)?, direct.after(control, &measurements)?];
            for trace in traces {
                prop_assert!((trace / expected - 1.0).abs() < 1e-9, "{trace} is not {expected}");
            }
        }
    }

    #[test]
    fn direct_takes_any_noise(
        belief in common::belief(COUNT),
        control in common::control(),
        visible in common::some_features(COUNT),
        roots in prop::collection::vec(prop::array::uniform9(-0.1..0.1), COUNT),
        motion in common::vectors(COUNT, 0.3),
    ) {
        let measurements: Vec<PlannedMeasurement> = visible
            .iter()
            .zip(&roots)
            .map(|(&feature, root)| {
                let root = Matrix3::from_column_slice(root);
                let covariance = root * root.transpose() + Matrix3::identity() * 1e-4;
                PlannedMeasurement { feature, covariance }
            })
            .collect();
        let mut direct = DirectTrace::new(&belief, &motion, &NOISE, true)?;
        let trace = direct.after(&control, &measurements)?;
        let expected = textbook(&belief, &NOISE, &motion, true, &control, &measurements);
        prop_assert!((trace / expected - 1.0).abs() < 1e-9, "{trace} is not {expected}");
    }

    /// A pose that is known exactly, wholly or in part, as at the start.
    #[test]
    fn a_singular_pose_covariance_is_no_exception(
        known in prop::collection::vec(any::<bool>(), 6),
        control in common::control(),
        visible in common::some_features(COUNT),
        points in common::vectors(COUNT, 5.0),
    ) {
        let covariance = Matrix6::from_fn(|i, j| {
            if i == j && !known[i] { 0.01 } else { 0.0 }
        });
        let features = points.iter().copied().map(Point3::from).collect();
        let belief = Belief::initial(Pose::default(), features, &covariance, 0.02)?;
        let motion = [Vector3::zeros(); COUNT];
        let mut fast = PosteriorTrace::new(&belief, &motion, &NOISE, true, &visible)?;
        let set = fast.add_set(&visible)?;
        let trace = fast.after(&control, set)?;
        let expected =
            textbook(&belief, &NOISE, &motion, true, &control, &isotropic(&visible));
        prop_assert!((trace / expected - 1.0).abs() < 1e-9, "{trace} is not {expected}");
    }
}

#[test]
fn what_was_not_announced_cannot_be_seen() {
    let features = vec![Point3::new(1.0, 0.0, 0.0), Point3::new(2.0, 1.0, 0.0)];
    let belief = Belief::initial(Pose::default(), features, &Matrix6::identity(), 0.1).unwrap();
    let motion = [Vector3::zeros(); 2];
    let announced = [FeatureId(1)];
    let mut fast = PosteriorTrace::new(&belief, &motion, &NOISE, true, &announced).unwrap();
    let error = fast.add_set(&[FeatureId(0)]).unwrap_err();
    assert_eq!(error, EstimatorError::NotPlanned(FeatureId(0)));
    let error = fast.add_set(&[FeatureId(7)]).unwrap_err();
    assert!(matches!(error, EstimatorError::UnknownFeature { .. }));
    let unknown = [FeatureId(2)];
    assert!(PosteriorTrace::new(&belief, &motion, &NOISE, true, &unknown).is_err());
}

/// Sets of more features than one block holds, in a state whose covariance is cut into tiles.
#[test]
fn fast_is_direct_for_many_features() {
    let case = synthetic::CASES[2];
    let belief = synthetic::belief(case).unwrap();
    let motion = vec![Vector3::new(0.1, -0.2, 0.05); case.features];
    let seen: Vec<FeatureId> = (0..case.features).step_by(2).map(FeatureId).collect();
    let control = Control {
        rotation: Vector3::new(0.1, -0.2, 0.3),
        translation: Vector3::new(0.3, 0.2, -0.1),
    };
    let mut fast = PosteriorTrace::new(&belief, &motion, &NOISE, true, &seen).unwrap();
    let mut direct = DirectTrace::new(&belief, &motion, &NOISE, true).unwrap();
    for visible in [&seen[..], &seen[40..57], &[]] {
        let set = fast.add_set(visible).unwrap();
        let trace = fast.after(&control, set).unwrap();
        let expected = direct.after(&control, &isotropic(visible)).unwrap();
        assert!(
            (trace / expected - 1.0).abs() < 1e-9,
            "{trace} is not {expected}"
        );
    }
}

#[test]
fn a_decision_that_is_not_prepared_answers_nothing() {
    let features = vec![Point3::new(1.0, 0.0, 0.0), Point3::new(2.0, 1.0, 0.0)];
    let belief = Belief::initial(Pose::default(), features, &Matrix6::identity(), 0.1).unwrap();
    let motion = [Vector3::zeros(); 2];
    let (control, seen) = (Control::default(), [FeatureId(0), FeatureId(1)]);
    let mut fast = PosteriorTrace::default();
    assert_eq!(fast.add_set(&[]), Err(EstimatorError::NotPrepared));
    fast.prepare(&belief, &motion, &NOISE, true, &seen).unwrap();
    let first = fast.add_set(&seen).unwrap();
    fast.after(&control, first).unwrap();

    fast.prepare(&belief, &motion, &NOISE, true, &seen).unwrap();
    fast.add_set(&[]).unwrap();
    let forgotten = fast.after(&control, first);
    assert_eq!(forgotten, Err(EstimatorError::SetOfAnotherDecision));

    let unknown = [FeatureId(2)];
    assert!(
        fast.prepare(&belief, &motion, &NOISE, true, &unknown)
            .is_err()
    );
    let after_failure = fast.after(&control, first);
    assert_eq!(after_failure, Err(EstimatorError::NotPrepared));

    let mut direct = DirectTrace::default();
    let unprepared = direct.after(&control, &[]);
    assert_eq!(unprepared, Err(EstimatorError::NotPrepared));
    direct.prepare(&belief, &motion, &NOISE, true).unwrap();
    direct.after(&control, &isotropic(&seen)).unwrap();
    assert!(direct.prepare(&belief, &motion[1..], &NOISE, true).is_err());
    let after_failure = direct.after(&control, &[]);
    assert_eq!(after_failure, Err(EstimatorError::NotPrepared));
}

proptest! {
    /// What an earlier decision left behind, of whatever size, changes nothing.
    #[test]
    fn a_decision_is_the_same_in_memory_that_was_used(
        beliefs in (common::belief(COUNT), common::belief(3), common::belief(COUNT)),
        visible in common::some_features(COUNT),
        control in common::control(),
        motion in common::vectors(COUNT, 0.3)
    ) {
        let measurements = isotropic(&visible);
        let (mut used, mut used_direct) = (PosteriorTrace::default(), DirectTrace::default());
        for belief in [beliefs.0, beliefs.1, beliefs.2] {
            let count = belief.state.features.len();
            let motion = &motion[..count];
            let seen: Vec<FeatureId> = visible.iter().copied().filter(|f| f.0 < count).collect();
            let measurements: Vec<PlannedMeasurement> =
                measurements.iter().copied().filter(|m| m.feature.0 < count).collect();
            used.prepare(&belief, motion, &NOISE, true, &seen)?;
            let mut fresh = PosteriorTrace::new(&belief, motion, &NOISE, true, &seen)?;
            let (a, b) = (used.add_set(&seen)?, fresh.add_set(&seen)?);
            prop_assert_eq!(used.after(&control, a)?, fresh.after(&control, b)?);
            used_direct.prepare(&belief, motion, &NOISE, true)?;
            let mut fresh = DirectTrace::new(&belief, motion, &NOISE, true)?;
            let expected = fresh.after(&control, &measurements)?;
            prop_assert_eq!(used_direct.after(&control, &measurements)?, expected);
        }
    }
}
