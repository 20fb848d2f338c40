//! Numbers and lists as a history stores them: few characters, no detail that a drawing shows lost.

use nalgebra::{Matrix3, Vector3};

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_keeps_what_it_says() {
        assert_eq!(decimals(-0.000_001, 5).to_string(), "0");
        assert_eq!(digits(123.456_789, 4), 123.5);
        assert_eq!(digits(0.000_123_456, 2), 0.000_12);
        assert_eq!(digits(0.0, 3), 0.0);
        assert_eq!(decimals(1e300, 5), 1e300);
        assert!(digits(f64::MIN_POSITIVE, 3) >= 0.0);
        assert!(digits(f64::NAN, 3).is_nan());
    }
}
