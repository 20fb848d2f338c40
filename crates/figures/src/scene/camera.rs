//! From where a scene is seen, and where its points come to lie in a panel.

use nalgebra::{Point3, Vector3};

use super::Placed;
use crate::sheet::units;

/// An orthographic camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    right: Vector3<f64>,
    up: Vector3<f64>,
    toward: Vector3<f64>,
}

impl Camera {
    /// From this azimuth (from x towards y) and elevation above the plane of x and y, degrees.
    pub(crate) fn new(azimuth_deg: f64, elevation_deg: f64) -> Self {
        let (sin_a, cos_a) = azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = elevation_deg.to_radians().sin_cos();
        let toward = Vector3::new(cos_e * cos_a, cos_e * sin_a, sin_e);
        let right = Vector3::new(-sin_a, cos_a, 0.0);
        Self {
            right,
            up: toward.cross(&right),
            toward,
        }
    }

    /// The unit vector that points right in the picture.
    pub(crate) fn right(&self) -> Vector3<f64> {
        self.right
    }

    /// The unit vector that points up in the picture.
    pub(crate) fn up(&self) -> Vector3<f64> {
        self.up
    }

    /// The unit vector from the scene to the camera.
    pub(crate) fn toward(&self) -> Vector3<f64> {
        self.toward
    }

    /// Right and up of a point, cm.
    pub(super) fn flat(&self, p: &Point3<f64>) -> [f64; 2] {
        [self.right.dot(&p.coords), self.up.dot(&p.coords)]
    }

    /// How near a point is, cm; larger is nearer.
    pub(super) fn nearness(&self, p: &Point3<f64>) -> f64 {
        self.toward.dot(&p.coords)
    }
}

/// A camera and the place of its picture in a panel.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub camera: Camera,
    /// px to a cm.
    pub scale: f64,
    /// The panel's pixel of the world's origin.
    pub origin: [f64; 2],
}

impl View {
    /// Where a point lies in the panel, px.
    pub(super) fn pixel(&self, p: &Point3<f64>) -> [f64; 2] {
        let [right, up] = self.camera.flat(p);
        let [x, y] = self.origin;
        [x + self.scale * right, y - self.scale * up]
    }

    /// The same in the units of the sheet.
    pub(super) fn place(&self, p: &Point3<f64>) -> Placed {
        let [x, y] = self.pixel(p);
        (units(x), units(y))
    }
}
