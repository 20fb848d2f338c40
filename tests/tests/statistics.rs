//! Statistics of the paper's polygon over 50 seeds. The bounds are those that an independent
//! prototype and the published tables leave; docs/results.md discusses every number.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use adslam_names::PlannerName;
use adslam_simulation::RunSummary;
use adslam_tests::{mean, setup, summaries};

const SEEDS: u64 = 50;

#[test]
fn the_polygon_over_50_seeds() {
    let setup = setup("polygon.toml", &[]);
    let [predetermined, local, global, combined] =
        PlannerName::PAPER.map(|planner| summaries(&setup, planner, SEEDS));

    for (name, runs, low, high) in [
        ("global", &global, 270.0, 330.0),
        ("combined", &combined, 500.0, 640.0),
        ("local", &local, 680.0, 820.0),
    ] {
        let observed = mean(runs, |run| run.observed as f64);
        assert!(
            (low..high).contains(&observed),
            "{name} observes {observed}"
        );
        let nees = mean(runs, |run| run.pose_nees_mean.unwrap());
        assert!((4.0..8.0).contains(&nees), "{name}: pose NEES {nees}");
    }

    let covered = |runs: &[RunSummary]| {
        runs.iter()
            .filter(|r| r.steps_to_full_coverage.is_some())
            .count()
    };
    assert!(
        covered(&local) * 2 < local.len(),
        "the local planner covers everything too often"
    );
    assert!(covered(&global) * 2 > global.len());
    assert!(covered(&combined) * 2 > combined.len());

    let relative = |runs| mean(runs, |run| run.relative_pose_error_mean);
    let errors = [&predetermined, &global, &combined, &local].map(|runs| relative(runs));
    assert!(
        errors.is_sorted_by(|a, b| a > b),
        "object-relative pose errors {errors:?}"
    );

    // The planners keep the robot out; the predetermined path runs through the object at times.
    let inside = |runs: &[RunSummary]| runs.iter().map(|r| r.steps_inside_object).sum::<usize>();
    assert_eq!(
        [&local, &global, &combined].map(|runs| inside(runs)),
        [0, 0, 0]
    );
    assert!(inside(&predetermined) > 0);
}
