//! What can be seen of a run while it goes on.

use adslam_estimator::{Belief, Measurements, UpdateReport};
use adslam_models::{Control, FeatureId, Pose};
use adslam_planning::{Decision, Score};
use nalgebra::{Point3, Vector3};

use crate::ExperimentError;
use crate::metrics::StepMetrics;

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
    pub input: Option<FilterInput<'a>>,
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

/// All that the filter learns of a step.
#[derive(Clone, Copy, Debug)]
pub struct FilterInput<'a> {
    /// u from the step before.
    pub control: &'a Control,
    /// The known motion of each feature from the step before, cm, world.
    pub feature_motion: &'a [Vector3<f64>],
    /// What was measured.
    pub measurements: Measurements<'a>,
}

/// Watches a run: writes it down, draws it, or stops it with an error.
pub trait Observer {
    /// Called after every step, the start included.
    ///
    /// # Errors
    /// Whatever the observer cannot go on with; it ends the run.
    fn step(&mut self, view: &StepView<'_>) -> Result<(), ExperimentError>;
}

/// Watches nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoObserver;

impl Observer for NoObserver {
    fn step(&mut self, _: &StepView<'_>) -> Result<(), ExperimentError> {
        Ok(())
    }
}
