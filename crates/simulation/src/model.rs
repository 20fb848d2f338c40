//! What the episodes of one environment have in common.

use std::sync::Arc;

use adslam_agent::{EstimatorEntry, GateProbability};
use adslam_deformation::ObjectMotion;
use adslam_estimator::{Estimator, EstimatorError, Parallelism};
use adslam_planning::PlanningModel;
use adslam_surface::Mesh;
use nalgebra::Vector3;

use crate::WorldModel;

/// The truth, what the agent is told of it, and how long an episode is. To copy it is cheap.
#[derive(Clone, Debug)]
pub struct EpisodeModel {
    /// What it is called in messages and results.
    pub name: String,
    /// Steps of an episode, the start included.
    pub steps: usize,
    /// The truth before any noise.
    pub world: Arc<WorldModel>,
    /// How the filter and the planners believe the object to move.
    pub known_motion: ObjectMotion,
    /// What the planners know; its noise is the filter's.
    pub planning: Arc<PlanningModel>,
    /// What follows robot and object.
    pub estimator: EstimatorEntry,
    /// The part of good feature measurements that the filter believes; none where it believes all.
    pub gate_probability: Option<GateProbability>,
    /// The filter's sigma of the first feature positions, cm.
    pub initial_feature_sigma: f64,
    /// A viewpoint counts as reached within this distance, cm: for warnings of those that never are.
    pub viewpoint_reached_within: f64,
    /// The surface that is drawn: a mesh's, or the features' own.
    pub drawn: Arc<Mesh>,
}

impl EpisodeModel {
    /// The filter, at the start of an episode.
    ///
    /// # Errors
    /// Sigmas that cannot be used.
    pub fn build_estimator(&self) -> Result<Box<dyn Estimator>, EstimatorError> {
        let (noise, gate) = (self.planning.noise, self.gate_probability);
        // Many episodes are stepped at once, so that each has one thread.
        self.estimator.build(noise, gate, Parallelism::Sequential)
    }

    /// r_t t + r_d d for each feature from step `n` to `n + 1`, as filter and planners know it, cm.
    #[must_use]
    pub fn known_feature_motion(&self, n: usize) -> Vec<Vector3<f64>> {
        self.world
            .rest
            .iter()
            .map(|rest| self.known_motion.feature_motion(rest, n))
            .collect()
    }
}
