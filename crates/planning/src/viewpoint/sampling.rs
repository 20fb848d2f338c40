//! Algorithm 2: a short path of viewpoints from which every feature is seen.

use adslam_models::{FeatureId, Pose, Sensor};
use adslam_surface::Surface;
use nalgebra::Point3;

use super::visibility::{features_seen_from, features_seen_in_pose};
use crate::PlanningError;

/// The parameters of Algorithm 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewpointSampling {
    /// K, how many sets are drawn.
    pub samples: usize,
    /// Added to the cost of eq. (8) for each leg that crosses the object, cm.
    pub crossing_penalty: f64,
}

/// 𝒢_final: viewpoints in the order in which they are to be visited.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewpointPath {
    /// The viewpoints, cm, world.
    pub viewpoints: Vec<Point3<f64>>,
    /// The cost of eq. (8) with the penalties, cm.
    pub cost: f64,
}

/// The features that a robot in the pose `start` does not see and that are seen from none of the
/// viewpoints: a planner that visits those cannot plan for them.
#[must_use]
pub fn features_never_seen(
    viewpoints: &[Point3<f64>],
    sensor: &Sensor,
    start: &Pose,
    surface: &Surface,
) -> Vec<FeatureId> {
    Coverage::new(viewpoints, sensor, start, surface).never_seen()
}

/// Draws K sets of viewpoints and keeps the cheapest.
///
/// A candidate's reward is the number of features seen from it that the robot does not see at the
/// start and no earlier viewpoint of the set sees; each next viewpoint is drawn with a
/// probability proportional to its reward until no reward is left. Every set begins with the
/// candidate nearest to the robot. Candidates inside the object are passed over.
///
/// `draw` gives independent numbers uniform in [0, 1): this crate has no generator of its own.
///
/// # Errors
/// [`PlanningError::NoViewpoints`] if no candidate lies outside the object.
pub fn sample_viewpoints(
    candidates: &[Point3<f64>],
    sensor: &Sensor,
    start: &Pose,
    surface: &Surface,
    sampling: &ViewpointSampling,
    draw: &mut dyn FnMut() -> f64,
) -> Result<ViewpointPath, PlanningError> {
    let outside: Vec<Point3<f64>> = candidates
        .iter()
        .filter(|p| surface.signed_distance(p) > 0.0)
        .copied()
        .collect();
    let squared_distance = |i: usize| (outside[i] - start.position).norm_squared();
    let first = (0..outside.len())
        .min_by(|&a, &b| squared_distance(a).total_cmp(&squared_distance(b)))
        .ok_or(PlanningError::NoViewpoints {
            candidates: candidates.len(),
        })?;

    let coverage = Coverage::new(&outside, sensor, start, surface);
    let mut best: Option<(f64, Vec<usize>)> = None;
    for _ in 0..sampling.samples.max(1) {
        let set = coverage.draw_set(first, draw);
        let cost = path_cost(&set, &outside, surface, sampling.crossing_penalty);
        if best.as_ref().is_none_or(|(smallest, _)| cost < *smallest) {
            best = Some((cost, set));
        }
    }
    let (cost, set) = best.unwrap_or((0.0, vec![first]));
    Ok(ViewpointPath {
        viewpoints: set.into_iter().map(|i| outside[i]).collect(),
        cost,
    })
}

/// Eq. (8), with the penalty for every leg that crosses the object.
fn path_cost(set: &[usize], points: &[Point3<f64>], surface: &Surface, penalty: f64) -> f64 {
    set.windows(2)
        .map(|leg| {
            let (a, b) = (&points[leg[0]], &points[leg[1]]);
            let crossing = if surface.crosses(a, b) { penalty } else { 0.0 };
            (b - a).norm() + crossing
        })
        .sum()
}

/// Who sees what.
struct Coverage {
    /// Features seen from each candidate.
    seen_from: Vec<Vec<FeatureId>>,
    /// Whether each feature is seen at the start.
    seen_at_start: Vec<bool>,
}

impl Coverage {
    fn new(points: &[Point3<f64>], sensor: &Sensor, start: &Pose, surface: &Surface) -> Self {
        let mut seen_at_start = vec![false; surface.points().len()];
        for feature in features_seen_in_pose(sensor, start, surface) {
            seen_at_start[feature.0] = true;
        }
        let seen_from = points
            .iter()
            .map(|p| features_seen_from(sensor, p, surface))
            .collect();
        Self {
            seen_from,
            seen_at_start,
        }
    }

    fn never_seen(&self) -> Vec<FeatureId> {
        let mut seen = self.seen_at_start.clone();
        for feature in self.seen_from.iter().flatten() {
            seen[feature.0] = true;
        }
        seen.iter()
            .enumerate()
            .filter(|(_, seen)| !**seen)
            .map(|(id, _)| FeatureId(id))
            .collect()
    }

    /// Lines 5 to 13 of Algorithm 2.
    fn draw_set(&self, first: usize, draw: &mut dyn FnMut() -> f64) -> Vec<usize> {
        let mut seen = self.seen_at_start.clone();
        let mut set = vec![first];
        let mut picked = first;
        loop {
            for feature in &self.seen_from[picked] {
                seen[feature.0] = true;
            }
            let rewards: Vec<usize> = self
                .seen_from
                .iter()
                .map(|features| features.iter().filter(|f| !seen[f.0]).count())
                .collect();
            let total: usize = rewards.iter().sum();
            if total == 0 {
                return set;
            }
            picked = pick(&rewards, total, draw());
            set.push(picked);
        }
    }
}

/// The index picked by the uniform number `u` in [0, 1), with probabilities proportional to the
/// rewards; one with a reward.
fn pick(rewards: &[usize], total: usize, u: f64) -> usize {
    let target = u * total as f64;
    let mut sum = 0.0;
    let mut last = 0;
    for (i, &reward) in rewards
        .iter()
        .enumerate()
        .filter(|(_, reward)| **reward > 0)
    {
        sum += reward as f64;
        last = i;
        if target < sum {
            break;
        }
    }
    last
}

#[cfg(test)]
mod tests;
