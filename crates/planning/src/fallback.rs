//! What the robot does where no action is safe.

use adslam_surface::Surface;
use nalgebra::Point3;

use crate::{Candidate, ties};

/// Part of a way to which its last touch is found.
const RESOLUTION: f64 = 1e-9;

/// Chooses where no action is safe; reuses its allocations.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fallback {
    ways: Vec<Way>,
}

/// How good a way is: first what it crosses, then how far from the surfaces it ends.
#[derive(Clone, Copy, Debug)]
struct Way {
    crossing: Crossing,
    /// Signed distance of the end from the nearer surface, cm.
    clearance: f64,
    /// The numbers that the clearance is a difference of, cm.
    scale: f64,
}

/// What a way crosses, the worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Crossing {
    /// A surface that the robot is outside of.
    Into,
    /// Only surfaces that the robot is inside of, but it does not lead out of them, or not straight.
    Within,
    /// Nothing, or only its way out.
    Nothing,
}

impl Fallback {
    /// The way that crosses least, and of those the one that ends farthest outside the `surfaces`; of equals the
    /// first, with `staying` last.
    pub(crate) fn choose<'a>(
        &mut self,
        start: &Point3<f64>,
        actions: &'a [Candidate],
        staying: &'a Candidate,
        surfaces: [&Surface; 2],
    ) -> &'a Candidate {
        let is_outside = surfaces.map(|surface| surface.signed_distance(start) > 0.0);
        self.ways.clear();
        self.ways.extend(actions.iter().map(|action| {
            let end = &action.pose.position;
            let crossing = surfaces
                .iter()
                .zip(is_outside)
                .map(|(surface, is_outside)| Crossing::of(surface, start, end, is_outside));
            Way::new(crossing.min().unwrap_or(Crossing::Into), end, surfaces)
        }));
        let of_staying = if is_outside == [true; 2] {
            Crossing::Nothing
        } else {
            Crossing::Within
        };
        self.ways.push(Way::new(of_staying, start, surfaces));

        let best = self.ways.iter().copied().reduce(Way::better);
        let place = best.and_then(|best| self.ways.iter().position(|way| way.equals(&best)));
        place.and_then(|i| actions.get(i)).unwrap_or(staying)
    }
}

impl Crossing {
    fn of(surface: &Surface, start: &Point3<f64>, end: &Point3<f64>, is_outside: bool) -> Self {
        match is_outside {
            // Who stays in place crosses nothing, but a segment of no length may lie on a face.
            true if start != end && surface.crosses(start, end) => Self::Into,
            false if !leads_out(surface, start, end) => Self::Within,
            _ => Self::Nothing,
        }
    }
}

/// Whether a way from within ends outside and, once it is outside, stays there.
fn leads_out(surface: &Surface, start: &Point3<f64>, end: &Point3<f64>) -> bool {
    // Not so where the distance is no number either.
    let ends_outside = surface.signed_distance(end) > 0.0;
    if !ends_outside {
        return false;
    }
    // From `free` on nothing is touched any more; up to `touched` there is something to come.
    let (mut touched, mut free) = (0.0, 1.0);
    let at = |part: f64| start + (end - start) * part;
    while free - touched > RESOLUTION {
        let middle = 0.5 * (touched + free);
        if surface.crosses(&at(middle), end) {
            touched = middle;
        } else {
            free = middle;
        }
    }
    // The last touch may be at `touched` itself.
    let before = touched - RESOLUTION;
    before <= 0.0 || !surface.crosses(start, &at(before))
}

impl Way {
    fn new(crossing: Crossing, end: &Point3<f64>, surfaces: [&Surface; 2]) -> Self {
        let [now, after] = surfaces.map(|surface| surface.signed_distance(end));
        let clearance = now.min(after);
        Self {
            crossing,
            // What is no number is no clearance.
            clearance: if clearance.is_nan() {
                f64::NEG_INFINITY
            } else {
                clearance
            },
            scale: end.coords.norm(),
        }
    }

    fn better(self, other: Self) -> Self {
        let order = self
            .crossing
            .cmp(&other.crossing)
            .then(self.clearance.total_cmp(&other.clearance));
        if order.is_lt() { other } else { self }
    }

    /// Whether it is as good as the best.
    fn equals(&self, best: &Self) -> bool {
        let rounding = ties::TOLERANCE * (best.clearance.abs() + best.scale);
        self.crossing == best.crossing
            && (self.clearance == best.clearance || self.clearance >= best.clearance - rounding)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clearances_are_equal_up_to_the_rounding_of_what_they_are_differences_of() {
        let way = |clearance, scale| Way {
            crossing: Crossing::Nothing,
            clearance,
            scale,
        };
        let equals = |clearance, scale| way(1.0 - clearance, 0.0).equals(&way(1.0, scale));
        assert!(equals(1.5 * ties::TOLERANCE, 1.0));
        assert!(!equals(3.0 * ties::TOLERANCE, 1.0));
        assert!(equals(7.0 * ties::TOLERANCE, 7.0));
        assert!(!equals(7.0 * ties::TOLERANCE, 1.0));
        for none in [f64::INFINITY, f64::NEG_INFINITY] {
            assert!(way(none, 1.0).equals(&way(none, 1.0)), "{none}");
        }
        let worse = Way {
            crossing: Crossing::Within,
            ..way(1.0, 1.0)
        };
        assert!(!worse.equals(&way(1.0, 1.0)));
    }
}
