//! Many segments from one place at once: lines of sight, and ways to go.
//!
//! Seen from the place, a segment passes through a face if it lies on the same side of the three
//! planes through the place and an edge, and reaches the face's plane. All of it follows from one
//! product for each edge and segment. Where that product stands out of its own rounding, its sign is
//! the exact one; the few cases that do not are left to the exact predicates, so the answers
//! are those of [`Surface::sees`] and [`Surface::crosses`], to the last one.

use nalgebra::{Point3, Vector3};
use pulp::{Simd, WithSimd};

use crate::predicates::segment_touches_triangle;
use crate::spatial::Bounds;
use crate::{Surface, is_usable};

type Point = Point3<f64>;

/// Bound on the rounding of the sum of four determinants of differences of points, in units of the
/// cube of the largest coordinate among these: each has six products of three factors, which leaves
/// less than 100 ε.
const ROUNDING: f64 = 512.0 * f64::EPSILON;

/// Segments that are looked at together; lists are filled up to a multiple of it.
const LANES: usize = 8;

/// Room for the segments from one place, kept from place to place.
#[derive(Clone, Debug, Default)]
pub struct Fan {
    /// The segments not known to be blocked: the numbers of their ends.
    open: Vec<usize>,
    /// Their ends, from the place, one axis after the other.
    ends: [Vec<f64>; 3],
    /// How clearly each passes through the face at hand.
    clearness: Vec<f64>,
    /// The surface's points, from the place.
    points: Vec<Vector3<f64>>,
}

impl Fan {
    /// Of the surface points numbered in `targets`, those to which a sensor at `sensor` (world, cm)
    /// has a line of sight, in any order: as [`Surface::sees`] says for each. Allocates only when a fan
    /// has more segments than any before it.
    pub fn seen(
        &mut self,
        surface: &Surface,
        sensor: &Point,
        targets: impl IntoIterator<Item = usize>,
    ) -> &[usize] {
        let points = surface.points();
        self.open.clear();
        if is_usable(sensor) {
            self.open
                .extend(targets.into_iter().filter(|&i| i < points.len()));
        } else {
            let here = |&i: &usize| points.get(i) == Some(sensor);
            self.open.extend(targets.into_iter().filter(here));
            return &self.open;
        }
        self.block(surface, sensor, points, |corners, id| {
            corners.contains(&id) || points[id] == *sensor
        });
        &self.open
    }

    /// Of the `ends` (world, cm) numbered in `targets` those that the straight way from `start` reaches
    /// without touching the surface, in any order: where [`Surface::crosses`] says no.
    pub fn free(
        &mut self,
        surface: &Surface,
        start: &Point,
        ends: &[Point],
        targets: impl IntoIterator<Item = usize>,
    ) -> &[usize] {
        self.open.clear();
        if is_usable(start) {
            let usable = |&i: &usize| ends.get(i).is_some_and(is_usable);
            self.open.extend(targets.into_iter().filter(usable));
        }
        self.block(surface, start, ends, |_, _| false);
        &self.open
    }

    /// Closes the segments that touch a face, but for the faces that are `exempt` for an end.
    fn block(
        &mut self,
        surface: &Surface,
        from: &Point,
        ends: &[Point],
        exempt: impl Fn(&[usize; 3], usize) -> bool,
    ) {
        if self.open.is_empty() {
            return;
        }
        let (around, rounding) = self.lay_out(surface, from, ends);
        let arch = pulp::Arch::new();
        for (face, numbers) in surface.topology().faces().iter().enumerate() {
            if self.open.is_empty() {
                return;
            }
            if !surface.boxes()[face].touch(&around) {
                continue;
            }
            let corners = surface.corners(face);
            let view = FaceView::of(numbers.map(|i| &self.points[i]), rounding);
            let most = arch.dispatch(WriteClearness {
                view: &view,
                ends: self.ends.each_ref().map(Vec::as_slice),
                clearness: &mut self.clearness,
            });
            if most < -rounding {
                continue;
            }
            self.close(|id, clearness| {
                clearness >= -rounding
                    && !exempt(numbers, id)
                    && (clearness > rounding || segment_touches_triangle(from, &ends[id], corners))
            });
        }
    }

    /// Lists the ends of the open segments and the surface's points as seen from `from`; the box round all
    /// segments, and the clearness beyond which, either way, there is no doubt.
    fn lay_out(&mut self, surface: &Surface, from: &Point, ends: &[Point]) -> (Bounds, f64) {
        let mut around = Bounds::of([from]);
        let mut size = 0.0_f64;
        let filled = self.open.len().next_multiple_of(LANES);
        for (axis, list) in self.ends.iter_mut().enumerate() {
            list.clear();
            list.extend(self.open.iter().map(|&id| ends[id][axis] - from[axis]));
            list.resize(filled, 0.0);
            size = list.iter().fold(size, |size, x| size.max(x.abs()));
        }
        for &id in &self.open {
            around.include(&ends[id]);
        }
        self.clearness.resize(filled, 0.0);
        self.points.clear();
        self.points
            .extend(surface.points().iter().map(|p| p - from));
        size = self.points.iter().fold(size, |size, v| size.max(v.amax()));
        // Products below the normal numbers lose digits; no doubt is resolved there.
        (around, ROUNDING * size * size * size + f64::MIN_POSITIVE)
    }

    /// Closes the open segments for which `touches` holds, given the number of the end and the clearness;
    /// the order of the others changes.
    fn close(&mut self, mut touches: impl FnMut(usize, f64) -> bool) {
        // From the end, so that what takes the place of a closed one has been looked at.
        for at in (0..self.open.len()).rev() {
            if touches(self.open[at], self.clearness[at]) {
                self.open.swap_remove(at);
                let last = self.open.len();
                for list in &mut self.ends {
                    list[at] = list[last];
                }
            }
        }
        let filled = self.open.len().next_multiple_of(LANES);
        for list in &mut self.ends {
            list.truncate(filled);
        }
        self.clearness.truncate(filled);
    }
}

/// A face as seen from a place.
struct FaceView {
    /// Normals of the planes through the place and an edge, pointing to where the face is; their
    /// products with the end of a segment are positive if it heads through the face.
    planes: [Vector3<f64>; 3],
    /// What the three products must add up to where the segment reaches the face's plane.
    volume: f64,
}

impl FaceView {
    /// `corners` from the place.
    fn of([a, b, c]: [&Vector3<f64>; 3], rounding: f64) -> Self {
        let planes = [a.cross(b), b.cross(c), c.cross(a)];
        let volume = planes[0].dot(c);
        if volume.abs() <= rounding {
            // Seen edge on: everything is in doubt.
            return Self {
                planes: [Vector3::zeros(); 3],
                volume: 0.0,
            };
        }
        Self {
            planes: planes.map(|normal| normal * volume.signum()),
            volume: volume.abs(),
        }
    }
}

/// Writes for each segment how clearly it passes through the face: negative where it does not, about
/// zero where it touches an edge, a corner or the plane. Gives the largest.
struct WriteClearness<'a> {
    view: &'a FaceView,
    /// The segments' ends, axis by axis; all lists are of the same length, a multiple of [`LANES`].
    ends: [&'a [f64]; 3],
    clearness: &'a mut [f64],
}

impl WithSimd for WriteClearness<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        // Written out: what is inlined into a closure would not be compiled for the vectors.
        let [a, b, c] = &self.view.planes;
        let [ax, ay, az] = [
            simd.splat_f64s(a.x),
            simd.splat_f64s(a.y),
            simd.splat_f64s(a.z),
        ];
        let [bx, by, bz] = [
            simd.splat_f64s(b.x),
            simd.splat_f64s(b.y),
            simd.splat_f64s(b.z),
        ];
        let [cx, cy, cz] = [
            simd.splat_f64s(c.x),
            simd.splat_f64s(c.y),
            simd.splat_f64s(c.z),
        ];
        let volume = simd.splat_f64s(self.view.volume);
        let x = S::as_simd_f64s(self.ends[0]).0;
        let y = S::as_simd_f64s(self.ends[1]).0;
        let z = S::as_simd_f64s(self.ends[2]).0;
        let out = S::as_mut_simd_f64s(self.clearness).0;
        let mut largest = simd.splat_f64s(f64::NEG_INFINITY);
        for (((&x, &y), &z), out) in x.iter().zip(y).zip(z).zip(out) {
            let u = simd.mul_add_f64s(ax, x, simd.mul_add_f64s(ay, y, simd.mul_f64s(az, z)));
            let v = simd.mul_add_f64s(bx, x, simd.mul_add_f64s(by, y, simd.mul_f64s(bz, z)));
            let w = simd.mul_add_f64s(cx, x, simd.mul_add_f64s(cy, y, simd.mul_f64s(cz, z)));
            let sum = simd.add_f64s(simd.add_f64s(u, v), w);
            let reach = simd.sub_f64s(sum, volume);
            *out = simd.min_f64s(simd.min_f64s(u, v), simd.min_f64s(w, reach));
            largest = simd.max_f64s(largest, *out);
        }
        simd.reduce_max_f64s(largest)
    }
}
