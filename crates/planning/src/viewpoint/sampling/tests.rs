use std::collections::BTreeSet;
use std::sync::Arc;

use adslam_models::EulerAngles;
use adslam_surface::Topology;
use proptest::prelude::*;

use super::*;

#[test]
fn picks_in_proportion_to_the_rewards() {
    let rewards = [0, 1, 0, 3, 0];
    let mut counts = [0; 5];
    for i in 0..400 {
        counts[pick(&rewards, 4, f64::from(i) / 400.0)] += 1;
    }
    assert_eq!(counts, [0, 100, 0, 300, 0]);
    assert_eq!(pick(&rewards, 4, 1.0 - f64::EPSILON), 3);
}

#[test]
fn a_set_covers_what_can_be_covered() {
    let ids = |v: &[usize]| v.iter().map(|&i| FeatureId(i)).collect::<Vec<_>>();
    let coverage = Coverage {
        seen_from: vec![ids(&[0]), ids(&[1, 2]), ids(&[2, 3]), ids(&[])],
        seen_at_start: vec![true, false, false, false, false],
    };
    assert_eq!(coverage.never_seen(), vec![FeatureId(4)]);
    for u in [0.0, 0.3, 0.6, 0.99] {
        let set = coverage.draw_set(0, &mut || u);
        assert_eq!(
            set.len(),
            3,
            "the start, then both candidates that see something new"
        );
        assert!(set.contains(&1) && set.contains(&2));
    }
}

const FRONT: Point3<f64> = Point3::new(-2.5, 0.0, 0.0);
const BACK: Point3<f64> = Point3::new(2.5, 0.0, 0.0);
const LEFT: Point3<f64> = Point3::new(0.0, 2.5, 0.0);
const RIGHT: Point3<f64> = Point3::new(0.0, -2.5, 0.0);

/// Draws after which, from FRONT, the candidates FRONT, BACK, LEFT and RIGHT in this order give
/// one of three sets. FRONT sees four corners of the cube; the rewards of the others are 4, 2 and 2.
const THROUGH: &[f64] = &[0.1];
const BY_THE_LEFT: &[f64] = &[0.6, 0.1];
const BY_THE_RIGHT: &[f64] = &[0.9, 0.1];

/// The features are the corners of the cube from −1 to 1.
fn cube() -> Surface {
    let corners: Vec<Point3<f64>> = (0..8)
        .map(|i| Point3::from([1, 2, 4].map(|bit| if i & bit == 0 { -1.0 } else { 1.0 })))
        .collect();
    let topology = Arc::new(Topology::convex_hull(&corners).unwrap());
    Surface::new(&topology, &corners).unwrap()
}

const SENSOR: Sensor = Sensor {
    min_range: 0.1,
    max_range: 10.0,
};

/// A robot at `position` that looks away from the cube.
fn looks_away_at(position: Point3<f64>) -> Pose {
    Pose {
        orientation: EulerAngles::new(0.0, 0.0, std::f64::consts::PI),
        position,
    }
}

/// The path around the cube from the draws of several sets, all of which are taken.
fn path_of(draws: &[&[f64]], crossing_penalty: f64) -> ViewpointPath {
    let mut left = draws.iter().copied().flatten().copied();
    let path = sample_viewpoints(
        &[FRONT, BACK, LEFT, RIGHT],
        &SENSOR,
        &looks_away_at(Point3::new(-3.0, 0.0, 0.0)),
        &cube(),
        &ViewpointSampling {
            samples: draws.len(),
            crossing_penalty,
        },
        &mut || left.next().unwrap(),
    );
    assert_eq!(left.next(), None, "a set was not drawn");
    path.unwrap()
}

#[test]
fn the_cheapest_of_all_sets_is_kept() {
    let (short, long) = (5.0, 5.0 * 2f64.sqrt());
    for draws in [
        [THROUGH, BY_THE_LEFT, BY_THE_RIGHT],
        [BY_THE_LEFT, THROUGH, BY_THE_RIGHT],
        [BY_THE_RIGHT, BY_THE_LEFT, THROUGH],
    ] {
        let path = path_of(&draws, 0.0);
        assert_eq!(path.viewpoints, [FRONT, BACK]);
        assert_eq!(path.cost, short);
    }
    let path = path_of(&[BY_THE_LEFT], 0.0);
    assert_eq!(path.viewpoints, [FRONT, LEFT, BACK]);
    assert!((path.cost - long).abs() < 1e-12, "{}", path.cost);
}

#[test]
fn of_sets_that_cost_the_same_the_first_is_kept() {
    let path = path_of(&[BY_THE_LEFT, BY_THE_RIGHT], 0.0);
    assert_eq!(path.viewpoints, [FRONT, LEFT, BACK]);
    let path = path_of(&[BY_THE_RIGHT, BY_THE_LEFT], 0.0);
    assert_eq!(path.viewpoints, [FRONT, RIGHT, BACK]);
}

#[test]
fn a_penalty_for_crossing_leads_around_the_object() {
    for draws in [[THROUGH, BY_THE_LEFT], [BY_THE_LEFT, THROUGH]] {
        // The way around is longer by 2.07.
        assert_eq!(path_of(&draws, 2.0).viewpoints, [FRONT, BACK]);
        assert_eq!(path_of(&draws, 2.0).cost, 7.0);
        assert_eq!(path_of(&draws, 2.1).viewpoints, [FRONT, LEFT, BACK]);
    }
}

#[test]
fn a_path_costs_its_length_and_the_penalty_for_each_leg_that_crosses() {
    let points = [FRONT, BACK, LEFT, RIGHT, Point3::new(-2.5, 3.0, 4.0)];
    let cost = |set: &[usize]| path_cost(set, &points, &cube(), 100.0);
    assert_eq!(cost(&[0]), 0.0, "nothing before the first viewpoint counts");
    assert_eq!(cost(&[0, 4]), 5.0);
    assert_eq!(cost(&[0, 1]), 105.0);
    assert_eq!(cost(&[0, 1, 0]), 210.0);
    let around_and_through = cost(&[0, 2, 3]);
    let expected = 105.0 + 2.5 * 2f64.sqrt();
    assert!((around_and_through - expected).abs() < 1e-12);
}

/// The only viewpoint of a path that needs no more, as the robot sees all that can be seen or the
/// sensor reaches nothing.
fn first_viewpoint(candidates: &[Point3<f64>], robot: Point3<f64>) -> ViewpointPath {
    let blind = Sensor {
        min_range: 100.0,
        max_range: 200.0,
    };
    let sampling = ViewpointSampling {
        samples: 3,
        crossing_penalty: 0.0,
    };
    let mut never = || unreachable!("nothing is left to draw");
    let start = looks_away_at(robot);
    sample_viewpoints(candidates, &blind, &start, &cube(), &sampling, &mut never).unwrap()
}

#[test]
fn the_first_viewpoint_is_the_nearest_one_outside_the_object() {
    let robot = Point3::new(0.0, 1.5, 0.0);
    let path = first_viewpoint(&[FRONT, BACK, LEFT, RIGHT], robot);
    assert_eq!(path.viewpoints, [LEFT]);
    assert_eq!(path.cost, 0.0);

    let inside = Point3::new(0.0, 0.9, 0.0);
    let on_the_surface = Point3::new(0.0, 1.0, 0.0);
    let path = first_viewpoint(&[inside, on_the_surface, RIGHT, BACK], robot);
    assert_eq!(path.viewpoints, [BACK]);

    // Of those equally near the first.
    let path = first_viewpoint(&[BACK, FRONT, RIGHT], Point3::new(0.0, 1.5, 0.0));
    assert_eq!(path.viewpoints, [BACK]);
}

#[test]
fn candidates_that_are_all_inside_are_refused_with_their_number() {
    let sampling = ViewpointSampling {
        samples: 3,
        crossing_penalty: 0.0,
    };
    let inside = [Point3::origin(), Point3::new(0.0, 0.9, 0.0)];
    let start = looks_away_at(FRONT);
    let path = sample_viewpoints(&inside, &SENSOR, &start, &cube(), &sampling, &mut || 0.5);
    assert!(matches!(
        path,
        Err(PlanningError::NoViewpoints { candidates: 2 })
    ));
}

#[test]
fn what_the_robot_sees_at_the_start_needs_no_viewpoint() {
    let mut start = looks_away_at(FRONT);
    let never_seen = |start: &Pose| features_never_seen(&[RIGHT], &SENSOR, start, &cube()).len();
    assert_eq!(never_seen(&start), 4, "those on the left");
    start.orientation = EulerAngles::default();
    assert_eq!(never_seen(&start), 2, "those on the left at the back");
}

/// Algorithm 2 as printed, with a ticket for each feature of a candidate's reward.
#[allow(
    clippy::cast_possible_truncation,
    reason = "the place of a ticket in a list"
)]
fn by_tickets(
    candidates: &[Point3<f64>],
    sensor: &Sensor,
    start: &Pose,
    surface: &Surface,
    sampling: &ViewpointSampling,
    draws: &mut dyn Iterator<Item = f64>,
) -> Option<ViewpointPath> {
    let mut outside = candidates.to_vec();
    outside.retain(|p| surface.signed_distance(p) > 0.0);
    let mut by_distance = outside.clone();
    by_distance.sort_by_key(|p| (p - start.position).norm_squared().to_bits());
    let first = *by_distance.first()?;

    let mut paths = Vec::new();
    for _ in 0..sampling.samples {
        let mut seen: BTreeSet<FeatureId> = features_seen_in_pose(sensor, start, surface)
            .into_iter()
            .collect();
        let mut viewpoints = vec![first];
        let mut cost = 0.0;
        loop {
            let last = viewpoints[viewpoints.len() - 1];
            seen.extend(features_seen_from(sensor, &last, surface));
            let mut tickets = Vec::new();
            for p in &outside {
                let new = features_seen_from(sensor, p, surface);
                tickets.extend(new.iter().filter(|id| !seen.contains(id)).map(|_| *p));
            }
            if tickets.is_empty() {
                break;
            }
            let next = tickets[(draws.next()? * tickets.len() as f64) as usize];
            let crosses = surface.crosses(&last, &next);
            let penalty = if crosses {
                sampling.crossing_penalty
            } else {
                0.0
            };
            cost += (next - last).norm() + penalty;
            viewpoints.push(next);
        }
        paths.push(ViewpointPath { viewpoints, cost });
    }
    paths
        .into_iter()
        .reduce(|best, path| if path.cost < best.cost { path } else { best })
}

proptest! {
    #[test]
    fn paths_are_those_of_the_algorithm_as_printed(
        features in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 6..20),
        candidates in prop::collection::vec(prop::array::uniform3(-2.0..2.0), 1..20),
        robot in prop::array::uniform3(-2.0..2.0),
        yaw in -3.0..3.0,
        max_range in 1.0..3.0,
        penalty in prop::sample::select(vec![0.0, 0.5, 3.0, 1000.0]),
        samples in 1usize..6,
        draws in prop::collection::vec(0.0..1.0, 120),
    ) {
        let features: Vec<Point3<f64>> = features.into_iter().map(Point3::from).collect();
        let candidates: Vec<Point3<f64>> = candidates.into_iter().map(Point3::from).collect();
        let Ok(topology) = Topology::convex_hull(&features) else { return Ok(()) };
        let surface = Surface::new(&Arc::new(topology), &features)?;
        let sensor = Sensor { min_range: 0.1, max_range };
        let start = Pose {
            orientation: EulerAngles::new(0.0, 0.0, yaw),
            position: Point3::from(robot),
        };
        let sampling = ViewpointSampling { samples, crossing_penalty: penalty };
        let mut plain_draws = draws.iter().copied();
        let plain = by_tickets(&candidates, &sensor, &start, &surface, &sampling, &mut plain_draws);
        let mut left = draws.iter().copied();
        let mut draw = || left.next().unwrap();
        let path = sample_viewpoints(&candidates, &sensor, &start, &surface, &sampling, &mut draw);
        prop_assert_eq!(path.ok(), plain);
        prop_assert_eq!(left.len(), plain_draws.len());
    }
}
