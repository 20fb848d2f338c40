//! Runs whose truth departs from what filter and planners are told.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use std::collections::BTreeMap;

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::run::simulate;
use adslam_names::PlannerName;
use adslam_record::Observer;
use adslam_setup::Setup;
use adslam_simulation::{RunSummary, StepView};
use adslam_tests::{mean, setup, summaries};

const SEEDS: u64 = 12;

/// The polygon with these keys of `[mismatch]`.
fn departed(keys: &str) -> Setup {
    let table = format!("[mismatch]\n{keys}\n\n[noise]");
    setup(
        "polygon.toml",
        &[("steps = 100", "steps = 60"), ("[noise]", &table)],
    )
}

fn without_times(mut runs: Vec<RunSummary>) -> Vec<RunSummary> {
    for run in &mut runs {
        run.decision_ms = None;
    }
    runs
}

fn pose_nees(runs: &[RunSummary]) -> f64 {
    mean(runs, |run| run.pose_nees_mean.unwrap())
}

#[test]
fn no_mismatch_changes_nothing() {
    let plain = setup("polygon.toml", &[("steps = 100", "steps = 60")]);
    let spelt_out = departed(
        "deformation_factor = 1\ntime_factor = 1\ndelay_steps = 0\nrobot_noise_factor = 1\n\
         outlier_probability = 0\noutlier_sigma_cm = 1\nmissed_detection_probability = 0",
    );
    for planner in [PlannerName::COMBINED, PlannerName::LOCAL] {
        let runs = without_times(summaries(&plain, planner, 2));
        assert_eq!(runs, without_times(summaries(&spelt_out, planner, 2)));
        assert!(runs.iter().all(|run| run.faults.is_none()));
    }
}

/// What these runs gave before there was any mismatch: time, faults and factors have left every draw
/// and every sum as it was.
#[test]
fn the_numbers_without_mismatch_are_those_of_before() {
    for (name, observed, pose, feature, nees) in [
        (
            "polygon",
            250,
            0.2799530946608817,
            0.16835492893016732,
            7.030488117618777,
        ),
        (
            "heart",
            206,
            23.06232598647083,
            0.09594336055817348,
            7.809405910110854,
        ),
        (
            "rotating",
            240,
            0.3146725726700494,
            0.25596802785265965,
            7.951655978123028,
        ),
    ] {
        let setup = setup(&format!("{name}.toml"), &[]);
        let runs = summaries(&setup, PlannerName::PREDETERMINED, 3);
        let run = &runs[2];
        assert_eq!(run.observed, observed, "{name}");
        for (found, before) in [
            (run.pose_error_mean, pose),
            (run.feature_error_mean, feature),
            (run.pose_nees_mean.unwrap(), nees),
        ] {
            // Not to the last bit: sines differ by that between machines.
            assert!(
                (found / before - 1.0).abs() < 1e-9,
                "{name}: {found}, {before}"
            );
        }
    }
}

/// The filter cannot know what it is not told, so its errors grow beyond what it claims.
#[test]
fn what_the_filter_is_not_told_raises_its_nees() {
    let sound = pose_nees(&summaries(&departed(""), PlannerName::GLOBAL, SEEDS));
    assert!(sound < 8.0, "{sound}");
    for (keys, times) in [
        (
            "rotation = { axis = [0, 0, 1], rate_deg_per_step = 3 }",
            2.5,
        ),
        ("deformation_factor = 2.5", 1.5),
        ("time_factor = 1.3", 1.4),
        ("delay_steps = 2.5", 1.8),
        ("robot_noise_factor = 3", 3.0),
        ("feature_noise_factor = 3", 2.5),
        ("measurement_noise_factor = 4", 1.2),
        ("structure_noise_factor = 6", 4.0),
        ("outlier_probability = 0.1\noutlier_sigma_cm = 1", 8.0),
    ] {
        let nees = pose_nees(&summaries(&departed(keys), PlannerName::GLOBAL, SEEDS));
        assert!(nees > times * sound, "{keys}: {nees}, without {sound}");
    }
}

/// Missing measurements are no lie: the filter knows that it has none, and stays consistent.
#[test]
fn what_does_not_arrive_costs_accuracy_but_not_consistency() {
    let plain = summaries(&departed(""), PlannerName::GLOBAL, SEEDS);
    let keys = "missed_detection_probability = 0.5\ndropped_structure_probability = 0.5";
    let poor = summaries(&departed(keys), PlannerName::GLOBAL, SEEDS);
    let observed = |runs: &[RunSummary]| mean(runs, |run| run.observed as f64);
    let part = observed(&poor) / observed(&plain);
    assert!((0.35..0.65).contains(&part), "{part}");
    let error = |runs: &[RunSummary]| mean(runs, |run| run.relative_pose_error_mean);
    assert!(error(&poor) > 1.1 * error(&plain));
    let nees = pose_nees(&poor);
    assert!((4.0..8.0).contains(&nees), "{nees}");
}

/// Every planner meets the same faults: a feature that two of them have in sight at the same step is
/// missed by both or by neither, and so with the structure.
#[test]
fn planners_meet_the_same_faults_at_the_same_seed() {
    /// For each step and feature in sight of the true robot, whether it was measured.
    #[derive(Default)]
    struct Measured {
        setup: Option<Setup>,
        of: BTreeMap<(usize, usize), bool>,
    }
    impl Observer for Measured {
        fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
            let model = &self.setup.as_ref().unwrap().model.planning;
            let surface = adslam_surface::Surface::new(&model.topology, view.features).unwrap();
            for id in adslam_planning::features_seen_in_pose(&model.sensor, view.pose, &surface) {
                let measured = view.visible.contains(&id);
                self.of.insert((view.step, id.0), measured);
            }
            Ok(())
        }
    }
    let setup = departed(
        "missed_detection_probability = 0.4\noutlier_probability = 0.2\noutlier_sigma_cm = 0.1\n\
         dropped_structure_probability = 0.3",
    );
    let of = |planner| {
        let mut observer = Measured {
            setup: Some(setup.clone()),
            ..Measured::default()
        };
        let outcome = simulate(&setup, planner, 4, &Interrupt::new(), &mut observer).unwrap();
        (observer.of, outcome.summary.faults.unwrap())
    };
    let (local, of_local) = of(PlannerName::LOCAL);
    let (combined, of_combined) = of(PlannerName::COMBINED);
    let shared: Vec<_> = local
        .keys()
        .filter(|key| combined.contains_key(key))
        .collect();
    assert!(shared.len() > 50, "{} in both", shared.len());
    for key in &shared {
        assert_eq!(local[key], combined[key], "step and feature {key:?}");
    }
    assert_eq!(of_local.dropped_structures, of_combined.dropped_structures);
    let missed = local.values().filter(|measured| !**measured).count();
    assert_eq!(of_local.missed_detections, missed, "none at the start");
    assert!(missed > 50 && of_local.outliers > 20);
}
