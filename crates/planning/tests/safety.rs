//! Safe actions, and what is done where there is none, against their definition.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;

use adslam_estimator::Belief;
use adslam_models::{Pose, predicted_pose};
use adslam_planning::{
    ActionSet, Candidate, ObjectSurfaces, PlanningModel, SafeActions, Situation,
};
use adslam_surface::Surface;
use common::{CLEARANCE, planners};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

/// The surfaces of a situation, before and after the motion.
struct World<'a> {
    situation: Situation<'a>,
    surfaces: [Surface; 2],
}

impl<'a> World<'a> {
    fn new(
        model: &'a PlanningModel,
        belief: &'a Belief,
        feature_motion: &'a [Vector3<f64>],
    ) -> Self {
        let situation = Situation {
            belief,
            feature_motion,
            model,
            time_is_up: None,
        };
        let mut surfaces = ObjectSurfaces::default();
        let placed = surfaces.place(&situation).unwrap();
        let surfaces = placed.map(Clone::clone);
        Self {
            situation,
            surfaces,
        }
    }

    fn start(&self) -> Point3<f64> {
        self.situation.belief.state.pose.position
    }

    /// Signed distance from the nearer surface.
    fn distance(&self, p: &Point3<f64>) -> f64 {
        let [now, after] = &self.surfaces;
        now.signed_distance(p).min(after.signed_distance(p))
    }

    /// Whether the way crosses a surface that the robot is outside of.
    fn goes_in(&self, end: &Point3<f64>) -> bool {
        let start = self.start();
        let goes_in = |surface: &Surface| {
            surface.signed_distance(&start) > 0.0 && surface.crosses(&start, end)
        };
        start != *end && self.surfaces.iter().any(goes_in)
    }

    fn found(&self) -> SafeActions {
        let [now, after] = &self.surfaces;
        let mut safe = SafeActions::default();
        safe.find(&self.situation, [now, after]).unwrap();
        safe
    }
}

/// With the action that changes nothing or without.
fn some_actions(stays: bool, step: f64) -> ActionSet {
    let turn = [-0.5, 0.1, 0.5];
    let (with, without) = ([-step, 0.0, step], [-step, 0.5 * step, step]);
    let list = if stays { &with } else { &without };
    ActionSet::grid([&turn, &turn, &turn], [list, &without], 0.6, 0.6)
}

proptest! {
    #[test]
    fn safe_is_clear_now_and_later_with_a_free_way(
        features in common::features(),
        pose in common::pose(),
        motion in prop::array::uniform3(-0.3..0.3),
    ) {
        let Some((model, belief)) = common::world(&features, pose) else { return Ok(()) };
        let feature_motion = vec![Vector3::from(motion); features.len()];
        let world = World::new(&model, &belief, &feature_motion);
        let safe = world.found();

        let ends = |u| predicted_pose(&pose, u);
        let all: Vec<Pose> = model.actions.controls().iter().map(ends).collect();
        let admissible = |i: &usize| model.actions.admits(all[*i].orientation);
        let considered: Vec<usize> = if (0..all.len()).any(|i| admissible(&i)) {
            (0..all.len()).filter(admissible).collect()
        } else {
            (0..all.len()).collect()
        };
        let is_safe = |i: &usize| {
            let end = &all[*i].position;
            let crosses = |surface: &Surface| surface.crosses(&pose.position, end);
            world.distance(end) > CLEARANCE && !world.surfaces.iter().any(crosses)
        };
        let expected: Vec<usize> = considered.iter().copied().filter(is_safe).collect();
        let mut mask = vec![true; all.len()];
        safe.mask(&mut mask);
        let masked: Vec<usize> = (0..all.len()).filter(|i| mask[*i]).collect();
        prop_assert_eq!(&masked, if safe.compromised() { &[][..] } else { &expected[..] });
        if !expected.is_empty() {
            let chosen: Vec<usize> = safe.candidates().iter().map(|c| c.index.unwrap()).collect();
            prop_assert_eq!(chosen, expected);
            return Ok(());
        }
        prop_assert!(safe.compromised());
        let [chosen] = safe.candidates() else { panic!("one compromise") };
        prop_assert!(!world.goes_in(&chosen.pose.position));

        // The hull of the features is convex, so a way from within that ends outside leaves it once.
        let mut open: Vec<Point3<f64>> = considered
            .iter()
            .map(|&i| all[i].position)
            .filter(|end| !world.goes_in(end))
            .collect();
        open.push(pose.position);
        let most = open.iter().map(|end| world.distance(end));
        let most = most.fold(f64::NEG_INFINITY, f64::max);
        prop_assert!((world.distance(&chosen.pose.position) - most).abs() < 1e-10);
    }

    #[test]
    fn no_planner_ever_goes_through_the_object(
        features in common::features(),
        pose in common::pose(),
        motion in prop::collection::vec(prop::array::uniform3(-0.3..0.3), 10),
        goal in prop::array::uniform3(-3.0..5.0),
        clearance in 0.0..3.0,
        (stays, step) in (any::<bool>(), 0.1..4.0),
    ) {
        let Some((mut model, belief)) = common::world(&features, pose) else { return Ok(()) };
        model.actions = some_actions(stays, step);
        model.clearance = clearance;
        let feature_motion: Vec<_> = motion[..features.len()].iter().copied().map(Vector3::from).collect();
        let world = World::new(&model, &belief, &feature_motion);
        let kept = |control| model.actions.admits(predicted_pose(&pose, control).orientation);
        let admissible = model.actions.controls().iter().filter(|control| kept(control)).count();
        for mut planner in planners(Point3::from(goal)) {
            let decision = planner.decide(&world.situation)?;
            let end = predicted_pose(&pose, &decision.control);
            prop_assert!(!world.goes_in(&end.position), "{decision:?}");
            let gained = world.distance(&end.position) - world.distance(&pose.position);
            prop_assert!(!decision.compromised || decision.limits_waived || gained > -1e-9, "{decision:?}");
            prop_assert_eq!(decision.limits_waived, !model.actions.admits(end.orientation));
            prop_assert_eq!(decision.compromised, decision.safe == 0);
            prop_assert_eq!(decision.admissible, admissible);
        }
    }
}

#[test]
fn limits_that_no_action_keeps_are_waived_and_said_to_be() {
    let features = [
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [1.5, 1.0, 0.0],
        [1.5, 0.0, 1.0],
    ]
    .map(Point3::from);
    let pose = Pose::new(Default::default(), Point3::new(-2.0, 0.0, 0.0));
    let (mut model, belief) = common::world(&features, pose).unwrap();
    model.actions = ActionSet::grid([&[0.7], &[0.0], &[0.0]], [&[0.0, 0.1], &[0.0]], 0.6, 0.6);
    let feature_motion = [Vector3::zeros(); 4];
    let world = World::new(&model, &belief, &feature_motion);
    for mut planner in planners(Point3::new(3.0, 0.0, 0.0)) {
        let decision = planner.decide(&world.situation).unwrap();
        assert!(decision.limits_waived && decision.compromised);
        assert_eq!((decision.admissible, decision.safe), (0, 0));
    }
}

proptest! {
    /// Yaw to the left and to the right are as near to a goal straight ahead; rounding must not choose.
    #[test]
    fn of_mirrored_actions_the_first_is_nearest(
        pose in common::pose(),
        (ahead, above) in (-2.0..2.0, -2.0..2.0),
        count in 1_usize..40,
    ) {
        let features = [[50.0, 0.0, 0.0], [51.0, 0.0, 0.0], [50.5, 1.0, 0.0], [50.5, 0.0, 1.0]];
        let features = features.map(Point3::from);
        let (mut model, belief) = common::world(&features, pose).unwrap();
        let yaw = [-0.7, -0.3, 0.0, 0.3, 0.7];
        model.actions = ActionSet::grid([&[0.0], &[0.0, 0.2], &yaw], [&[0.3, 0.1, 0.4], &[0.0, 0.2]], 9.0, 9.0);
        let feature_motion = [Vector3::zeros(); 4];
        let world = World::new(&model, &belief, &feature_motion);
        let goal = pose.position + pose.orientation.rotation() * Vector3::new(ahead, 0.0, above);
        let mut safe = world.found();
        let all: Vec<Candidate> = safe.candidates().to_vec();
        prop_assert_eq!(all.len(), 60);
        safe.keep_nearest(&goal, count);

        // Actions to the left have their mirror image one or three places on in the list of yaw angles.
        let per_yaw = 6;
        let mirrored = |i: usize| i / 30 * 30 + (4 - i % 30 / per_yaw) * per_yaw + i % per_yaw;
        let kept: Vec<usize> = safe.candidates().iter().map(|c| c.index.unwrap()).collect();
        for (place, &i) in kept.iter().enumerate() {
            let first = i.min(mirrored(i));
            let before = kept[..=place].contains(&first);
            prop_assert!(before, "{i} before {first} in {kept:?}");
        }
    }
}
