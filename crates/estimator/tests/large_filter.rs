//! A filter of 200 features: against the textbook, and the same on any number of threads.

#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;
#[path = "../benches/common/mod.rs"]
mod synthetic;

use adslam_estimator::{
    Belief, Ekf, Estimator, Measurements, PairMeasurement, Parallelism, StructureMeasurements,
};
use adslam_models::{Control, FeatureId, POSE_DIM, State, feature_offset};
use common::{NOISE, assert_close, covariance_matrix};
use nalgebra::{DMatrix, DVector, Vector3, Vector6};
use synthetic::{CASES, Case, Step, belief};

const CASE: Case = CASES[2];

/// A step with a moving robot and object and innovations that are not zero.
fn lively(belief: &Belief) -> Step {
    let mut step = Step::new(belief, CASE, 1);
    step.control = Control {
        rotation: Vector3::new(0.02, -0.05, 0.1),
        translation: Vector3::new(0.3, 0.1, -0.2),
    };
    for (i, motion) in step.motion.iter_mut().enumerate() {
        *motion = Vector3::new((i as f64).sin(), (2.0 * i as f64).cos(), 0.5) * 0.05;
    }
    for measurement in &mut step.features {
        measurement.z += Vector3::new(0.3, -0.1, 0.05);
    }
    let wave = |i: usize| Vector3::new((i as f64).cos(), (i as f64).sin(), 0.2);
    let mean: Vector3<f64> = (0..CASE.features).map(wave).sum::<Vector3<f64>>() / 200.0;
    for (i, sum) in step.sums.iter_mut().enumerate() {
        *sum += (wave(i) - mean) * 7.0;
    }
    step
}

/// All pairs in the information form, P⁺ = (P⁻¹ + HᵀH/σ²)⁻¹, the sum over the pairs done one by one: the
/// 59 700 stacked rows would fill 28 GB.
fn update_with_all_pairs(
    state: &State,
    p: &DMatrix<f64>,
    sums: &[Vector3<f64>],
) -> (State, DMatrix<f64>) {
    let weight = NOISE.structure_measurement_sigma.powi(-2);
    let mut information = p.clone().try_inverse().unwrap();
    for (i, j) in common::every_pair(sums.len()) {
        let (i, j) = (feature_offset(FeatureId(i)), feature_offset(FeatureId(j)));
        for a in 0..3 {
            information[(i + a, i + a)] += weight;
            information[(j + a, j + a)] += weight;
            information[(i + a, j + a)] -= weight;
            information[(j + a, i + a)] -= weight;
        }
    }
    let updated = information.try_inverse().unwrap();
    let mut residual = DVector::zeros(p.nrows());
    for (i, sum) in sums.iter().enumerate() {
        let expected: Vector3<f64> = state.features.iter().map(|p| state.features[i] - p).sum();
        residual
            .fixed_rows_mut::<3>(feature_offset(FeatureId(i)))
            .copy_from(&((sum - expected) * weight));
    }
    let delta = &updated * residual;
    let mut moved = state.clone();
    let of_pose = Vector6::from_iterator(delta.rows(0, POSE_DIM).iter().copied());
    moved.pose = moved.pose.plus(&of_pose);
    for (j, point) in moved.features.iter_mut().enumerate() {
        *point += delta.fixed_rows::<3>(feature_offset(FeatureId(j)));
    }
    (moved, updated)
}

#[test]
fn a_step_with_200_features_is_the_printed_one() {
    let mut belief = belief(CASE).unwrap();
    let step = lively(&belief);
    let p = covariance_matrix(&belief);
    let (state, p) = common::propagate(&belief.state, &p, &step.control, &step.motion, &NOISE);
    let (state, p) = common::update(&state, &p, &step.features, &[], &NOISE);
    let (state, p) = update_with_all_pairs(&state, &p, &step.sums);
    step.run(&mut Ekf::new(NOISE).unwrap(), &mut belief)
        .unwrap();
    assert_close(&covariance_matrix(&belief), &p, 1e-9);
    assert!(belief.state.pose.minus(&state.pose).amax() < 1e-9);
    for (a, b) in belief.state.features.iter().zip(&state.features) {
        assert!((a - b).norm() < 1e-9, "feature {a} is {b} in the oracle");
    }
    assert!(belief.covariance.is_positive_definite());
}

/// A chain around the object, and every seventh feature to the next seventh: no two pairs are the same.
fn some_pairs(belief: &Belief) -> Vec<PairMeasurement> {
    let points = &belief.state.features;
    let count = points.len();
    let chain = (1..count).map(|i| (i - 1, i));
    let chords = (7..count).step_by(7).map(|i| (i - 7, i));
    chain
        .chain(chords)
        .map(|(from, to)| PairMeasurement {
            from: FeatureId(from),
            to: FeatureId(to),
            z: points[to] - points[from] + Vector3::new((to as f64).sin(), 0.2, -0.1) * 0.1,
        })
        .collect()
}

#[test]
fn threads_change_no_bit() {
    let start = belief(CASE).unwrap();
    let run = |ekf: &mut Ekf| {
        let mut belief = start.clone();
        for _ in 0..3 {
            lively(&belief).run(ekf, &mut belief).unwrap();
        }
        let pairs = some_pairs(&belief);
        let measurements = Measurements {
            features: &[],
            structure: StructureMeasurements::Pairs(&pairs),
        };
        ekf.update(&mut belief, &measurements).unwrap();
        let bits: Vec<u64> = covariance_matrix(&belief)
            .iter()
            .map(|x| x.to_bits())
            .collect();
        (belief.state, bits)
    };
    let mut sequential = Ekf::new(NOISE).unwrap();
    let expected = run(&mut sequential);
    for threads in [1, 2, 3] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let mut ekf = sequential.clone().with_parallelism(Parallelism::Rayon);
        let found = pool.install(|| run(&mut ekf));
        assert!(found == expected, "{threads} threads give another result");
    }
}

/// More pairs than one block holds, and more than one graph in the same filter.
#[test]
fn a_graph_in_blocks_is_the_printed_update() {
    let mut ekf = Ekf::new(NOISE).unwrap();
    for features in [30, 12, 45] {
        let case = Case {
            name: "graph",
            features,
            seen: 5,
        };
        let mut belief = belief(case).unwrap();
        let pairs = some_pairs(&belief);
        let p = covariance_matrix(&belief);
        let (state, p) = common::update(&belief.state, &p, &[], &pairs, &NOISE);
        let measurements = Measurements {
            features: &[],
            structure: StructureMeasurements::Pairs(&pairs),
        };
        ekf.update(&mut belief, &measurements).unwrap();
        assert_close(&covariance_matrix(&belief), &p, 1e-9);
        assert!(belief.state.pose.minus(&state.pose).amax() < 1e-9);
        for (a, b) in belief.state.features.iter().zip(&state.features) {
            assert!((a - b).norm() < 1e-9, "feature {a} is {b} in the oracle");
        }
    }
}

/// Blocks of every size: some features seen or all, in a state whose contrasts fill some blocks and
/// part of another.
#[test]
fn blocks_of_any_size_are_one_update() {
    for features in [1, 2, 16, 17, 18, 33, 34, 98, 110] {
        let case = Case {
            name: "odd",
            features,
            seen: features,
        };
        let mut belief = belief(case).unwrap();
        let step = Step::new(&belief, case, 0);
        let p = covariance_matrix(&belief);
        let (state, p) = common::update(&belief.state, &p, &step.features, &[], &NOISE);
        let (_, p) = update_with_all_pairs(&state, &p, &step.sums);
        let mut ekf = Ekf::new(NOISE).unwrap();
        step.update(&mut ekf, &mut belief, &step.features).unwrap();
        assert_close(&covariance_matrix(&belief), &p, 1e-9);
    }
}

#[test]
fn no_features_and_one_feature_have_no_structure() {
    for count in [0, 1] {
        let spread = nalgebra::Matrix6::identity();
        let pose = adslam_models::Pose::default();
        let mut belief = Belief::initial(pose, synthetic::sphere(count), &spread, 0.02).unwrap();
        let before = covariance_matrix(&belief);
        let measurements = Measurements {
            features: &[],
            structure: StructureMeasurements::AllPairsSummed(&vec![Vector3::zeros(); count]),
        };
        let mut ekf = Ekf::new(NOISE).unwrap();
        ekf.update(&mut belief, &measurements).unwrap();
        assert_eq!(covariance_matrix(&belief), before, "{count} features");
    }
}
