//! What decisions keep from one to the next: no memory is taken after the first of their kind.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;

use adslam_models::Pose;
use adslam_planning::{
    ActionScorer, CombinedPlanner, GlobalPlanner, Goals, LocalPlanner, Nearest, ObjectSurfaces,
    Planner, PlanningNoise, SafeActions, Situation, VisibleSets,
};
use allocation_counter::measure;
use nalgebra::{Point3, Vector3, Vector6};

/// Points evenly around (1.5, 0, 0).
fn ball(count: u32) -> Vec<Point3<f64>> {
    (0..count)
        .map(|i| {
            let (height, turn) = (
                1.0 - f64::from(2 * i + 1) / f64::from(count),
                2.4 * f64::from(i),
            );
            let radius = (1.0 - height * height).sqrt();
            Point3::new(1.5 + radius * turn.cos(), radius * turn.sin(), height)
        })
        .collect()
}

fn planners() -> [Box<dyn Planner>; 3] {
    let goals = || Goals::new(vec![Point3::new(-1.0, 2.0, 0.0)], 0.1).unwrap();
    let noise = PlanningNoise::default();
    [
        Box::new(LocalPlanner::new(noise)),
        Box::new(GlobalPlanner::new(goals())),
        Box::new(CombinedPlanner::new(goals(), Nearest::Fraction(0.3), noise)),
    ]
}

#[test]
fn the_second_of_two_like_decisions_allocates_nothing() {
    // The last has enough faces for a tree, which decisions must not need.
    for count in [14, 50, 120] {
        let features = ball(count);
        let pose = Pose::from_vector(&Vector6::new(0.1, -0.1, 0.2, -0.6, 0.1, 0.2));
        let (model, belief) = common::world(&features, pose).unwrap();
        let feature_motion = vec![Vector3::new(0.02, 0.0, 0.01); features.len()];
        let situation = Situation {
            belief: &belief,
            feature_motion: &feature_motion,
            model: &model,
            time_is_up: None,
        };
        for mut planner in planners() {
            let first = planner.decide(&situation).unwrap();
            assert!(!first.compromised && first.safe > 10);
            let mut second = None;
            let used = measure(|| second = planner.decide(&situation).ok());
            assert_eq!(used.count_total, 0, "{count} features, {used:?}");
            assert_eq!(second.unwrap(), first);
        }
    }
}

#[test]
fn sets_of_other_candidates_are_refused() {
    let features = ball(14);
    let (model, belief) = common::world(&features, Pose::default()).unwrap();
    let situation = Situation {
        belief: &belief,
        feature_motion: &vec![Vector3::zeros(); features.len()],
        model: &model,
        time_is_up: None,
    };
    let (mut surfaces, mut safe) = (ObjectSurfaces::default(), SafeActions::default());
    safe.find(&situation, surfaces.place(&situation).unwrap())
        .unwrap();
    let error = ActionScorer::default()
        .best(&situation, safe.candidates(), &VisibleSets::default())
        .unwrap_err();
    assert!(error.to_string().contains("0 visible sets"), "{error}");
}
