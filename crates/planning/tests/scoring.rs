//! The choice by the trace against the plain way: one dense update for each candidate.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;

use std::sync::atomic::{AtomicUsize, Ordering};

use adslam_estimator::{DirectTrace, FilterNoise, PlannedMeasurement};
use adslam_models::Pose;
use adslam_planning::{
    ActionScorer, LocalPlanner, ObjectSurfaces, Planner, PlanningNoise, SafeActions, Score,
    Situation, TRACE_TOLERANCE, VisibleSets, features_seen_in_pose,
};
use nalgebra::{Point3, Vector3, Vector6};
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

/// The traces of all candidates by the plain way.
fn traces(situation: &Situation<'_>, safe: &SafeActions, noise: &PlanningNoise) -> Vec<f64> {
    let model = situation.model;
    let mut surfaces = ObjectSurfaces::default();
    let [_, after] = surfaces.place(situation).unwrap();
    let noise = noise.over(&model.noise);
    let mut direct = DirectTrace::new(
        situation.belief,
        situation.feature_motion,
        &noise,
        model.measures_structure,
    )
    .unwrap();
    let mut trace = |candidate: &adslam_planning::Candidate| {
        let seen = features_seen_in_pose(&model.sensor, &candidate.pose, after);
        let planned = |id| PlannedMeasurement::isotropic(id, noise.feature_measurement_sigma);
        let seen: Result<Vec<_>, _> = seen.into_iter().map(planned).collect();
        direct.after(&candidate.control, &seen.unwrap()).unwrap()
    };
    safe.candidates().iter().map(&mut trace).collect()
}

/// The scores are those of the plain way, the best is the first of the smallest, and what was passed over
/// is worse.
fn check(
    scores: &[Score],
    best: &Score,
    safe: &SafeActions,
    traces: &[f64],
) -> Result<(), TestCaseError> {
    let smallest = traces.iter().copied().fold(f64::INFINITY, f64::min);
    let equal = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
    prop_assert!(equal(best.trace, smallest), "{} {smallest}", best.trace);
    let first = scores
        .iter()
        .filter(|score| score.trace <= best.trace * (1.0 + TRACE_TOLERANCE))
        // Staying comes last where the set has no such action.
        .min_by_key(|score| score.index.unwrap_or(usize::MAX))
        .map(|score| score.index);
    prop_assert_eq!(Some(best.index), first);
    for (candidate, trace) in safe.candidates().iter().zip(traces) {
        let mut of_candidate = scores.iter().filter(|s| s.index == candidate.index);
        match of_candidate.next() {
            Some(score) => {
                prop_assert!(equal(score.trace, *trace), "{} {trace}", score.trace);
                prop_assert_eq!(score.pose, candidate.pose);
                prop_assert_eq!(of_candidate.next(), None);
            }
            None => prop_assert!(*trace > smallest),
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn the_best_candidate_is_that_of_dense_updates(
        features in common::features(),
        pose in common::pose(),
        motion in prop::array::uniform3(-0.3..0.3),
        sigma in prop::option::of(0.01..0.5),
        measures_structure in any::<bool>(),
    ) {
        let Some((mut model, belief)) = common::world(&features, pose) else { return Ok(()) };
        model.measures_structure = measures_structure;
        let feature_motion = vec![Vector3::from(motion); features.len()];
        let situation = Situation {
            belief: &belief,
            feature_motion: &feature_motion,
            model: &model,
            time_is_up: None,
        };
        let (mut surfaces, mut safe) = (ObjectSurfaces::default(), SafeActions::default());
        let [now, after] = surfaces.place(&situation)?;
        safe.find(&situation, [now, after])?;
        let mut sets = VisibleSets::default();
        sets.find(safe.candidates(), &model.actions, &model.sensor, after);
        let noise = PlanningNoise { feature_measurement_sigma: sigma };
        let traces = traces(&situation, &safe, &noise);

        let mut scorer = ActionScorer::new(noise);
        let best = scorer.best(&situation, safe.candidates(), &sets)?.unwrap();
        check(scorer.scores(), &best, &safe, &traces)?;

        let mut every = ActionScorer::new(noise);
        let every = every.all(&situation, safe.candidates(), &sets)?;
        prop_assert_eq!(every.len(), traces.len());
        for ((score, candidate), trace) in every.iter().zip(safe.candidates()).zip(&traces) {
            prop_assert_eq!(score.index, candidate.index);
            prop_assert!((score.trace / trace - 1.0).abs() < 1e-9, "{} {trace}", score.trace);
        }

        let mut planner = LocalPlanner::new(noise);
        let decision = planner.decide(&situation)?;
        prop_assert_eq!(planner.scores(), scorer.scores());
        prop_assert_eq!(decision.scored, scorer.scores().len());
        prop_assert_eq!(decision.predicted_trace, Some(best.trace));
        let chosen = safe.candidates().iter().find(|candidate| candidate.index == best.index);
        prop_assert_eq!(Some(decision.control), chosen.map(|candidate| candidate.control));
        prop_assert_eq!(decision.safe, safe.safe());
    }
}

/// Six features in front of a robot that has much room.
fn octahedron() -> Vec<Point3<f64>> {
    [Vector3::x(), Vector3::y(), Vector3::z()]
        .into_iter()
        .flat_map(|axis| [axis, -axis])
        .map(|v| Point3::new(1.5, 0.0, 0.0) + v)
        .collect()
}

#[test]
fn when_time_is_up_the_best_so_far_is_taken() {
    let features = octahedron();
    let pose = Pose::from_vector(&Vector6::new(0.1, -0.1, 0.2, -0.6, 0.1, 0.2));
    let (model, belief) = common::world(&features, pose).unwrap();
    let feature_motion = vec![Vector3::zeros(); features.len()];
    let decide = |time: usize| {
        let asked = AtomicUsize::new(0);
        let time_is_up = || asked.fetch_add(1, Ordering::Relaxed) + 1 >= time;
        let situation = Situation {
            belief: &belief,
            feature_motion: &feature_motion,
            model: &model,
            time_is_up: Some(&time_is_up),
        };
        let mut planner = LocalPlanner::default();
        let decision = planner.decide(&situation).unwrap();
        (decision, planner.scores().to_vec())
    };
    let (all, scores) = decide(usize::MAX);
    assert!(scores.len() > 3);
    assert!(
        scores.len() < all.safe,
        "what is sure to be worse is passed over"
    );
    for time in 1..=3 {
        let (decision, scores_in_time) = decide(time);
        assert_eq!(scores_in_time, scores[..decision.scored], "a start of all");
        assert!((1..=time).contains(&decision.scored), "{}", decision.scored);
        let best = scores_in_time
            .iter()
            .map(|s| s.trace)
            .reduce(f64::min)
            .unwrap();
        assert!((decision.predicted_trace.unwrap() / best - 1.0).abs() <= TRACE_TOLERANCE);
    }
    assert_eq!(decide(1).0.scored, 1, "the first action is always scored");
    assert_eq!(decide(1_000_000).0, all);
}

#[test]
fn operations_are_those_of_the_traces_and_sets_of_the_last_decision() {
    let features = octahedron();
    let pose = Pose::from_vector(&Vector6::new(0.0, 0.0, 0.0, -0.6, 0.1, 0.2));
    let (model, belief) = common::world(&features, pose).unwrap();
    let situation = Situation {
        belief: &belief,
        feature_motion: &vec![Vector3::zeros(); features.len()],
        model: &model,
        time_is_up: None,
    };
    let (mut surfaces, mut safe) = (ObjectSurfaces::default(), SafeActions::default());
    let [now, after] = surfaces.place(&situation).unwrap();
    safe.find(&situation, [now, after]).unwrap();
    let mut scorer = ActionScorer::default();
    let mut operations = |candidates: &[adslam_planning::Candidate]| {
        let mut sets = VisibleSets::default();
        sets.find(candidates, &model.actions, &model.sensor, after);
        scorer.best(&situation, candidates, &sets).unwrap();
        scorer.operations()
    };
    // Two actions that see the same need one set and two traces.
    let one = &safe.candidates()[..1];
    let twice = [one[0].clone(), one[0].clone()];
    let [none, single, double] = [operations(&[]), operations(one), operations(&twice)];
    let [set_and_trace, trace] = [single - none, double - single];
    assert!(
        trace > 0 && set_and_trace > trace,
        "{none} {single} {double}"
    );
    assert_eq!(operations(one), single, "counted anew for each decision");
    // Many need at most a trace, a bound and a set each.
    let all = operations(safe.candidates()) - none;
    let count = safe.candidates().len();
    assert!(count > 10 && all > count * trace, "{all}");
}

#[test]
fn assumed_noise_takes_the_place_of_the_filters() {
    let filter = FilterNoise {
        rotation_sigma: 1.0,
        translation_sigma: 2.0,
        feature_motion_sigma: 3.0,
        feature_measurement_sigma: 4.0,
        structure_measurement_sigma: 5.0,
    };
    assert_eq!(PlanningNoise::default().over(&filter), filter);
    let noise = PlanningNoise {
        feature_measurement_sigma: Some(0.5),
    };
    let expected = FilterNoise {
        feature_measurement_sigma: 0.5,
        ..filter
    };
    assert_eq!(noise.over(&filter), expected);
}
