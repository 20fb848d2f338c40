//! Which points are joined by which triangles.

use nalgebra::Point3;

use crate::edges::{Edge, pair_edges};
use crate::hull::Hull;
use crate::{SurfaceError, check_points};

/// Which points are joined by which triangles: a closed surface whose faces all turn
/// anticlockwise when seen from outside. It does not hold positions, because those move; see
/// [`Surface`](crate::Surface).
#[derive(Clone, Debug)]
pub struct Topology {
    faces: Vec<[usize; 3]>,
    /// `faces_of[first_face[p]..first_face[p + 1]]` are the faces at point `p`.
    first_face: Vec<usize>,
    faces_of: Vec<usize>,
}

impl Topology {
    /// Joins points by given triangles. `points` (world, cm) is a reference placement that tells
    /// inside from outside; the faces are turned so that each connected part encloses a positive
    /// volume there.
    ///
    /// # Errors
    /// Unusable coordinates; no faces; a corner that is no point or comes twice in a face; an edge
    /// that is not shared by exactly two faces; a one-sided surface; a part without volume.
    pub fn from_faces(points: &[Point3<f64>], faces: &[[usize; 3]]) -> Result<Self, SurfaceError> {
        check_points(points)?;
        let edges = pair_edges(points, faces)?;
        let mut faces = faces.to_vec();
        turn_outward(points, &mut faces, &edges)?;
        Ok(Self::with_faces(points.len(), faces))
    }

    /// The convex hull of points (world, cm), triangulated. Its corners are exactly the extreme
    /// points: a point inside the hull, or on a flat part of it without being a corner of that
    /// part, is a corner of no face.
    ///
    /// Exact, so any number of points may share a plane. O(points × faces).
    ///
    /// # Errors
    /// Unusable coordinates, fewer than 4 points, repeated points, all points on one plane.
    pub fn convex_hull(points: &[Point3<f64>]) -> Result<Self, SurfaceError> {
        check_points(points)?;
        check_distinct(points)?;
        let all: Vec<usize> = (0..points.len()).collect();
        let faces = Hull::of(points, &all)?.into_faces_of_corners()?;
        Self::from_faces(points, &faces)
    }

    /// The triangles, as point numbers, anticlockwise seen from outside.
    pub fn faces(&self) -> &[[usize; 3]] {
        &self.faces
    }

    /// How many points a placement must give, on the surface or off it.
    pub fn point_count(&self) -> usize {
        self.first_face.len() - 1
    }

    /// The faces that `point` is a corner of, in ascending order; none for a point off the
    /// surface or a number that is no point's.
    pub fn faces_at(&self, point: usize) -> &[usize] {
        let end = point
            .checked_add(1)
            .and_then(|next| self.first_face.get(next));
        match (self.first_face.get(point), end) {
            (Some(&start), Some(&end)) => &self.faces_of[start..end],
            _ => &[],
        }
    }

    /// The points that are no face's corner, in ascending order.
    pub fn points_off_surface(&self) -> Vec<usize> {
        (0..self.point_count())
            .filter(|&p| self.faces_at(p).is_empty())
            .collect()
    }

    fn with_faces(point_count: usize, faces: Vec<[usize; 3]>) -> Self {
        let mut first_face = vec![0; point_count + 1];
        for &corner in faces.iter().flatten() {
            first_face[corner + 1] += 1;
        }
        for p in 0..point_count {
            first_face[p + 1] += first_face[p];
        }
        let mut next = first_face.clone();
        let mut faces_of = vec![0; 3 * faces.len()];
        for (face, corners) in faces.iter().enumerate() {
            for &corner in corners {
                faces_of[next[corner]] = face;
                next[corner] += 1;
            }
        }
        Self {
            faces,
            first_face,
            faces_of,
        }
    }
}

fn check_distinct(points: &[Point3<f64>]) -> Result<(), SurfaceError> {
    let key = |i: usize| <[f64; 3]>::from(points[i]);
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_unstable_by(|&i, &j| {
        let by_place = key(i)
            .partial_cmp(&key(j))
            .unwrap_or(std::cmp::Ordering::Equal);
        by_place.then(i.cmp(&j))
    });
    match order.windows(2).find(|pair| key(pair[0]) == key(pair[1])) {
        None => Ok(()),
        Some(pair) => Err(SurfaceError::RepeatedPoint {
            first: pair[0],
            second: pair[1],
            at: key(pair[0]),
        }),
    }
}

/// Turns faces so that neighbours agree and every connected part encloses a positive volume.
fn turn_outward(
    points: &[Point3<f64>],
    faces: &mut [[usize; 3]],
    edges: &[Edge],
) -> Result<(), SurfaceError> {
    // Neighbours over an edge turn differently when they run it in the same direction.
    let mut neighbours = vec![[(0, false); 3]; faces.len()];
    let mut filled = vec![0; faces.len()];
    for Edge { sides: [a, b], .. } in edges {
        for (this, other) in [(a, b), (b, a)] {
            neighbours[this.face][filled[this.face]] = (other.face, a.upward == b.upward);
            filled[this.face] += 1;
        }
    }

    let mut turned: Vec<Option<bool>> = vec![None; faces.len()];
    for seed in 0..faces.len() {
        if turned[seed].is_some() {
            continue;
        }
        turned[seed] = Some(false);
        let mut part = vec![(seed, false)];
        let mut done = 0;
        while let Some(&(face, is_turned)) = part.get(done) {
            done += 1;
            for (next, differs) in neighbours[face] {
                let turn = is_turned ^ differs;
                match turned[next] {
                    None => {
                        turned[next] = Some(turn);
                        part.push((next, turn));
                    }
                    Some(is) if is != turn => return Err(SurfaceError::OneSided { face: next }),
                    Some(_) => {}
                }
            }
        }
        for &(face, _) in part.iter().filter(|(_, is_turned)| *is_turned) {
            faces[face].swap(1, 2);
        }
        let volume_cm3 = signed_volume(points, part.iter().map(|&(face, _)| faces[face]));
        if volume_cm3 == 0.0 || !volume_cm3.is_finite() {
            return Err(SurfaceError::NoVolume {
                face: seed,
                volume_cm3,
            });
        }
        if volume_cm3 < 0.0 {
            for &(face, _) in &part {
                faces[face].swap(1, 2);
            }
        }
    }
    Ok(())
}

/// The volume enclosed by closed faces, negative if they turn inward. Corners must be valid.
pub(crate) fn signed_volume(
    points: &[Point3<f64>],
    mut faces: impl Iterator<Item = [usize; 3]>,
) -> f64 {
    let Some(first) = faces.next() else {
        return 0.0;
    };
    // Measured from a point of the surface, so that nothing cancels far from the origin; the
    // first face itself then contributes nothing.
    let apex = points[first[0]];
    let six_volumes: f64 = faces
        .map(|corners| corners.map(|i| points[i] - apex))
        .map(|[a, b, c]| a.dot(&b.cross(&c)))
        .sum();
    six_volumes / 6.0
}
