//! Where planners take the object to be.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;

use adslam_models::Pose;
use adslam_planning::{ObjectSurfaces, Situation};
use nalgebra::{Point3, Vector3};

#[test]
fn the_object_is_where_the_belief_has_it_and_then_where_its_motion_leads() {
    let mut surfaces = ObjectSurfaces::default();
    // The second object has as many features and another topology.
    for flip in [1.0, -1.0] {
        let features: Vec<Point3<f64>> = [
            [0.0, 0.0, flip],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, -1.0, 0.0],
            [0.1, 0.1, -flip],
        ]
        .map(Point3::from)
        .into();
        let (model, belief) = common::world(&features, Pose::default()).unwrap();
        for step in [0.0, 0.5] {
            let motion = |i: usize| Vector3::new(step, 0.1 * i as f64, -0.3);
            let feature_motion: Vec<Vector3<f64>> = (0..features.len()).map(motion).collect();
            let situation = Situation {
                belief: &belief,
                feature_motion: &feature_motion,
                model: &model,
                time_is_up: None,
            };
            let [now, after] = surfaces.place(&situation).unwrap();
            assert!(now.is_over(&model.topology) && after.is_over(&model.topology));
            assert_eq!(now.points(), features);
            for (i, p) in after.points().iter().enumerate() {
                assert_eq!(*p, features[i] + motion(i));
            }
        }
    }
}
