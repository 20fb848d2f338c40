//! What the robot's sensor can reach, apart from what the surface hides.

use nalgebra::{Point3, Vector3};

use crate::Pose;

/// A range-limited sensor that looks along the body's x axis over the forward half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// Features nearer than this are not seen, cm.
    pub min_range: f64,
    /// Features farther than this are not seen, cm.
    pub max_range: f64,
}

impl Sensor {
    /// Whether a point is at a distance that the sensor measures, whatever the orientation.
    #[must_use]
    pub fn in_range(&self, position: &Point3<f64>, p_in_world: &Point3<f64>) -> bool {
        let squared = (p_in_world - position).norm_squared();
        squared >= self.min_range * self.min_range && squared <= self.max_range * self.max_range
    }

    /// Whether a point is in range and in front of the robot: first body coordinate > 0.
    #[must_use]
    pub fn in_view(&self, pose: &Pose, p_in_world: &Point3<f64>) -> bool {
        let forward = pose.orientation.rotation() * Vector3::x();
        self.in_view_from(&pose.position, &forward, p_in_world)
    }

    /// The same for a robot at `position` whose x axis points along `forward`, a unit vector; both in the world.
    #[must_use]
    pub fn in_view_from(
        &self,
        position: &Point3<f64>,
        forward: &Vector3<f64>,
        p_in_world: &Point3<f64>,
    ) -> bool {
        forward.dot(&(p_in_world - position)) > 0.0 && self.in_range(position, p_in_world)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sees_ahead_between_the_ranges_only() {
        let sensor = Sensor {
            min_range: 0.1,
            max_range: 3.0,
        };
        let pose = Pose::default();
        let ahead = |x: f64| sensor.in_view(&pose, &Point3::new(x, 0.0, 0.0));
        assert!(ahead(0.1) && ahead(3.0) && ahead(1.0));
        assert!(!ahead(0.09) && !ahead(3.01) && !ahead(-1.0));
        assert!(
            !sensor.in_view(&pose, &Point3::new(0.0, 1.0, 0.0)),
            "the side is not in front"
        );
        assert!(sensor.in_range(&pose.position, &Point3::new(-1.0, 0.0, 0.0)));
    }
}
