//! Binary numbers of 400 bits, about 120 digits.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Sub};

use num_bigint::BigInt;
use num_traits::float::FloatCore;
use num_traits::{Signed, ToPrimitive, Zero};

/// Bits of a mantissa.
const BITS: u64 = 400;

/// `mantissa` · 2^`exponent`, cut off to [`BITS`] bits by every operation.
#[derive(Clone, Debug)]
pub struct Float {
    mantissa: BigInt,
    exponent: i64,
}

impl Float {
    pub fn zero() -> Self {
        Self::cut(BigInt::zero(), 0)
    }

    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    pub fn is_positive(&self) -> bool {
        self.mantissa.is_positive()
    }

    fn cut(mantissa: BigInt, exponent: i64) -> Self {
        let more = mantissa.bits().saturating_sub(BITS);
        Self {
            mantissa: mantissa >> more,
            exponent: exponent + i64::try_from(more).expect("few bits"),
        }
    }

    /// To double precision, within one unit of the last place.
    pub fn to_f64(&self) -> f64 {
        let more = self.mantissa.bits().saturating_sub(64);
        let leading = (&self.mantissa >> more).to_f64().expect("a number");
        let exponent = self.exponent + i64::try_from(more).expect("few bits");
        // In halves, as 2^exponent itself may be out of range.
        let half = i32::try_from(exponent / 2).expect("no extreme number");
        let other = i32::try_from(exponent - exponent / 2).expect("no extreme number");
        leading * 2_f64.powi(half) * 2_f64.powi(other)
    }
}

impl From<f64> for Float {
    /// Exactly.
    fn from(x: f64) -> Self {
        assert!(x.is_finite(), "{x}");
        let (mantissa, exponent, sign) = x.integer_decode();
        Self::cut(BigInt::from(mantissa) * sign, i64::from(exponent))
    }
}

impl Add for &Float {
    type Output = Float;

    fn add(self, other: Self) -> Float {
        let (low, high) = match self.exponent.cmp(&other.exponent) {
            Ordering::Less | Ordering::Equal => (self, other),
            Ordering::Greater => (other, self),
        };
        if high.is_zero() {
            return low.clone();
        }
        let apart = u64::try_from(high.exponent - low.exponent).expect("in this order");
        // Beyond that the lower one is not seen.
        if low.is_zero() || apart > 2 * BITS {
            return high.clone();
        }
        Float::cut((&high.mantissa << apart) + &low.mantissa, low.exponent)
    }
}

impl Sub for &Float {
    type Output = Float;

    fn sub(self, other: Self) -> Float {
        let negative = Float {
            mantissa: -&other.mantissa,
            exponent: other.exponent,
        };
        self + &negative
    }
}

impl Mul for &Float {
    type Output = Float;

    fn mul(self, other: Self) -> Float {
        let mantissa = &self.mantissa * &other.mantissa;
        Float::cut(mantissa, self.exponent + other.exponent)
    }
}

impl Div for &Float {
    type Output = Float;

    fn div(self, other: Self) -> Float {
        let shift = BITS + other.mantissa.bits();
        let mantissa = (&self.mantissa << shift) / &other.mantissa;
        let shift = i64::try_from(shift).expect("few bits");
        Float::cut(mantissa, self.exponent - other.exponent - shift)
    }
}
