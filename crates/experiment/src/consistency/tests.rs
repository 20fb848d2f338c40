use adslam_names::{EstimatorName, PlannerName};
use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;
use rand_distr::{ChiSquared, Distribution};

use super::*;

const STEPS: usize = 30;

/// Runs whose squared errors are those of a filter that takes its sigmas to be this many times as large as
/// they are.
fn runs(count: usize, sigma_factor: f64) -> Vec<ConsistencyRecord> {
    let mut generator = ChaCha12Rng::seed_from_u64(5);
    let mut draw = |dof: usize| {
        let chi: f64 = ChiSquared::new(dof as f64).unwrap().sample(&mut generator);
        chi / (sigma_factor * sigma_factor)
    };
    (0..count)
        .map(|_| {
            let mut record = ConsistencyRecord {
                dimension: 48,
                ..ConsistencyRecord::default()
            };
            for step in 0..STEPS {
                // The start is known exactly.
                record.pose_nees.push((step > 0).then(|| draw(6)));
                record.feature_nees.push(Some(draw(3)));
                record.joint_nees_per_dof.push(Some(draw(48) / 48.0));
                // As many features as there happen to be.
                let seen = 3 * (step % 4);
                let value = if seen > 0 { draw(seen) } else { 0.0 };
                record.feature_nis.push((value, seen));
                record.structure_nis.push((0.0, 0));
            }
            record
        })
        .collect()
}

fn judgement(measure: Measure, runs: &[ConsistencyRecord]) -> Option<Judgement> {
    Judgement::of(measure, &runs.iter().collect::<Vec<_>>())
}

const TAKEN: [Measure; 4] = [
    Measure::PoseNees,
    Measure::FeatureNees,
    Measure::JointNees,
    Measure::FeatureNis,
];

#[test]
fn a_filter_that_is_right_is_consistent() {
    let runs = runs(60, 1.0);
    for measure in TAKEN {
        let judged = judgement(measure, &runs).unwrap();
        assert_eq!(judged.verdict, Verdict::Consistent, "{measure:?}");
        assert!(
            (judged.mean - 1.0).abs() < 0.05,
            "{measure:?} {}",
            judged.mean
        );
        assert!(judged.steps_inside > 0.9, "{measure:?}");
        assert!(judged.interval.low < 1.0 && judged.interval.high > 1.0);
    }
}

#[test]
fn wrong_sigmas_show_in_every_measure() {
    for (factor, verdict) in [(0.7, Verdict::OverConfident), (1.4, Verdict::Cautious)] {
        let runs = runs(60, factor);
        for measure in TAKEN {
            let judged = judgement(measure, &runs).unwrap();
            assert_eq!(judged.verdict, verdict, "{measure:?}");
            assert!((judged.mean * factor * factor - 1.0).abs() < 0.05);
        }
    }
}

#[test]
fn the_interval_is_that_of_the_runs_together() {
    let runs = runs(100, 1.0);
    let judged = judgement(Measure::PoseNees, &runs).unwrap();
    // 600 degrees of freedom: 1 ± 2.576 √(2/600), to the skew of χ².
    assert!((judged.interval.low - 0.857).abs() < 0.003);
    assert!((judged.interval.high - 1.155).abs() < 0.003);
}

#[test]
fn a_feature_that_is_wrong_is_counted() {
    let results = |wrong: f64| {
        let mut runs = runs(40, 1.0);
        for run in &mut runs {
            run.nees_of_features = vec![(90.0, 30), (90.0 * wrong, 30)];
        }
        let done: Vec<&ConsistencyRecord> = runs.iter().collect();
        let planner = PlannerName::LOCAL;
        ConsistencyCell::of("a", EstimatorName::EULER_EKF, planner, &done)
    };
    assert_eq!(results(1.0).features_outside(), 0);
    let cell = results(4.0);
    assert_eq!(cell.features_outside(), 1);
    assert_eq!(cell.nees_of_features, [Some(1.0), Some(4.0)]);
}

#[test]
fn steps_without_a_value_are_left_out() {
    let runs = runs(10, 1.0);
    let judged = judgement(Measure::PoseNees, &runs).unwrap();
    assert_eq!(judged.steps.len(), STEPS - 1);
    assert_eq!(judged.steps[0].step, 2);
    let judged = judgement(Measure::FeatureNis, &runs).unwrap();
    assert!(judged.steps.iter().all(|step| (step.step - 1) % 4 != 0));
    assert_eq!(judgement(Measure::StructureNis, &runs), None);
    assert_eq!(judgement(Measure::PoseNees, &[]), None);
}
