//! Which features are seen from where.

use adslam_models::{FeatureId, Pose, Sensor};
use adslam_surface::Surface;
use nalgebra::Point3;

/// The features that a robot in `pose` sees: in range, in front, and not hidden by the surface. The
/// surface's points are the features.
#[must_use]
pub fn features_seen_in_pose(sensor: &Sensor, pose: &Pose, surface: &Surface) -> Vec<FeatureId> {
    seen(surface, &pose.position, |p| sensor.in_view(pose, p))
}

/// The features that a robot at `position` sees in whatever direction it looks, as the global
/// planner counts them: in range and not hidden by the surface.
#[must_use]
pub fn features_seen_from(
    sensor: &Sensor,
    position: &Point3<f64>,
    surface: &Surface,
) -> Vec<FeatureId> {
    seen(surface, position, |p| sensor.in_range(position, p))
}

fn seen(
    surface: &Surface,
    position: &Point3<f64>,
    within_reach: impl Fn(&Point3<f64>) -> bool,
) -> Vec<FeatureId> {
    // The sight lines cost most, so they come last.
    surface
        .points()
        .iter()
        .enumerate()
        .filter(|&(id, p)| within_reach(p) && surface.sees(position, id))
        .map(|(id, _)| FeatureId(id))
        .collect()
}
