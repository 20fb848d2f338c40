//! Safe actions against their definition.

mod common;

use adslam_planning::{ObjectSurfaces, SafeActions, Situation};
use common::CLEARANCE;
use nalgebra::Vector3;
use proptest::prelude::*;

proptest! {
    #[test]
    fn safe_is_clear_now_and_later_with_a_free_way(
        features in common::features(),
        pose in common::pose(),
        motion in prop::array::uniform3(-0.3..0.3),
    ) {
        let Some((model, belief)) = common::world(&features, pose) else { return Ok(()) };
        let feature_motion = vec![Vector3::from(motion); features.len()];
        let situation = Situation {
            belief: &belief,
            feature_motion: &feature_motion,
            model: &model,
            time_is_up: None,
        };
        let mut surfaces = ObjectSurfaces::default();
        let [now, after] = surfaces.place(&situation)?;
        let mut safe = SafeActions::default();
        safe.find(&situation, [now, after])?;
        let distance = |p| now.signed_distance(p).min(after.signed_distance(p));
        let chosen: Vec<usize> = safe.candidates().iter().map(|c| c.index).collect();

        let predicted = |u| adslam_models::predicted_pose(&pose, u);
        let all: Vec<_> = model.actions.controls().iter().map(predicted).collect();
        let admissible = |i: &usize| model.actions.admits(all[*i].orientation);
        let considered: Vec<usize> = if (0..all.len()).any(|i| admissible(&i)) {
            (0..all.len()).filter(admissible).collect()
        } else {
            (0..all.len()).collect()
        };
        let is_safe = |i: &usize| {
            let end = &all[*i].position;
            distance(end) > CLEARANCE
                && !now.crosses(&pose.position, end)
                && !after.crosses(&pose.position, end)
        };
        let expected: Vec<usize> = considered.iter().copied().filter(is_safe).collect();
        if expected.is_empty() {
            prop_assert!(safe.compromised());
            prop_assert_eq!(chosen.len(), 1);
            let best = considered.iter().map(|&i| distance(&all[i].position));
            let best = best.fold(f64::NEG_INFINITY, f64::max);
            prop_assert_eq!(distance(&all[chosen[0]].position), best);
        } else {
            prop_assert_eq!(chosen, expected);
        }
    }
}
