//! The estimators over many seeds: consistent where their model is the truth's, found out where it is not.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use adslam_diagnostics::Interrupt;
use adslam_experiment::consistency::{ConsistencyRecord, Judgement, Measure, Verdict};
use adslam_experiment::run::simulate;
use adslam_names::{EstimatorName, PlannerName};
use adslam_setup::Setup;
use adslam_tests::{mean, setup, summaries};

const ACCUMULATING: (&str, &str) = ("[noise]", "[noise]\ndeformation_noise = \"accumulating\"");

fn records(setup: &Setup, planner: PlannerName, seeds: u64) -> Vec<ConsistencyRecord> {
    (1..=seeds)
        .map(|seed| {
            let mut record = ConsistencyRecord::default();
            simulate(setup, planner, seed, &Interrupt::new(), &mut record).unwrap();
            record
        })
        .collect()
}

fn judged(measure: Measure, runs: &[ConsistencyRecord]) -> Judgement {
    Judgement::of(measure, &runs.iter().collect::<Vec<_>>()).unwrap()
}

/// docs/consistency.md has 100 runs of everything; these are as many as a test can wait for.
#[test]
fn every_estimator_is_consistent_in_every_measure() {
    let setup = setup("polygon.toml", &[ACCUMULATING]);
    for name in EstimatorName::OURS {
        let setup = setup.with_estimator(name).unwrap();
        let runs = records(&setup, PlannerName::LOCAL, 20);
        for measure in Measure::ALL {
            let judgement = judged(measure, &runs);
            let Judgement { verdict, mean, .. } = judgement;
            assert_eq!(verdict, Verdict::Consistent, "{name}, {measure:?}: {mean}");
        }
    }
}

#[test]
fn the_right_invariant_filter_is_consistent_on_both_environments() {
    let measures = [
        Measure::PoseNees,
        Measure::FeatureNees,
        Measure::FeatureNis,
        Measure::StructureNis,
    ];
    for (name, planner, seeds) in [
        ("polygon.toml", PlannerName::COMBINED, 30),
        ("heart.toml", PlannerName::GLOBAL, 8),
    ] {
        let setup = setup(name, &[ACCUMULATING]);
        let setup = setup
            .with_estimator(EstimatorName::RIGHT_INVARIANT_EKF)
            .unwrap();
        let runs = records(&setup, planner, seeds);
        for measure in measures {
            let Judgement { verdict, mean, .. } = judged(measure, &runs);
            let of = format!("{name}, {planner}, {measure:?}");
            assert_eq!(verdict, Verdict::Consistent, "{of}: {mean}");
        }
    }
}

#[test]
fn a_wrong_sigma_is_found_out() {
    for (factor, verdict) in [("2.0", Verdict::OverConfident), ("0.5", Verdict::Cautious)] {
        let mismatch = format!("[mismatch]\nfeature_noise_factor = {factor}\n\n[sensor]");
        let setup = setup("polygon.toml", &[ACCUMULATING, ("[sensor]", &mismatch)]);
        let runs = records(&setup, PlannerName::LOCAL, 10);
        let judgement = judged(Measure::FeatureNis, &runs);
        assert_eq!(judgement.verdict, verdict, "{factor}: {}", judgement.mean);
    }
}

/// One feature measurement in twenty is off by half a centimetre: without a gate the filter believes it.
#[test]
fn the_gate_keeps_outliers_out() {
    let outliers = "[mismatch]\noutlier_probability = 0.05\noutlier_sigma_cm = 0.5\n\n[sensor]";
    let open = setup("polygon.toml", &[ACCUMULATING, ("[sensor]", outliers)]);
    let gate = format!("[filter]\ngate_probability = 0.999\n\n{outliers}");
    let gated = setup("polygon.toml", &[ACCUMULATING, ("[sensor]", &gate)]);
    let clean = setup("polygon.toml", &[ACCUMULATING]);
    let [open, gated, clean] =
        [&open, &gated, &clean].map(|setup| summaries(setup, PlannerName::LOCAL, 12));
    let error = |runs: &[_]| mean(runs, |run| run.relative_pose_error_mean);
    assert!(
        error(&gated) < 0.7 * error(&open),
        "{} with the gate, {} without",
        error(&gated),
        error(&open)
    );
    assert!(error(&gated) < 1.5 * error(&clean));
    // Outliers that are hardly off are let through; nearly all others are not.
    let kept_out = mean(&gated, |run| run.rejected_measurements as f64);
    let outliers = mean(&gated, |run| run.faults.unwrap().outliers as f64);
    assert!(
        (0.6..1.4).contains(&(kept_out / outliers)),
        "{kept_out} of {outliers}"
    );
    assert_eq!(mean(&open, |run| run.rejected_measurements as f64), 0.0);
}
