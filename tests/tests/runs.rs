//! Whole runs: what must hold whatever the numbers are.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::run::simulate;
use adslam_models::Control;
use adslam_names::PlannerName;
use adslam_record::{NoObserver, Observer};
use adslam_setup::Setup;
use adslam_simulation::{RunSummary, StepView};
use adslam_tests::{mean, setup, summaries};

/// Keeps the controls of a run.
#[derive(Default)]
struct Controls(Vec<Control>);

impl Observer for Controls {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        self.0
            .extend(view.decision.map(|(decision, _)| decision.control));
        Ok(())
    }
}

fn controls(setup: &Setup, planner: PlannerName, seed: u64) -> Vec<Control> {
    let mut observer = Controls::default();
    simulate(setup, planner, seed, &Interrupt::new(), &mut observer).unwrap();
    assert_eq!(observer.0.len(), setup.model.steps - 1);
    observer.0
}

/// Section III-D: with nᵤ = 1 the combined planner is the global one, with nᵤ = Nᵤ the local one.
#[test]
fn the_combined_planner_contains_the_global_and_the_local_one() {
    let polygon = |n_u| setup("polygon.toml", &[("nearest_fraction = 0.1", n_u)]);
    let heart = |n_u| {
        setup(
            "heart.toml",
            &[
                ("nearest_fraction = 0.05", n_u),
                ("steps = 200", "steps = 80"),
            ],
        )
    };
    let (first, every) = ("nearest_count = 1", "nearest_count = 675");
    for (one, all) in [
        (polygon(first), polygon(every)),
        (heart(first), heart(every)),
    ] {
        let name = one.name();
        for seed in 1..=2 {
            let global = controls(&one, PlannerName::GLOBAL, seed);
            assert_eq!(
                controls(&one, PlannerName::COMBINED, seed),
                global,
                "{name}, {seed}"
            );
            let local = controls(&all, PlannerName::LOCAL, seed);
            assert_eq!(
                controls(&all, PlannerName::COMBINED, seed),
                local,
                "{name}, {seed}"
            );
            assert_ne!(local, global);
        }
    }
}

fn without_times(mut runs: Vec<RunSummary>) -> Vec<RunSummary> {
    for run in &mut runs {
        run.decision_ms = None;
    }
    runs
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let setup = setup("polygon.toml", &[("steps = 100", "steps = 40")]);
    let with_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            PlannerName::PAPER.map(|planner| without_times(summaries(&setup, planner, 6)))
        })
    };
    let alone = with_threads(1);
    assert_eq!(alone, with_threads(2));
    assert_eq!(alone, with_threads(5));
}

/// Every planner starts from the same estimate and the same object.
#[test]
fn planners_meet_the_same_world_at_the_same_seed() {
    #[derive(Default)]
    struct Features(Vec<nalgebra::Point3<f64>>);
    impl Observer for Features {
        fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
            self.0.extend_from_slice(view.features);
            Ok(())
        }
    }
    let setup = setup("polygon.toml", &[("steps = 100", "steps = 30")]);
    let features = |planner| {
        let mut observer = Features::default();
        simulate(&setup, planner, 5, &Interrupt::new(), &mut observer).unwrap();
        observer.0
    };
    let first = features(PlannerName::PREDETERMINED);
    for planner in [
        PlannerName::LOCAL,
        PlannerName::GLOBAL,
        PlannerName::COMBINED,
    ] {
        assert_eq!(features(planner), first);
    }
}

/// General r_t and r_d, both turning, and noise that accumulates as eq. (2) reads: the filter's
/// model is then exactly the world's, and it must be consistent.
#[test]
fn a_world_with_both_rotations_turning_is_filtered_consistently() {
    let setup = setup("rotating.toml", &[]);
    let runs = summaries(&setup, PlannerName::COMBINED, 30);
    let nees = mean(&runs, |run| run.pose_nees_mean.unwrap());
    // 6 is consistent. The errors of neighbouring steps are correlated, so the mean over a run
    // spreads by about 1.6, that over 30 runs by 0.3; linearisation costs some more.
    assert!((5.0..7.5).contains(&nees), "pose NEES {nees}");
    let nees = mean(&runs, |run| run.feature_nees_mean.unwrap());
    assert!((2.4..3.6).contains(&nees), "feature NEES {nees}");
}

#[test]
fn an_interrupted_run_says_so() {
    let setup = setup("polygon.toml", &[]);
    let interrupt = Interrupt::new();
    interrupt.request();
    let error = simulate(&setup, PlannerName::GLOBAL, 1, &interrupt, &mut NoObserver).unwrap_err();
    assert!(matches!(error, Failure::Interrupted));
}

/// With hardly any time a planner still takes a safe action, the best of those it came to score.
#[test]
fn a_deadline_leaves_the_best_action_so_far() {
    #[derive(Default)]
    struct Scored(Vec<(usize, usize)>);
    impl Observer for Scored {
        fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
            if let Some((decision, _)) = view.decision {
                let best = view
                    .scores
                    .iter()
                    .map(|score| score.trace)
                    .fold(f64::INFINITY, f64::min);
                assert!((decision.predicted_trace.unwrap() / best - 1.0).abs() < 1e-11);
                self.0.push((decision.scored, decision.safe));
            }
            Ok(())
        }
    }
    let hurried = "[planners.local]\ndeadline_ms = 1e-6\n\n[planners.predetermined]";
    let setup = setup(
        "polygon.toml",
        &[
            ("steps = 100", "steps = 20"),
            ("[planners.predetermined]", hurried),
        ],
    );
    let mut observer = Scored::default();
    simulate(
        &setup,
        PlannerName::LOCAL,
        1,
        &Interrupt::new(),
        &mut observer,
    )
    .unwrap();
    assert!(
        observer
            .0
            .iter()
            .all(|&(scored, safe)| scored == 1 && safe > 1),
        "{:?}",
        observer.0
    );
}
