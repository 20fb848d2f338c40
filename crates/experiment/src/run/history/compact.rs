//! Numbers and lists as a history stores them: few characters, no detail that a drawing shows lost.

use nalgebra::{Matrix3, Vector3};
use serde::Serializer;

use crate::scenario::{Named, PlannerName};

/// `value` to so many decimals. Numbers so large that they have no decimals stay as they are.
pub(super) fn decimals(value: f64, count: i32) -> f64 {
    let scale = 10f64.powi(count);
    let scaled = value * scale;
    if scaled.abs() < 9e15 {
        // Adding 0 makes −0 into 0.
        scaled.round() / scale + 0.0
    } else {
        value
    }
}

/// `value` to so many significant digits.
pub(super) fn digits(value: f64, count: i32) -> f64 {
    decimals(value, count - magnitude(value))
}

/// How many digits `value` has before the decimal point; negative for small ones.
fn magnitude(value: f64) -> i32 {
    let exponent = value.abs().log10().floor() + 1.0;
    // Outside these bounds powers of ten are not numbers; the cast is exact within them.
    #[allow(clippy::cast_possible_truncation)]
    if exponent.is_finite() {
        exponent.clamp(-290.0, 290.0) as i32
    } else {
        0
    }
}

/// A length in cm or an angle in rad, to 10⁻⁵.
pub(super) fn fine(value: f64) -> f64 {
    decimals(value, 5)
}

/// A vector to 10⁻⁵.
pub(super) fn vector(v: &Vector3<f64>) -> [f64; 3] {
    [fine(v.x), fine(v.y), fine(v.z)]
}

/// A vector to 10⁻⁴.
pub(super) fn coarse(v: &Vector3<f64>) -> [f64; 3] {
    [decimals(v.x, 4), decimals(v.y, 4), decimals(v.z, 4)]
}

/// The six different entries of a covariance, to four digits of the largest.
pub(super) fn covariance(m: &Matrix3<f64>) -> [f64; 6] {
    let places = 4 - magnitude(m.amax());
    [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|at| decimals(m[at], places))
}

/// A planner by its name.
pub(super) fn planner<S: Serializer>(name: &PlannerName, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(name.as_str())
}

/// Ascending numbers as runs: first, length, first, length, …
pub(super) mod ranges {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// More numbers than any action set has; a file that claims more is wrong.
    const MOST: usize = 1_000_000;

    pub(in super::super) fn serialize<S: Serializer>(
        numbers: &[usize],
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let mut runs: Vec<usize> = Vec::new();
        let mut next = None;
        for &number in numbers {
            match runs.last_mut() {
                Some(length) if next == Some(number) => *length += 1,
                _ => runs.extend([number, 1]),
            }
            next = number.checked_add(1);
        }
        runs.serialize(to)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Vec<usize>, D::Error> {
        let runs = Vec::<usize>::deserialize(from)?;
        let (pairs, rest) = runs.as_chunks::<2>();
        let total = pairs.iter().try_fold(0usize, |sum, [first, length]| {
            first.checked_add(*length)?;
            sum.checked_add(*length).filter(|sum| *sum <= MOST)
        });
        if !rest.is_empty() || total.is_none() {
            return Err(D::Error::custom("runs of scored actions that make no list"));
        }
        Ok(pairs
            .iter()
            .flat_map(|&[first, length]| first..first + length)
            .collect())
    }
}
