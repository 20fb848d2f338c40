//! What planners know of the world apart from the belief.

use std::sync::Arc;

use adslam_estimator::FilterNoise;
use adslam_models::Sensor;
use adslam_surface::Topology;

use crate::ActionSet;

/// The robot, its sensor, the object's faces and the noise, as the planners assume them.
#[derive(Clone, Debug)]
pub struct PlanningModel {
    /// The noise that the filter assumes.
    pub noise: FilterNoise,
    /// Whether all pairs of features are measured at every step.
    pub measures_structure: bool,
    /// The robot's sensor.
    pub sensor: Sensor,
    /// Which features are joined to the object's surface.
    pub topology: Arc<Topology>,
    /// What the robot can do.
    pub actions: ActionSet,
    /// Distance that the robot keeps from the surface, cm.
    pub clearance: f64,
}
