//! Solids as functions of position, and their smooth union.

use nalgebra::{Point3, Vector3};

type Point = Point3<f64>;

/// Width over which the rim of a stump is rounded.
const RIM_CM: f64 = 0.5;

/// A simple solid.
#[derive(Clone, Copy, Debug)]
pub(super) enum Solid {
    /// Semi-axes along x, y, z.
    Ellipsoid { centre: Point, radii: Vector3<f64> },
    /// All spheres from one end to the other, their radii changing evenly.
    Cone(Cone),
    /// The same, cut off square at the second end.
    Stump(Cone),
}

/// The ends of an axis, and the radii there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    pub(super) ends: [Point; 2],
    pub(super) radii: [f64; 2],
}

impl Solid {
    /// The distance from `p` to the surface, negative inside: exact for a cone, first-order for
    /// an ellipsoid.
    fn distance(&self, p: &Point) -> f64 {
        match self {
            Self::Ellipsoid { centre, radii } => {
                let scaled = (p - centre).component_div(radii);
                let size = scaled.norm();
                // The gradient of `size`, but for a factor 1 / size.
                let slope = scaled.component_div(radii).norm();
                if slope > 0.0 {
                    (size - 1.0) * size / slope
                } else {
                    -radii.min()
                }
            }
            Self::Cone(cone) => cone.distance(p),
            Self::Stump(cone) => {
                let [start, end] = cone.ends;
                let beyond = (p - end).dot(&(end - start).normalize());
                -smooth_min(-cone.distance(p), -beyond, RIM_CM)
            }
        }
    }

    fn bounds(&self) -> [Point; 2] {
        match self {
            Self::Ellipsoid { centre, radii } => [centre - radii, centre + radii],
            Self::Cone(Cone {
                ends: [start, end],
                radii,
            })
            | Self::Stump(Cone {
                ends: [start, end],
                radii,
            }) => {
                let reach = Vector3::repeat(radii[0].max(radii[1]));
                [start.inf(end) - reach, start.sup(end) + reach]
            }
        }
    }
}

impl Cone {
    fn distance(&self, p: &Point) -> f64 {
        let ([start, end], [first, last]) = (self.ends, self.radii);
        let axis = end - start;
        let length = axis.norm();
        let from_start = p - start;
        let along = from_start.dot(&axis) / length;
        let across = (from_start.norm_squared() - along * along).max(0.0).sqrt();
        // The sphere whose surface is nearest is met at right angles to the slanted side.
        let sine = (first - last) / length;
        let tangent = sine / (1.0 - sine * sine).sqrt();
        let nearest = (along - across * tangent).clamp(0.0, length);
        let radius = first + (last - first) * nearest / length;
        (along - nearest).hypot(across) - radius
    }
}

/// A solid with the width over which it blends into those before it, in cm.
pub(super) type Part = (Solid, f64);

/// Solids blended one after the other.
#[derive(Clone, Debug)]
pub(super) struct SmoothUnion(pub(super) Vec<Part>);

impl SmoothUnion {
    /// Roughly the distance from `p` to the surface, negative inside.
    pub(super) fn distance(&self, p: &Point) -> f64 {
        self.0.iter().fold(f64::INFINITY, |so_far, (solid, blend)| {
            smooth_min(so_far, solid.distance(p), *blend)
        })
    }

    /// A box around everything.
    pub(super) fn bounds(&self) -> [Point; 2] {
        let far = Point::new(f64::INFINITY, f64::INFINITY, f64::INFINITY);
        let mut bounds = [far, -far];
        for (solid, blend) in &self.0 {
            let [low, high] = solid.bounds();
            // Blending swells the surface by less than its width.
            let margin = Vector3::repeat(*blend);
            bounds = [
                bounds[0].inf(&(low - margin)),
                bounds[1].sup(&(high + margin)),
            ];
        }
        bounds
    }
}

/// The lesser of two numbers; where they differ by less than `width`, a parabola that lies below
/// both and joins them smoothly.
fn smooth_min(a: f64, b: f64, width: f64) -> f64 {
    let overlap = (width - (a - b).abs()).max(0.0);
    a.min(b) - overlap * overlap / (4.0 * width)
}
