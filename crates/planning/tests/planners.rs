//! What planners that visit viewpoints say of themselves.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;

use adslam_models::{Pose, predicted_pose};
use adslam_planning::{
    CombinedPlanner, GlobalPlanner, Goals, Nearest, Planner, PlanningNoise, Situation,
};
use nalgebra::{Point3, Vector3};

#[test]
fn they_head_for_a_viewpoint_and_score_what_ends_nearest_to_it() {
    let features: Vec<Point3<f64>> = [Vector3::x(), Vector3::y(), Vector3::z()]
        .into_iter()
        .flat_map(|axis| [axis, -axis])
        .map(|v| Point3::new(2.5, 0.0, 0.0) + v)
        .collect();
    let (model, belief) = common::world(&features, Pose::default()).unwrap();
    let situation = Situation {
        belief: &belief,
        feature_motion: &vec![Vector3::zeros(); features.len()],
        model: &model,
        time_is_up: None,
    };
    // The robot is at the first one already.
    let viewpoints = vec![Point3::new(0.01, 0.0, 0.0), Point3::new(0.3, 2.0, 0.1)];
    let goal = viewpoints[1];
    let goals = || Goals::new(viewpoints.clone(), 0.1).unwrap();

    let mut global = GlobalPlanner::new(goals());
    let to_goal = global.decide(&situation).unwrap();
    assert_eq!(to_goal.goal, Some((1, goal)));
    assert_eq!(global.viewpoints(), viewpoints);
    assert!(global.scores().is_empty() && to_goal.predicted_trace.is_none());
    let distance = |pose: &Pose| (pose.position - goal).norm();
    let mut distances: Vec<f64> = model
        .actions
        .controls()
        .iter()
        .map(|control| distance(&predicted_pose(&Pose::default(), control)))
        .collect();
    distances.sort_by(f64::total_cmp);
    let end = predicted_pose(&Pose::default(), &to_goal.control);
    assert!(distance(&end) < distances[0] + 1e-12);

    let nearest = Nearest::Count(20);
    let mut combined = CombinedPlanner::new(goals(), nearest, PlanningNoise::default());
    let decision = combined.decide(&situation).unwrap();
    assert_eq!(decision.goal, Some((1, goal)));
    assert_eq!(combined.viewpoints(), viewpoints);
    assert!(decision.scored > 0);
    assert_eq!(combined.scores().len(), decision.scored);
    for score in combined.scores() {
        assert!(distance(&score.pose) < distances[19] + 1e-12);
    }
    assert_eq!(to_goal.safe, model.actions.controls().len(), "all are safe");
}

#[test]
fn they_say_which_viewpoint_they_gave_up() {
    let features = [
        [50.0, 0.0, 0.0],
        [51.0, 0.0, 0.0],
        [50.5, 1.0, 0.0],
        [50.5, 0.0, 1.0],
    ]
    .map(Point3::from);
    let (model, belief) = common::world(&features, Pose::default()).unwrap();
    let situation = Situation {
        belief: &belief,
        feature_motion: &[Vector3::zeros(); 4],
        model: &model,
        time_is_up: None,
    };
    let viewpoints = [Point3::new(5.0, 0.0, 0.0), Point3::new(0.0, 5.0, 0.0)];
    let goals = || {
        let goals = Goals::new(viewpoints.to_vec(), 0.1).unwrap();
        goals.giving_up_after(1)
    };
    let nearest = Nearest::Count(20);
    let planners: [Box<dyn Planner>; 2] = [
        Box::new(GlobalPlanner::new(goals())),
        Box::new(CombinedPlanner::new(
            goals(),
            nearest,
            PlanningNoise::default(),
        )),
    ];
    for mut planner in planners {
        // The robot does not move, whatever is decided.
        for (goal, abandoned) in [(0, None), (1, Some(0)), (0, Some(1))] {
            let decision = planner.decide(&situation).unwrap();
            let at = |place: usize| (place, viewpoints[place]);
            assert_eq!(decision.goal, Some(at(goal)));
            assert_eq!(decision.abandoned, abandoned.map(at));
        }
    }
}
