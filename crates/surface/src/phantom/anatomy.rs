//! The parts of the heart, in cm, near where they end up in the world.

use nalgebra::{Point3, Vector3};

use super::implicit::{Cone, Part, SmoothUnion, Solid};

/// Widths of the blends within a muscle, in the grooves between chambers, and of vessels, in cm.
const MUSCLE: f64 = 1.6;
const GROOVE: f64 = 0.9;
const VESSEL: f64 = 0.7;

/// A place on the axis of a part, and the part's radius there.
type Station = ([f64; 3], f64);

fn chamber(centre: [f64; 3], radii: [f64; 3], blend: f64) -> Part {
    let (centre, radii) = (Point3::from(centre), Vector3::from(radii));
    (Solid::Ellipsoid { centre, radii }, blend)
}

fn cone(from: Station, to: Station) -> Cone {
    Cone {
        ends: [Point3::from(from.0), Point3::from(to.0)],
        radii: [from.1, to.1],
    }
}

/// A muscular cone.
fn wall(from: Station, to: Station, blend: f64) -> Part {
    (Solid::Cone(cone(from, to)), blend)
}

/// A tube that is cut off at the last station.
fn vessel<const N: usize>(course: [Station; N]) -> impl Iterator<Item = Part> {
    (1..N).map(move |i| {
        let section = cone(course[i - 1], course[i]);
        let solid = if i + 1 == N {
            Solid::Stump(section)
        } else {
            Solid::Cone(section)
        };
        (solid, VESSEL)
    })
}

/// The whole heart.
pub(super) fn heart() -> SmoothUnion {
    let mut parts = vec![
        // Left ventricle: from the base behind to the apex, low, left and in front.
        wall(([8.9, 0.9, 7.2], 3.0), ([10.6, -0.9, 5.0], 3.1), MUSCLE),
        wall(([10.6, -0.9, 5.0], 3.1), ([12.8, -3.1, 2.6], 1.5), MUSCLE),
        // Right ventricle: inflow, the part along the diaphragm that ends short of the apex, and
        // the outflow in front of the aorta.
        wall(([5.9, -1.7, 4.9], 2.5), ([8.9, -2.9, 4.0], 2.2), GROOVE),
        wall(([8.9, -2.9, 4.0], 2.2), ([11.3, -3.5, 3.0], 1.2), GROOVE),
        wall(([6.6, -2.3, 5.4], 2.5), ([8.6, -3.2, 9.0], 1.4), MUSCLE),
        // Atria.
        chamber([3.9, 0.6, 6.8], [2.3, 2.4, 2.7], GROOVE),
        chamber([8.0, 3.4, 8.4], [3.0, 2.0, 2.1], GROOVE),
        // What lies between them and the roots of the great arteries.
        chamber([6.7, 0.9, 8.2], [2.5, 2.3, 1.6], MUSCLE),
        // Auricles, which reach forward round the great arteries.
        wall(([4.0, -0.8, 8.4], 1.2), ([5.5, -2.7, 8.9], 0.7), GROOVE),
        wall(([10.2, 2.4, 9.0], 1.0), ([11.2, -0.3, 8.9], 0.75), GROOVE),
    ];
    // Aorta: root, ascending part, arch; then the brachiocephalic trunk.
    parts.extend(vessel([
        ([7.3, -0.4, 8.4], 1.35),
        ([6.5, -0.9, 10.8], 1.3),
        ([6.8, -0.3, 12.4], 1.25),
        ([8.0, 0.8, 13.3], 1.2),
        ([9.6, 2.2, 13.2], 1.1),
    ]));
    parts.extend(vessel([([7.0, 0.0, 13.0], 0.7), ([6.6, -0.3, 15.0], 0.55)]));
    // Pulmonary trunk and left pulmonary artery.
    parts.extend(vessel([
        ([8.6, -3.2, 9.0], 1.4),
        ([9.4, -2.4, 10.6], 1.2),
        ([10.5, -0.8, 11.4], 1.0),
        ([12.0, 1.2, 11.5], 0.85),
    ]));
    // Superior and inferior vena cava.
    parts.extend(vessel([([3.7, 1.0, 8.0], 1.2), ([3.6, 0.8, 13.0], 0.95)]));
    parts.extend(vessel([([3.9, 1.4, 5.4], 1.3), ([4.1, 2.0, 2.7], 1.1)]));
    // Pulmonary veins: left upper and lower, right upper and lower.
    parts.extend(vessel([([9.6, 3.8, 9.2], 0.95), ([12.2, 4.9, 9.9], 0.7)]));
    parts.extend(vessel([([9.6, 4.0, 7.8], 0.95), ([12.1, 5.2, 7.1], 0.7)]));
    parts.extend(vessel([([6.4, 3.8, 9.2], 0.95), ([3.4, 4.8, 9.9], 0.7)]));
    parts.extend(vessel([([6.4, 4.0, 7.8], 0.95), ([3.5, 5.1, 7.1], 0.7)]));
    SmoothUnion(parts)
}
