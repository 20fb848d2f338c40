//! What can be seen of a run while it goes on.

use adslam_agent::StepInput;
use adslam_estimator::{Belief, UpdateReport};
use adslam_models::{FeatureId, Pose};
use adslam_planning::{Decision, Score};
use nalgebra::Point3;

use crate::StepMetrics;

/// Everything about one step, as it stands after the filter's update.
#[derive(Clone, Copy, Debug)]
pub struct StepView<'a> {
    /// n; the start is 1.
    pub step: usize,
    /// The true pose.
    pub pose: &'a Pose,
    /// The true features, cm, world.
    pub features: &'a [Point3<f64>],
    /// What the filter believes.
    pub belief: &'a Belief,
    /// The features that the robot really sees; those that it fails to measure do not count.
    pub visible: &'a [FeatureId],
    /// The errors.
    pub metrics: &'a StepMetrics,
    /// What the filter was given to come here; none at the start.
    pub input: Option<StepInput<'a>>,
    /// What the measurements said about the filter; none at the start.
    pub update: Option<&'a UpdateReport>,
    /// The drift floor: the error of the position that the noise alone is expected to cost, cm.
    pub drift_floor: f64,
    /// Signed distance of the true robot from the true surface, cm, negative inside.
    pub surface_distance: f64,
    /// The decision that led here, and how long it took in ms; none at the start.
    pub decision: Option<(&'a Decision, f64)>,
    /// The actions that were scored for that decision.
    pub scores: &'a [Score],
    /// The viewpoints that the planner visits.
    pub viewpoints: &'a [Point3<f64>],
}
