//! What is said of vertices of a mesh that nearly coincide.

use adslam_surface::{Mesh, NearJoin};

/// A note that near vertices were joined, if any were. Lengths of the mesh times `in_cm` are cm.
pub fn joined_note(joined: &NearJoin, within_cm: f64, in_cm: f64) -> Option<String> {
    let NearJoin {
        vertices,
        farthest,
        collapsed,
    } = joined;
    if *vertices == 0 {
        return None;
    }
    let mut note = format!(
        "{vertices} vertices are joined to others within {within_cm:e} cm, the farthest {:.1e} cm away",
        farthest * in_cm
    );
    if *collapsed > 0 {
        note += &format!("; {collapsed} triangles collapsed");
    }
    Some(note)
}

/// Of a mesh that is not closed: within which distance (cm) its vertices have to be joined to close it, and
/// how to say so; none where that does not close it.
pub fn closing_advice(mesh: &Mesh, in_cm: f64) -> Option<(f64, String)> {
    let (distance, joined) = mesh.closing_distance()?;
    // One digit, so that the product with the unit is a number to read.
    let within_cm = format!("{:.0e}", distance * in_cm);
    let advice = format!(
        "vertices that lie {:.1e} cm apart or less seem meant for one, and to join them closes the surface: give \
         adslam mesh --join-within {within_cm}, or the scenario join_within_cm = {within_cm} in [object.mesh] (for \
         --mesh in [mesh_placement])",
        joined.farthest * in_cm
    );
    Some((within_cm.parse().ok()?, advice))
}
