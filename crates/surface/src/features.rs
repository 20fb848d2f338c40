//! The choice of observable points on a mesh.

use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::hull::Hull;
use crate::{Mesh, SurfaceError, check_points};

/// Picks `count` vertices of a mesh, every one of them a corner of their common convex hull, and
/// returns their numbers in ascending order. The same mesh, count and seed give the same vertices.
///
/// The vertices are shuffled, and those added one by one to a hull until it has `count` corners;
/// a new vertex adds one corner at most, so no number is skipped for good while the hull grows.
///
/// # Errors
/// A count below 4, unusable coordinates, a flat mesh, and a mesh whose hull does not get that
/// many corners.
pub fn pick_features(mesh: &Mesh, count: usize, seed: u64) -> Result<Vec<usize>, SurfaceError> {
    if count < 4 {
        return Err(SurfaceError::FeatureCount { count });
    }
    check_points(&mesh.vertices)?;
    let mut order: Vec<usize> = (0..mesh.vertices.len()).collect();
    order.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));

    let (mut hull, used) = Hull::start(&mesh.vertices, &order)?;
    let mut rest = order[used..].iter();
    let mut found = 0;
    loop {
        // Vertices on flat parts of the hull are not all corners, but no corner is missing.
        if hull.vertex_count() >= count {
            let corners = hull.corners()?;
            if corners.len() == count {
                return Ok(corners);
            }
        }
        found = found.max(hull.vertex_count());
        let grown = rest.by_ref().any(|&p| hull.insert(p));
        if !grown {
            let vertices = mesh.vertices.len();
            return Err(SurfaceError::TooFewFeatures {
                wanted: count,
                found,
                vertices,
            });
        }
    }
}
