//! What steps and decisions allocate: nothing after the first. And the memory that they need at most.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

#[path = "../benches/common/mod.rs"]
mod synthetic;

use adslam_estimator::{
    Belief, DirectTrace, Ekf, Estimator, Measurements, PairMeasurement, PlannedMeasurement,
    PosteriorTrace, StructureMeasurements,
};
use adslam_models::{Control, FeatureId};
use allocation_counter::{AllocationInfo, measure};
use nalgebra::Vector3;
use synthetic::{CASES, Case, NOISE, Step, belief};

fn cases() -> impl Iterator<Item = Case> {
    CASES.into_iter().filter(|case| case.features <= 200)
}

/// Counts what one step allocates.
fn count(step: &Step, ekf: &mut Ekf, belief: &mut Belief) -> AllocationInfo {
    measure(|| {
        step.run(ekf, belief).unwrap();
    })
}

#[test]
fn steps_after_the_first_allocate_nothing() {
    for case in cases() {
        let mut belief = belief(case).unwrap();
        let mut ekf = Ekf::new(NOISE).unwrap();
        let first = count(&Step::new(&belief, case, 0), &mut ekf, &mut belief);
        assert!(first.count_total > 0, "the counter does not count");
        for turn in 1..4 {
            let step = Step::new(&belief, case, turn);
            let later = count(&step, &mut ekf, &mut belief);
            assert_eq!(later.count_total, 0, "{}: {later:?}", case.name);
        }
    }
}

#[test]
fn any_number_of_seen_features_fits_the_first_steps_memory() {
    let case = CASES[1];
    let mut belief = belief(case).unwrap();
    let mut ekf = Ekf::new(NOISE).unwrap();
    Step::new(&belief, case, 0)
        .run(&mut ekf, &mut belief)
        .unwrap();
    for seen in [1, 30, 50, 0] {
        let step = Step::new(&belief, Case { seen, ..case }, 0);
        assert_eq!(count(&step, &mut ekf, &mut belief).count_total, 0);
    }
}

#[test]
fn pairs_that_change_every_step_allocate_nothing_after_the_first() {
    let case = CASES[1];
    let mut belief = belief(case).unwrap();
    let mut ekf = Ekf::new(NOISE).unwrap();
    let pairs: Vec<PairMeasurement> = (1..case.features)
        .map(|i| PairMeasurement {
            from: FeatureId(i - 1),
            to: FeatureId(i),
            z: belief.state.features[i] - belief.state.features[i - 1],
        })
        .collect();
    let mut update = |pairs: &[PairMeasurement]| {
        let measurements = Measurements {
            features: &[],
            structure: StructureMeasurements::Pairs(pairs),
        };
        measure(|| {
            ekf.update(&mut belief, &measurements).unwrap();
        })
        .count_total
    };
    assert!(update(&pairs) > 0, "the counter does not count");
    for kept in [0..49, 1..49, 7..8, 3..30, 0..49] {
        assert_eq!(update(&pairs[kept]), 0);
    }
}

/// Features, first some and then others: as many in as many sets, all of them seen.
fn visible_sets(case: Case, turn: usize) -> Vec<Vec<FeatureId>> {
    (0..case.features / case.seen)
        .map(|set| {
            (0..case.seen)
                .map(|k| FeatureId((set * case.seen + k + turn) % case.features))
                .collect()
        })
        .collect()
}

#[test]
fn decisions_after_the_first_allocate_nothing() {
    for case in cases() {
        let belief = belief(case).unwrap();
        let motion = vec![Vector3::zeros(); case.features];
        let seen: Vec<FeatureId> = (0..case.features).map(FeatureId).collect();
        let control = Control {
            translation: Vector3::new(0.1, 0.0, 0.2),
            ..Control::default()
        };
        let mut objective = PosteriorTrace::default();
        let mut decide = |sets: &[Vec<FeatureId>]| {
            measure(|| {
                objective
                    .prepare(&belief, &motion, &NOISE, true, &seen)
                    .unwrap();
                for set in sets {
                    let set = objective.add_set(set).unwrap();
                    objective.after(&control, set).unwrap();
                }
            })
        };
        assert!(decide(&visible_sets(case, 0)).count_total > 0);
        for turn in 1..3 {
            let later = decide(&visible_sets(case, turn));
            assert_eq!(later.count_total, 0, "{}: {later:?}", case.name);
        }
    }
}

#[test]
fn dense_decisions_after_the_first_allocate_nothing() {
    let planned = |set: &Vec<FeatureId>| -> Vec<PlannedMeasurement> {
        let measured =
            |&f| PlannedMeasurement::isotropic(f, NOISE.feature_measurement_sigma).unwrap();
        set.iter().map(measured).collect()
    };
    for case in cases() {
        let belief = belief(case).unwrap();
        let motion = vec![Vector3::zeros(); case.features];
        let mut objective = DirectTrace::default();
        let mut decide = |sets: &[Vec<PlannedMeasurement>]| {
            measure(|| {
                objective.prepare(&belief, &motion, &NOISE, true).unwrap();
                for set in sets {
                    objective.after(&Control::default(), set).unwrap();
                }
            })
        };
        let sets = |turn| {
            visible_sets(case, turn)
                .iter()
                .map(planned)
                .collect::<Vec<_>>()
        };
        assert!(decide(&sets(0)).count_total > 0);
        for turn in 1..3 {
            let later = decide(&sets(turn));
            assert_eq!(later.count_total, 0, "{}: {later:?}", case.name);
        }
    }
}

/// The belief holds one. What comes on top grows with n, but for faer's packing buffers of some MB.
#[test]
fn a_belief_and_its_filter_need_less_than_two_covariances() {
    let case = Case {
        name: "heart300",
        features: 300,
        seen: 16,
    };
    let peak = measure(|| {
        let mut belief = belief(case).unwrap();
        let mut ekf = Ekf::new(NOISE).unwrap();
        let step = Step::new(&belief, case, 0);
        step.run(&mut ekf, &mut belief).unwrap();
    })
    .bytes_max as f64;
    let covariance = 8.0 * (case.dim() as f64).powi(2);
    assert!(
        peak < 2.0 * covariance,
        "{:.2} covariances",
        peak / covariance
    );
}
