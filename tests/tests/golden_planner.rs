//! Planning against numbers from an independent implementation: clear candidates, objectives, and what
//! viewpoints see.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use std::fs::{self, File};
use std::io::BufReader;
use std::sync::Arc;

use adslam_agent::Estimators;
use adslam_estimator::{Belief, DirectTrace, FilterNoise, PlannedMeasurement, PosteriorTrace};
use adslam_models::{Control, FeatureId, Pose, Sensor, predicted_pose};
use adslam_planning::{features_seen_from, features_seen_in_pose};
use adslam_record::log::{FilterChoice, Replay};
use adslam_scenario::{Scenario, Viewpoints};
use adslam_setup::Setup;
use adslam_surface::{Surface, Topology};
use adslam_tests::{fixture, repository};
use nalgebra::{Point3, Vector3};
use serde::Deserialize;

#[derive(Deserialize)]
struct Golden {
    planning_measurement_sigma: f64,
    min_range: f64,
    max_range: f64,
    clearance: f64,
    faces: Vec<[usize; 3]>,
    beliefs: Vec<GoldenBelief>,
    visibility: GoldenVisibility,
}

#[derive(Deserialize)]
struct GoldenBelief {
    before_step: u64,
    feature_motion: Vec<[f64; 3]>,
    candidates: usize,
    clear_candidates: usize,
    actions: Vec<[f64; 6]>,
    trace: Vec<f64>,
}

#[derive(Deserialize)]
struct GoldenVisibility {
    sensor_position: [f64; 3],
    features: Vec<[f64; 3]>,
    visible_from_start: Vec<usize>,
    viewpoints: Vec<[f64; 3]>,
    new_features_visible_per_viewpoint: Vec<usize>,
}

impl Golden {
    fn load() -> Self {
        let text = fs::read_to_string(fixture("golden/polygon.planner.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    }

    fn sensor(&self) -> Sensor {
        Sensor {
            min_range: self.min_range,
            max_range: self.max_range,
        }
    }

    fn topology(&self, features: &[Point3<f64>]) -> Arc<Topology> {
        Arc::new(Topology::from_faces(features, &self.faces).unwrap())
    }
}

/// The belief and the filter's noise before the log's step `step`.
fn belief_before(step: u64) -> (Belief, FilterNoise) {
    let path = fixture("golden/polygon.log.jsonl");
    let mut replay = Replay::new(
        BufReader::new(File::open(&path).unwrap()),
        &path,
        FilterChoice::default(),
        &Estimators::standard(),
    )
    .unwrap();
    for expected in 2..step {
        assert_eq!(replay.advance().unwrap(), Some(expected));
    }
    (replay.belief().clone(), *replay.noise())
}

#[test]
fn clear_candidates_and_objectives() {
    let golden = Golden::load();
    let scenario = Scenario::load(&repository("scenarios/polygon.toml")).unwrap();
    let setup = Setup::new(&scenario).unwrap();
    let actions = setup.model.planning.actions.controls();
    for at in &golden.beliefs {
        let (belief, noise) = belief_before(at.before_step);
        let motion: Vec<Vector3<f64>> = at
            .feature_motion
            .iter()
            .copied()
            .map(Vector3::from)
            .collect();
        let topology = golden.topology(&belief.state.features);
        let now = Surface::new(&topology, &belief.state.features).unwrap();
        let mut moved = belief.state.clone();
        moved.move_features(&motion);
        let after = Surface::new(&topology, &moved.features).unwrap();

        // The golden count takes the unsigned distance.
        let clear = |p: &Point3<f64>| {
            [&now, &after]
                .iter()
                .all(|s| s.signed_distance(p).abs() > golden.clearance)
        };
        let ends = actions
            .iter()
            .map(|u| predicted_pose(&belief.state.pose, u).position);
        assert_eq!(actions.len(), at.candidates);
        assert_eq!(
            ends.filter(clear).count(),
            at.clear_candidates,
            "step {}",
            at.before_step
        );

        let sigma = golden.planning_measurement_sigma;
        let noise = FilterNoise {
            feature_measurement_sigma: sigma,
            ..noise
        };
        let all: Vec<FeatureId> = (0..belief.state.features.len()).map(FeatureId).collect();
        let mut objective = PosteriorTrace::new(&belief, &motion, &noise, true, &all).unwrap();
        let mut direct = DirectTrace::new(&belief, &motion, &noise, true).unwrap();
        assert_eq!(at.actions.len(), at.trace.len());
        for (u, expected) in at.actions.iter().zip(&at.trace) {
            let control = Control {
                rotation: Vector3::new(u[0], u[1], u[2]),
                translation: Vector3::new(u[3], u[4], u[5]),
            };
            let pose = objective.predicted_pose(&control);
            let visible = features_seen_in_pose(&golden.sensor(), &pose, &after);
            let set = objective.add_set(&visible).unwrap();
            let measured: Vec<PlannedMeasurement> = visible
                .iter()
                .map(|&feature| PlannedMeasurement::isotropic(feature, sigma).unwrap())
                .collect();
            for trace in [
                objective.after(&control, set).unwrap(),
                direct.after(&control, &measured).unwrap(),
            ] {
                assert!(
                    (trace - expected).abs() < 1e-9 && (trace / expected - 1.0).abs() < 1e-9,
                    "before step {}, action {u:?}: {trace} is not {expected}",
                    at.before_step
                );
            }
        }
    }
}

/// All counts agree: the golden features are off the exact corners by noise, so no line of sight
/// runs through an edge, and the watertight rule changes nothing here.
#[test]
fn what_viewpoints_see() {
    let golden = Golden::load();
    let at = &golden.visibility;
    let features: Vec<Point3<f64>> = at.features.iter().copied().map(Point3::from).collect();
    let surface = Surface::new(&golden.topology(&features), &features).unwrap();
    let start = Pose {
        position: at.sensor_position.into(),
        ..Pose::default()
    };
    let from_start = features_seen_in_pose(&golden.sensor(), &start, &surface);
    let expected: Vec<FeatureId> = at
        .visible_from_start
        .iter()
        .copied()
        .map(FeatureId)
        .collect();
    assert_eq!(from_start, expected);

    let scenario = Scenario::load(&repository("scenarios/polygon.toml")).unwrap();
    let Viewpoints::Sampled(grid) = &scenario.viewpoints else {
        panic!("the polygon samples")
    };
    let candidates = grid.candidates();
    assert_eq!(candidates.len(), at.viewpoints.len());
    for (k, viewpoint) in at.viewpoints.iter().enumerate() {
        assert_eq!(candidates[k], Point3::from(*viewpoint));
        let seen = features_seen_from(&golden.sensor(), &candidates[k], &surface);
        let new = seen
            .iter()
            .filter(|feature| !from_start.contains(feature))
            .count();
        assert_eq!(
            new, at.new_features_visible_per_viewpoint[k],
            "from {viewpoint:?}"
        );
    }
}
