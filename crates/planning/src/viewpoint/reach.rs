//! Which viewpoints can be reached.

use adslam_surface::Surface;
use nalgebra::Point3;

/// Whether a robot that keeps farther than `clearance` from the surface can come nearer than `reached_within`
/// to `viewpoint` (cm), as far as its distance from the surface tells. Not if it lies inside.
#[must_use]
pub fn can_be_reached(
    viewpoint: &Point3<f64>,
    surface: &Surface,
    clearance: f64,
    reached_within: f64,
) -> bool {
    let distance = surface.signed_distance(viewpoint);
    distance > 0.0 && distance + reached_within > clearance
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use adslam_surface::Topology;

    use super::*;

    #[test]
    fn a_viewpoint_is_reached_from_beyond_the_clearance() {
        let corners = [
            [0.0, 0.0, 0.0],
            [9.0, 0.0, 0.0],
            [0.0, 9.0, 0.0],
            [0.0, 0.0, -9.0],
        ];
        let corners = corners.map(Point3::from);
        let topology = Arc::new(Topology::convex_hull(&corners).unwrap());
        let surface = Surface::new(&topology, &corners).unwrap();
        let above = |z: f64| can_be_reached(&Point3::new(1.0, 1.0, z), &surface, 2.0, 0.5);
        assert_eq!([1.4, 1.5, 1.6].map(above), [false, false, true]);
        assert!(!above(-1.0), "inside");
        let on_it = Point3::new(1.0, 1.0, 0.0);
        assert!(
            !can_be_reached(&on_it, &surface, 0.1, 0.5),
            "on the surface"
        );
    }
}
