//! A robot at a small solid, for the tests of planners.
#![allow(dead_code, reason = "each test file uses a part")]
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

use std::sync::Arc;

use adslam_estimator::{Belief, FilterNoise};
use adslam_models::{Pose, Sensor};
use adslam_planning::{
    ActionSet, CombinedPlanner, GlobalPlanner, Goals, LocalPlanner, Nearest, Planner,
    PlanningModel, PlanningNoise,
};
use adslam_surface::Topology;
use nalgebra::{Matrix6, Point3, Vector6};
use proptest::prelude::*;

pub const CLEARANCE: f64 = 0.3;

/// Five to nine features around (1.5, 0, 0), with their hull.
pub fn features() -> impl Strategy<Value = Vec<Point3<f64>>> {
    prop::collection::vec(prop::array::uniform3(-1.0..1.0), 5..10).prop_map(|points| {
        points
            .into_iter()
            .map(|[x, y, z]| Point3::new(1.5 + x, y, z))
            .collect()
    })
}

/// A pose near the features or among them.
pub fn pose() -> impl Strategy<Value = Pose> {
    prop::array::uniform6(-1.0..1.0).prop_map(|v| {
        Pose::from_vector(&Vector6::new(
            v[0],
            v[1],
            3.0 * v[2],
            1.5 * v[3],
            v[4],
            v[5],
        ))
    })
}

pub fn actions() -> ActionSet {
    let turn = [-0.5, 0.0, 0.5];
    ActionSet::grid(
        [&turn, &turn, &turn],
        [&[-0.4, 0.0, 0.4], &[-0.5, 0.0, 0.5]],
        0.6,
        0.6,
    )
}

/// The model and the belief; `None` if the hull of the features has no volume to speak of.
pub fn world(features: &[Point3<f64>], pose: Pose) -> Option<(PlanningModel, Belief)> {
    let model = PlanningModel {
        noise: FilterNoise {
            rotation_sigma: 0.02,
            translation_sigma: 0.03,
            feature_motion_sigma: 0.058,
            feature_measurement_sigma: 0.02,
            structure_measurement_sigma: 0.5,
        },
        measures_structure: true,
        sensor: Sensor {
            min_range: 0.1,
            max_range: 2.0,
        },
        topology: Arc::new(Topology::convex_hull(features).ok()?),
        actions: actions(),
        clearance: CLEARANCE,
    };
    let covariance = Matrix6::identity() * 1e-3;
    let belief = Belief::initial(pose, features.to_vec(), &covariance, 0.02).ok()?;
    Some((model, belief))
}

/// All planners that choose, on their way to `goal`.
pub fn planners(goal: Point3<f64>) -> [Box<dyn Planner>; 3] {
    let goals = || Goals::new(vec![goal], 0.1).unwrap();
    let noise = PlanningNoise::default();
    [
        Box::new(LocalPlanner::new(noise)),
        Box::new(GlobalPlanner::new(goals())),
        Box::new(CombinedPlanner::new(goals(), Nearest::Fraction(0.3), noise)),
    ]
}
