//! What is done where no action is safe, at plates.
#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

mod common;

use std::sync::Arc;

use adslam_models::{Pose, predicted_pose};
use adslam_planning::{ActionSet, Decision, Situation};
use adslam_surface::Topology;
use common::planners;
use nalgebra::{Point3, Vector3};

/// Plates across the x axis, each over a range of x (cm), as one surface.
fn plates(ranges: &[[f64; 2]]) -> (Arc<Topology>, Vec<Point3<f64>>) {
    let mut points = Vec::new();
    let mut faces = Vec::new();
    for range in ranges {
        let first = points.len();
        for x in range {
            for (y, z) in [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)] {
                points.push(Point3::new(*x, y, z));
            }
        }
        let mut quad = |corners: [usize; 4]| {
            let [a, b, c, d] = corners.map(|i| first + i);
            faces.extend([[a, b, c], [a, c, d]]);
        };
        quad([3, 2, 1, 0]);
        quad([4, 5, 6, 7]);
        for i in 0..4 {
            let j = (i + 1) % 4;
            quad([i, j, 4 + j, 4 + i]);
        }
    }
    (
        Arc::new(Topology::from_faces(&points, &faces).unwrap()),
        points,
    )
}

/// What the planners decide at `x`, where they can step by `dx` along x and the plates move by `motion`, and where it
/// leads; all agree.
fn decided(
    ranges: &[[f64; 2]],
    x: f64,
    clearance: f64,
    dx: &[f64],
    motion: f64,
) -> (f64, Decision) {
    let (topology, points) = plates(ranges);
    let pose = Pose::new(Default::default(), Point3::new(x, 0.0, 0.0));
    let (mut model, belief) = common::world(&points, pose).unwrap();
    model.topology = topology;
    model.clearance = clearance;
    model.actions = ActionSet::grid([&[0.0], &[0.0], &[0.0]], [dx, &[0.0]], 0.6, 0.6);
    let feature_motion = vec![Vector3::new(motion, 0.0, 0.0); points.len()];
    let situation = Situation {
        belief: &belief,
        feature_motion: &feature_motion,
        model: &model,
        time_is_up: None,
    };
    let decisions = planners(Point3::new(3.0, 0.0, 0.0)).map(|mut planner| {
        let decision = planner.decide(&situation).unwrap();
        let end = predicted_pose(&pose, &decision.control).position.x;
        (end, decision)
    });
    assert!(
        decisions.iter().all(|(end, _)| *end == decisions[0].0),
        "{decisions:?}"
    );
    let [first, ..] = decisions;
    first
}

/// A plate before the robot and a clearance that nothing keeps.
#[test]
fn the_way_through_a_plate_is_never_taken() {
    let plate = [[1.0, 1.2]];
    let end = |dx: &[f64]| {
        let (end, decision) = decided(&plate, 0.5, 3.0, dx, 0.0);
        assert!(decision.compromised && decision.safe == 0 && !decision.limits_waived);
        end
    };
    assert_eq!(
        end(&[0.0, 2.5]),
        0.5,
        "stays, although x = 3 clears the plate by more"
    );
    assert_eq!(
        end(&[2.5]),
        0.5,
        "stays, although no action of the set does"
    );
    assert_eq!(end(&[0.25, 2.5]), 0.5, "nor goes nearer");
    assert_eq!(end(&[-0.25, -1.5, 2.5]), -1.0, "goes back as far as it can");
    // The plate comes nearer and will stand between the robot and where it would go.
    assert_eq!(decided(&plate, 0.5, 3.0, &[0.45], -0.4).0, 0.5);
}

#[test]
fn a_robot_inside_goes_out_and_not_in_again() {
    // The farther end lies beyond the other plate.
    let (end, decision) = decided(&[[0.0, 1.0], [2.0, 3.0]], 0.5, 0.3, &[1.0, 3.25], 0.0);
    assert_eq!(end, 1.5);
    assert!(decision.compromised);
    // Too deep to get out at once: towards the nearer side.
    assert_eq!(decided(&[[0.0, 4.0]], 1.0, 0.3, &[-0.5, 0.5], 0.0).0, 0.5);
    assert_eq!(
        decided(&[[0.0, 4.0]], 1.0, 0.3, &[1.0], 0.0).0,
        1.0,
        "stays rather than goes deeper"
    );
    // The plate will be where the robot is: it goes ahead of it, not through it.
    assert_eq!(
        decided(&[[1.0, 1.2]], 0.9, 0.05, &[-0.3, 0.8], -0.2).0,
        0.9 - 0.3
    );
}

#[test]
fn a_robot_on_the_surface_may_leave_it_and_an_end_on_it_is_not_outside() {
    let to = |ranges: &[[f64; 2]], x, dx: &[f64]| decided(ranges, x, 3.0, dx, 0.0).0;
    // On the face: it goes back, which a robot in front of it could as well.
    assert_eq!(to(&[[1.0, 1.2]], 1.0, &[-0.25]), 0.75);
    // From within, onto a face or through the other plate: neither is out for good, and the latter ends outside.
    assert_eq!(to(&[[0.0, 1.0], [2.0, 3.0]], 0.5, &[0.5, 3.25]), 3.75);
}
