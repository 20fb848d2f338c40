//! Angles on the circle.

use std::f64::consts::{PI, TAU};

/// The angle equal to `angle` modulo 2π in (−π, π], in radians.
///
/// Non-finite input gives NaN.
#[must_use]
pub fn wrap_angle(angle: f64) -> f64 {
    // Already wrapped angles must come back unchanged to the last bit.
    if angle > -PI && angle <= PI {
        return angle;
    }
    let wrapped = angle.rem_euclid(TAU);
    if wrapped > PI { wrapped - TAU } else { wrapped }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_ends_of_the_interval() {
        assert_eq!(wrap_angle(PI), PI);
        assert_eq!(wrap_angle(-PI), PI);
        assert_eq!(wrap_angle(0.0), 0.0);
        assert_eq!(wrap_angle(-1e-20), -1e-20, "to the last bit");
        assert!(wrap_angle(f64::INFINITY).is_nan());
    }

    proptest! {
        #[test]
        fn is_in_range_and_congruent(angle in -1e3..1e3) {
            let wrapped = wrap_angle(angle);
            prop_assert!(wrapped > -PI && wrapped <= PI);
            prop_assert!((wrapped.sin() - angle.sin()).abs() < 1e-12);
            prop_assert!((wrapped.cos() - angle.cos()).abs() < 1e-12);
        }
    }
}
