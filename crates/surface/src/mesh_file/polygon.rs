//! Polygons cut into triangles.

use std::collections::HashMap;

use earcut::Earcut;
use nalgebra::Vector3;

/// Most corners of a polygon that a fan does not cover: clipping the ears of one that crosses itself
/// takes time with the square of that number, or more.
pub(super) const MOST_CLIPPED: usize = 5000;

/// Of the area, what rounding may take away or add.
const ROUNDING: f64 = 1e-9;

/// Cuts polygons into triangles, with room that is used again.
pub(super) struct Cutter {
    earcut: Earcut<f64>,
    flat: Vec<[f64; 2]>,
    clipped: Vec<usize>,
    triangles: Vec<[usize; 3]>,
}

impl std::fmt::Debug for Cutter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Cutter").finish_non_exhaustive()
    }
}

impl Default for Cutter {
    fn default() -> Self {
        Self {
            earcut: Earcut::new(),
            flat: Vec::new(),
            clipped: Vec::new(),
            triangles: Vec::new(),
        }
    }
}

/// How a polygon was cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// The triangles cover it.
    Covers,
    /// It crosses itself or has no area, so that nothing covers it: a fan from its first corner.
    Crossed,
    /// No fan covers it, and it has more than [`MOST_CLIPPED`] corners: no triangles.
    TooLong,
}

impl Cutter {
    /// Triangles between the corners of a polygon, by the numbers of these, which turn as it does:
    /// always two fewer than it has corners, and each of its sides belongs to one of them.
    ///
    /// A fan from the first corner where that covers the polygon, as with every convex one.
    pub(super) fn cut(&mut self, corners: &[[f64; 3]]) -> (&[[usize; 3]], Cut) {
        let count = corners.len();
        let fan = (2..count).map(|i| [0, i - 1, i]);
        self.triangles.clear();
        if count == 3 {
            self.triangles.extend(fan);
            return (&self.triangles, Cut::Covers);
        }
        let area = self.flatten(corners);
        let is_fan = area.is_some() && fan.clone().all(|triangle| self.area(triangle) > 0.0);
        let cut = match area {
            Some(_) if is_fan => Cut::Covers,
            Some(_) if count > MOST_CLIPPED => return (&[], Cut::TooLong),
            Some(area) if self.clip(area) => return (&self.triangles, Cut::Covers),
            _ => Cut::Crossed,
        };
        self.triangles.clear();
        self.triangles.extend(fan);
        (&self.triangles, cut)
    }

    /// Lays the corners out in the plane of the two axes that the polygon is most nearly parallel
    /// to, so that it turns anticlockwise; its area there, or none if it has none.
    fn flatten(&mut self, corners: &[[f64; 3]]) -> Option<f64> {
        let first = Vector3::from(*corners.first()?);
        let from_first = corners.iter().map(|c| Vector3::from(*c) - first);
        let size = from_first.clone().map(|c| c.amax()).fold(0.0, f64::max);
        let scaled: Vec<Vector3<f64>> = from_first.map(|c| c / size).collect();
        // Newell's normal, twice as long as the area is large.
        let normal: Vector3<f64> = scaled
            .iter()
            .zip(scaled.iter().cycle().skip(1))
            .map(|(a, b)| a.cross(b))
            .sum();
        let axis = normal.iamax();
        let twice = normal[axis];
        let least = f64::EPSILON * corners.len() as f64;
        // Neither is a number that is none.
        if !twice.is_finite() || twice.abs() <= least {
            return None;
        }
        let (mut right, mut up) = ((axis + 1) % 3, (axis + 2) % 3);
        if twice < 0.0 {
            (right, up) = (up, right);
        }
        self.flat.clear();
        self.flat.extend(scaled.iter().map(|c| [c[right], c[up]]));
        Some(twice.abs() / 2.0)
    }

    /// Clips ears; whether the triangles cover the area.
    fn clip(&mut self, area: f64) -> bool {
        let count = self.flat.len();
        let holes: [usize; 0] = [];
        self.earcut
            .earcut(self.flat.iter().copied(), &holes, &mut self.clipped);
        let (triples, _) = self.clipped.as_chunks::<3>();
        self.triangles.extend(triples);
        if self.triangles.iter().map(|t| self.area(*t)).sum::<f64>() < 0.0 {
            self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        self.restore_passed_over()
            && self.triangles.len() == count - 2
            && (self.covered() - area).abs() <= ROUNDING * area
    }

    /// The area of all triangles together, whichever way they turn.
    fn covered(&self) -> f64 {
        self.triangles.iter().map(|t| self.area(*t).abs()).sum()
    }

    /// Divides triangles at the corners that lie on one of their sides, which clipping passes over:
    /// a neighbour has them as corners too, and would not be joined otherwise.
    fn restore_passed_over(&mut self) -> bool {
        let count = self.flat.len();
        let mut is_used = vec![false; count];
        for &corner in self.triangles.iter().flatten() {
            is_used[corner] = true;
        }
        if is_used.iter().all(|used| *used) {
            return true;
        }
        let Some(start) = is_used.iter().position(|used| *used) else {
            return false;
        };
        let mut triangle_at: HashMap<[usize; 2], usize> = HashMap::new();
        for (i, [a, b, c]) in self.triangles.iter().copied().enumerate() {
            triangle_at.extend([([a, b], i), ([b, c], i), ([c, a], i)]);
        }
        let mut from = start;
        let mut passed_over = Vec::new();
        for corner in (start + 1..=start + count).map(|i| i % count) {
            if !is_used[corner] {
                passed_over.push(corner);
                continue;
            }
            if !passed_over.is_empty() {
                let Some(&whole) = triangle_at.get(&[from, corner]) else {
                    return false;
                };
                let side = [from, corner];
                let Some(&opposite) = self.triangles[whole].iter().find(|c| !side.contains(c))
                else {
                    return false;
                };
                // From the far end, so that the first piece takes the place of the whole.
                let mut end = corner;
                for &middle in passed_over.iter().rev() {
                    triangle_at.insert([end, opposite], self.triangles.len());
                    self.triangles.push([middle, end, opposite]);
                    end = middle;
                }
                self.triangles[whole] = [from, end, opposite];
                passed_over.clear();
            }
            from = corner;
        }
        true
    }

    /// Twice as large as it is would do as well.
    fn area(&self, triangle: [usize; 3]) -> f64 {
        let [a, b, c] = triangle.map(|i| self.flat[i]);
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
    }
}
