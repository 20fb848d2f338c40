//! The built-in heart: a smooth union of anatomical parts, turned into triangles.
//!
//! Its axes are those of a CT image: x to the patient's left, y to the back, z to the head. It has
//! the four chambers with both auricles, and stumps of the great vessels: aorta with its arch,
//! pulmonary trunk and left pulmonary artery, both caval and four pulmonary veins.

mod anatomy;
mod implicit;
mod lattice;
mod tidy;

use nalgebra::Point3;

use crate::{Mesh, SurfaceError, Topology};

/// Lattice spacing of [`heart_phantom`] that gives several thousand vertices, in cm.
pub const DEFAULT_PHANTOM_SPACING_CM: f64 = 0.4;

/// Least lattice spacing of [`heart_phantom`], in cm: finer takes seconds and tells nothing more.
pub const MIN_PHANTOM_SPACING_CM: f64 = 0.2;

/// Greatest lattice spacing of [`heart_phantom`], in cm: coarser loses the thinner vessels.
pub const MAX_PHANTOM_SPACING_CM: f64 = 0.6;

/// Edges shorter than this share of the spacing are collapsed.
const SHORTEST_EDGE: f64 = 0.45;

/// Where the heart lies in the world, in cm: the box that it just touches on every side.
const LOW_CM: [f64; 3] = [1.0, -6.0, 1.0];
const HIGH_CM: [f64; 3] = [15.0, 6.0, 15.0];

/// A heart of 14 × 12 × 14 cm as a closed mesh of one piece without handles, in the world frame
/// (cm): x 1…15, y −6…6, z 1…15, its apex low and its vessels high. Always the same for the same
/// spacing of the lattice that it is sampled on.
///
/// # Errors
/// A spacing that is not between [`MIN_PHANTOM_SPACING_CM`] and [`MAX_PHANTOM_SPACING_CM`].
pub fn heart_phantom(spacing_cm: f64) -> Result<Mesh, SurfaceError> {
    if !(MIN_PHANTOM_SPACING_CM..=MAX_PHANTOM_SPACING_CM).contains(&spacing_cm) {
        let (min_cm, max_cm) = (MIN_PHANTOM_SPACING_CM, MAX_PHANTOM_SPACING_CM);
        return Err(SurfaceError::Spacing {
            spacing_cm,
            min_cm,
            max_cm,
        });
    }
    let heart = anatomy::heart();
    let distance = |p: &Point3<f64>| heart.distance(p);
    let rough = lattice::polygonise(spacing_cm, heart.bounds(), distance);
    let mut mesh = tidy::tidy(rough, SHORTEST_EDGE * spacing_cm, distance);
    fit(&mut mesh);
    // Checks that the surface closes, and turns the faces outward.
    mesh.faces = Topology::from_faces(&mesh.vertices, &mesh.faces)?
        .faces()
        .to_vec();
    Ok(mesh)
}

/// Stretches the mesh to its box.
fn fit(mesh: &mut Mesh) {
    let Some((low, high)) = mesh.bounds() else {
        return;
    };
    for vertex in &mut mesh.vertices {
        for axis in 0..3 {
            let share = (vertex[axis] - low[axis]) / (high[axis] - low[axis]);
            vertex[axis] = LOW_CM[axis] * (1.0 - share) + HIGH_CM[axis] * share;
        }
    }
}
