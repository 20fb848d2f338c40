//! Places and directions of messages. Lengths are metres here.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use serde::Serialize;

/// Metres in a centimetre.
pub(super) const METRES: f64 = 0.01;

#[derive(Clone, Copy, PartialEq, Serialize)]
pub(super) struct Xyz {
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Serialize)]
pub(super) struct Quaternion {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

#[derive(Serialize)]
pub(super) struct Placed {
    pub(super) position: Xyz,
    pub(super) orientation: Quaternion,
}

/// The vertices of a surface, to what a drawing shows.
pub(super) fn surface_points(vertices: &[Point3<f64>]) -> Vec<Xyz> {
    vertices
        .iter()
        .map(|p| rounded(&(p.coords * METRES), SURFACE_STEPS))
        .collect()
}

pub(super) fn placed(pose: &Isometry3<f64>) -> Placed {
    Placed {
        position: metres(&pose.translation.vector),
        orientation: quaternion(&pose.rotation),
    }
}

pub(super) fn at_origin() -> Placed {
    placed(&Isometry3::identity())
}

pub(super) fn quaternion(q: &UnitQuaternion<f64>) -> Quaternion {
    Quaternion {
        x: q.i,
        y: q.j,
        z: q.k,
        w: q.w,
    }
}

/// Steps in a metre to which a surface is rounded: a hundredth of a millimetre.
const SURFACE_STEPS: f64 = 1e5;

/// To a hundredth of a micrometre: histories have no more, and files are shorter.
pub(super) fn metres(v: &Vector3<f64>) -> Xyz {
    rounded(&(v * METRES), 1e8)
}

/// To the next of so many steps in a unit.
fn rounded(v: &Vector3<f64>, steps: f64) -> Xyz {
    let [x, y, z] = [v.x, v.y, v.z].map(|c| (c * steps).round() / steps);
    Xyz { x, y, z }
}
