//! A run added up, against counts by hand.

use adslam_models::Control;
use nalgebra::Point3;

use super::*;

fn metrics(error: f64) -> StepMetrics {
    StepMetrics {
        pose_error: error,
        orientation_error: 0.0,
        geodesic_orientation_error: error / 8.0,
        position_error: error,
        feature_errors: vec![error, 3.0 * error],
        pose_nees: (error > 0.0).then_some(6.0),
        feature_nees: vec![Some(3.0)],
        joint_nees_per_dof: None,
        relative_pose_error: error / 2.0,
        relative_geodesic_orientation_error: error / 16.0,
        relative_position_error: error / 4.0,
        relative_feature_error: error,
    }
}

#[test]
fn counts_as_the_paper_does() {
    let mut builder = SummaryBuilder::new(2);
    builder.add_step(1, [0], &metrics(0.0), 1.0, 0.3);
    builder.add_step(2, [0], &metrics(0.3), 0.2, 0.3);
    builder.add_step(3, [0, 1], &metrics(0.6), -0.1, 0.3);
    let decision = Decision::without_choice(Control::default());
    builder.add_decision(1.0, &decision);
    let compromise = Decision {
        compromised: true,
        limits_waived: true,
        abandoned: Some((0, Point3::origin())),
        ..decision
    };
    builder.add_decision(3.0, &compromise);
    for value in [3.0, 9.0] {
        builder.add_update(&UpdateReport {
            features: Nis { value, dof: 6 },
            structure: Nis::default(),
            rejected: 2,
        });
    }
    [0.0, 0.1, 0.2]
        .into_iter()
        .for_each(|floor| builder.add_drift_floor(floor));
    let run = builder.finish(9);
    assert_eq!((run.seed, run.observed), (9, 3), "the start does not count");
    assert_eq!(run.steps_to_full_coverage, Some(3));
    assert!((run.pose_error_mean - 0.3).abs() < 1e-15);
    assert!((run.drift_floor_mean - 0.1).abs() < 1e-15);
    for (mean, expected) in [
        (run.geodesic_orientation_error_mean, 0.3 / 8.0),
        (run.position_error_mean, 0.3),
        (Some(run.relative_pose_error_mean), 0.3 / 2.0),
        (run.relative_geodesic_orientation_error_mean, 0.3 / 16.0),
        (run.relative_position_error_mean, 0.3 / 4.0),
    ] {
        assert!((mean.unwrap() - expected).abs() < 1e-15);
    }
    assert_eq!(
        (run.pose_error_max, run.feature_error_max),
        (0.6, 3.0 * 0.6)
    );
    assert!(
        (run.feature_error_mean - 1.2).abs() < 1e-15,
        "of the last step"
    );
    assert_eq!((run.steps_inside_object, run.steps_below_clearance), (1, 2));
    assert_eq!(run.pose_nees_mean, Some(6.0));
    assert_eq!(run.feature_nis_per_dof, Some(1.0));
    assert_eq!(run.structure_nis_per_dof, None);
    assert_eq!(run.rejected_measurements, 4);
    assert_eq!(run.compromised_decisions, 1);
    assert_eq!(
        (run.limits_waived_decisions, run.abandoned_viewpoints),
        (1, 1)
    );
    assert_eq!(
        run.decision_ms,
        Some(DecisionTimes {
            median: 1.0,
            p95: 3.0,
            max: 3.0
        })
    );
}

#[test]
fn what_is_seen_at_the_start_counts_for_coverage() {
    let mut builder = SummaryBuilder::new(2);
    builder.add_step(1, [1, 0], &metrics(0.0), 1.0, 0.3);
    builder.add_drift_floor(0.0);
    let run = builder.finish(1);
    assert_eq!((run.observed, run.steps_to_full_coverage), (0, Some(1)));
    assert_eq!((run.pose_nees_mean, run.decision_ms), (None, None));
    let json = serde_json::to_value(&run).unwrap();
    assert!(json["decision_ms"].is_null(), "{json}");
    assert_eq!(serde_json::from_value::<RunSummary>(json).unwrap(), run);
}

#[test]
fn coverage_is_full_at_the_first_step_that_completes_it_or_never() {
    let coverage = |steps: &[&[usize]]| {
        let mut builder = SummaryBuilder::new(2);
        for (i, visible) in steps.iter().enumerate() {
            builder.add_step(1 + i, visible.iter().copied(), &metrics(0.0), 1.0, 0.3);
        }
        builder.finish(1).steps_to_full_coverage
    };
    assert_eq!(coverage(&[&[0], &[], &[0]]), None);
    assert_eq!(coverage(&[&[0], &[1], &[], &[0, 1]]), Some(2));
}

#[test]
fn what_is_at_a_bound_is_neither_inside_nor_too_near() {
    let mut builder = SummaryBuilder::new(2);
    for distance in [0.0, 0.3, 0.4] {
        builder.add_step(1, [], &metrics(0.0), distance, 0.3);
    }
    let run = builder.finish(1);
    assert_eq!((run.steps_inside_object, run.steps_below_clearance), (0, 1));
}

#[test]
fn faults_are_added_up_where_they_can_happen() {
    let faults = FaultCounts {
        outliers: 1,
        missed_detections: 2,
        dropped_structures: 3,
    };
    let counted = |can_happen| {
        let mut builder = SummaryBuilder::new(1).with_faults(can_happen);
        builder.add_faults(faults);
        builder.add_faults(faults);
        builder.finish(1).faults
    };
    let twice = FaultCounts {
        outliers: 2,
        missed_detections: 4,
        dropped_structures: 6,
    };
    assert_eq!((counted(true), counted(false)), (Some(twice), None));
}
