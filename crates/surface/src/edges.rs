//! The pairing of faces along edges, and the check that faces are well formed and close up.

use nalgebra::Point3;

use crate::SurfaceError;

/// Where an edge occurs: in which face, and whether the face runs it from its lower point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) face: usize,
    pub(crate) upward: bool,
}

/// An edge of a closed surface with the two faces that share it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub(crate) points: [usize; 2],
    pub(crate) sides: [Side; 2],
}

/// All edges, in the order of their points.
///
/// # Errors
/// No faces, a corner that is no point, a face with a repeated corner, and edges that are not
/// shared by exactly two faces.
pub(crate) fn pair_edges(
    points: &[Point3<f64>],
    faces: &[[usize; 3]],
) -> Result<Vec<Edge>, SurfaceError> {
    check_corners(points.len(), faces)?;
    let sides = edges_of(faces);
    let mut edges = Vec::with_capacity(sides.len() / 2);
    let mut open: Option<([usize; 2], usize)> = None;
    let mut open_count = 0;
    for group in sides.chunk_by(|a, b| a.0 == b.0) {
        match *group {
            [(points, first), (_, second)] => edges.push(Edge {
                points,
                sides: [first, second],
            }),
            _ => {
                open_count += 1;
                open = open.or(Some((group[0].0, group.len())));
            }
        }
    }
    match open {
        None => Ok(edges),
        Some((edge, shared)) => {
            let ends = edge.map(|i| points[i].into());
            Err(SurfaceError::Open {
                count: open_count,
                edge,
                ends,
                shared,
            })
        }
    }
}

/// The sides of all faces by the edge that they lie along, in the order of the edges' points.
pub(crate) fn edges_of(faces: &[[usize; 3]]) -> Vec<([usize; 2], Side)> {
    let mut sides: Vec<([usize; 2], Side)> = Vec::with_capacity(3 * faces.len());
    for (face, &[a, b, c]) in faces.iter().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            sides.push((
                [from.min(to), from.max(to)],
                Side {
                    face,
                    upward: from < to,
                },
            ));
        }
    }
    sides.sort_unstable_by_key(|(ends, side)| (*ends, side.face));
    sides
}

fn check_corners(count: usize, faces: &[[usize; 3]]) -> Result<(), SurfaceError> {
    if faces.is_empty() {
        return Err(SurfaceError::NoFaces);
    }
    for (face, &[a, b, c]) in faces.iter().enumerate() {
        if let Some(point) = [a, b, c].into_iter().find(|&i| i >= count) {
            return Err(SurfaceError::UnknownPoint { face, point, count });
        }
        if a == b || a == c {
            return Err(SurfaceError::RepeatedCorner { face, point: a });
        }
        if b == c {
            return Err(SurfaceError::RepeatedCorner { face, point: b });
        }
    }
    Ok(())
}
