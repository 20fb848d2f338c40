//! Closed triangle surfaces over moving points.
//!
//! A [`Topology`] says which points are joined by which triangles; a [`Surface`] is a topology
//! placed in the world at one moment, and answers how far a position is from it and what can be
//! seen past it. A [`Mesh`] is a surface at rest: read from an STL, OBJ or PLY
//! file, or the built-in
//! [`heart_phantom`]; [`pick_features`] chooses the points of it that a robot will observe.
//!
//! Where a decision asks much of one place, a [`Fan`] answers for all lines of sight from it, and a
//! [`Clearance`] for all ways from it, with the same answers as one by one.
//!
//! Lengths are centimetres and positions are in the world frame throughout. Decisions (which side,
//! does it touch, is it a corner of the hull) are taken with Shewchuk's adaptive exact predicates,
//! so that they hold for rays through edges and corners and for points on a common plane.
//!
//! No function panics, whatever it is given. Coordinates must be finite and at most
//! [`MAX_COORDINATE_CM`] in size, and 0 or at least [`MIN_COORDINATE_CM`], which keeps every predicate free
//! of overflow and underflow.
//!
//! ```
//! use std::sync::Arc;
//!
//! use adslam_surface::{Surface, Topology};
//! use nalgebra::Point3;
//!
//! let corners: Vec<Point3<f64>> = (0..8)
//!     .map(|i| Point3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)))
//!     .collect();
//! let cube = Surface::new(&Arc::new(Topology::convex_hull(&corners)?), &corners)?;
//! let robot = Point3::new(3.0, 0.5, 0.5);
//! assert!((cube.signed_distance(&robot) - 2.0).abs() < 1e-12);
//! // Corner 7 is at (1, 1, 1), corner 0 behind the cube.
//! assert!(cube.sees(&robot, 7) && !cube.sees(&robot, 0));
//! # Ok::<(), adslam_surface::SurfaceError>(())
//! ```

mod clearance;
mod edges;
mod error;
mod fan;
mod features;
mod hull;
mod inspection;
mod mesh;
mod mesh_file;
mod near;
mod phantom;
mod predicates;
mod spatial;
mod surface;
mod topology;
mod winding;

pub use clearance::Clearance;
pub use error::SurfaceError;
pub use fan::Fan;
pub use features::pick_features;
pub use inspection::Inspection;
pub use mesh::Mesh;
pub use mesh_file::{MAX_MESH_BYTES, MAX_MESH_FACES, MeshFile, MeshFormat};
pub use near::NearJoin;
pub use phantom::{
    DEFAULT_PHANTOM_SPACING_CM, MAX_PHANTOM_SPACING_CM, MIN_PHANTOM_SPACING_CM, heart_phantom,
};
pub use surface::Surface;
pub use topology::Topology;

use nalgebra::Point3;

/// Largest absolute coordinate accepted anywhere in this crate, in cm (ten thousand kilometres).
pub const MAX_COORDINATE_CM: f64 = 1e9;

/// Least absolute coordinate accepted anywhere in this crate but 0, in cm. The lowest digit of a product of
/// three such numbers is still a number, so that the predicates, which add up such products, stay exact.
pub const MIN_COORDINATE_CM: f64 = 1e-90;

/// Whether the predicates may be trusted with this point.
fn is_usable(p: &Point3<f64>) -> bool {
    p.iter().all(|c| {
        let size = c.abs();
        size == 0.0 || (MIN_COORDINATE_CM..=MAX_COORDINATE_CM).contains(&size)
    })
}

/// Fails on the first point that [`is_usable`] refuses.
fn check_points(points: &[Point3<f64>]) -> Result<(), SurfaceError> {
    match points.iter().position(|p| !is_usable(p)) {
        None => Ok(()),
        Some(index) => Err(SurfaceError::UnusablePoint {
            index,
            at: points[index].into(),
        }),
    }
}
