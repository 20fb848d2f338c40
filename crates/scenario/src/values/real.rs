//! Real numbers within bounds.

use std::borrow::Cow;
use std::f64::consts::PI;
use std::fmt;
use std::ops::{Deref, RangeInclusive};

use adslam_deformation::MAX_CLOCK_FACTOR;
use adslam_surface::{MAX_PHANTOM_SPACING_CM, MIN_PHANTOM_SPACING_CM};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;
use serde::de::{Deserialize, Deserializer, Error, Visitor};

use super::ValueError;

/// No number in a file may be larger than this: a world of ten kilometres, a thousand times what a
/// robot of this kind meets, and far from where squares and sums lose their meaning.
pub const LARGEST: f64 = 1e6;

/// No number that has to be positive may be smaller than this, so that its square is no zero.
pub const SMALLEST: f64 = 1e-9;

/// A finite number of at most a million either way.
fn finite(value: f64, remedy: &str) -> Result<f64, ValueError> {
    if value.is_nan() {
        Err(ValueError::new("nan is not a number", remedy))
    } else if value.is_infinite() {
        Err(ValueError::new(
            format!("{value} is not a finite number"),
            remedy,
        ))
    } else if value.abs() > LARGEST {
        Err(ValueError::new(
            format!("{value} is out of any sensible range"),
            remedy,
        ))
    } else {
        Ok(value)
    }
}

/// A number type: its range, whether 0 is allowed beside that, what a file should have there, and what
/// is said of a finite number out of range.
macro_rules! number {
    ($(#[$doc:meta])* $name:ident, $range:expr, or_zero: $or_zero:literal, $expects:literal, $problem:literal) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize)]
        pub struct $name(f64);

        impl $name {
            const RANGE: RangeInclusive<f64> = $range;

            /// The value, if it is allowed.
            ///
            /// # Errors
            /// When it is not; the error says why and what to write.
            pub fn new(value: f64) -> Result<Self, ValueError> {
                const REMEDY: &str = concat!("write ", $expects);
                let value = finite(value, REMEDY)?;
                if Self::RANGE.contains(&value) || ($or_zero && value == 0.0) {
                    Ok(Self(value))
                } else {
                    Err(ValueError::new(format!(concat!("{} ", $problem), value), REMEDY))
                }
            }
        }

        impl Deref for $name {
            type Target = f64;

            fn deref(&self) -> &f64 {
                &self.0
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any(NumberVisitor { expects: $expects, new: Self::new })
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                let minimum = if $or_zero { 0.0 } else { *Self::RANGE.start() };
                json_schema!({ "type": "number", "minimum": minimum, "maximum": Self::RANGE.end() })
            }
        }
    };
}

number!(
    /// Any number, up to [`LARGEST`] either way.
    Finite,
    -LARGEST..=LARGEST,
    or_zero: false,
    "a number between -1000000 and 1000000",
    "is no number"
);
number!(
    /// A number above zero (at least [`SMALLEST`]).
    Positive,
    SMALLEST..=LARGEST,
    or_zero: false,
    "a number above 0, such as 0.5",
    "is not above 0"
);
number!(
    /// Zero or a [`Positive`] number.
    NonNegative,
    SMALLEST..=LARGEST,
    or_zero: true,
    "0 or a number above it, such as 0.02",
    "is below 0, or too near to it"
);
number!(
    /// The sigma of an angle in radians: 0, or up to half a turn.
    AngleSigma,
    SMALLEST..=PI,
    or_zero: true,
    "0 or a number of radians up to 3.14, such as 0.02 (1 degree is 0.01745)",
    "is below 0, or more than half a turn"
);
number!(
    /// A part of a whole: above 0, at most 1.
    Fraction,
    SMALLEST..=1.0,
    or_zero: false,
    "a number above 0 and up to 1, such as 0.1",
    "is no fraction"
);
number!(
    /// A probability that is neither impossible nor certain.
    GateProbability,
    SMALLEST..=1.0 - SMALLEST,
    or_zero: false,
    "a number above 0 and below 1, such as 0.999",
    "is not between 0 and 1"
);
number!(
    /// How likely something is: 0 to 1.
    Probability,
    SMALLEST..=1.0,
    or_zero: true,
    "a probability from 0 to 1, such as 0.05",
    "is no probability"
);
number!(
    /// How many times as fast a motion runs: 0 to [`MAX_CLOCK_FACTOR`].
    ClockFactor,
    SMALLEST..=MAX_CLOCK_FACTOR,
    or_zero: true,
    "a number from 0 to 1000, such as 1.1",
    "is no sensible speed"
);
number!(
    /// Where a Gaussian is cut off, in multiples of its sigma: 0.5 to 100. Below that the rest has
    /// little in common with a Gaussian, and drawing from it by rejection takes long.
    Truncation,
    0.5..=100.0,
    or_zero: false,
    "a number of sigmas between 0.5 and 100, such as 2.0",
    "is no sensible number of sigmas"
);
number!(
    /// Distance between the vertices of the heart phantom, within what
    /// [`heart_phantom`](adslam_surface::heart_phantom) takes.
    Spacing,
    MIN_PHANTOM_SPACING_CM..=MAX_PHANTOM_SPACING_CM,
    or_zero: false,
    "a distance between 0.2 and 0.6 cm, such as 0.4",
    "cm is no sensible distance between vertices"
);

macro_rules! default_of {
    ($($name:ident),+) => {
        $(impl $name {
            /// A default, whose validity is in plain sight.
            pub const fn default_of(value: f64) -> Self {
                Self(value)
            }
        })+
    };
}

default_of!(Finite, NonNegative, Probability, ClockFactor, Spacing);

impl Default for NonNegative {
    /// Zero.
    fn default() -> Self {
        Self::default_of(0.0)
    }
}

macro_rules! degrees {
    ($($name:ident),+) => {
        $(impl $name {
            /// The number, taken as degrees, in radians.
            pub fn degrees_in_rad(self) -> f64 {
                self.0.to_radians()
            }
        })+
    };
}

degrees!(Finite, NonNegative);

/// Reads integers and floats alike. The value is checked in here, where an error still gets its
/// place.
struct NumberVisitor<T> {
    expects: &'static str,
    new: fn(f64) -> Result<T, ValueError>,
}

impl<T> Visitor<'_> for NumberVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.expects)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<T, E> {
        (self.new)(value).map_err(E::custom)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<T, E> {
        self.visit_f64(value as f64)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<T, E> {
        self.visit_f64(value as f64)
    }

    fn visit_i128<E: Error>(self, value: i128) -> Result<T, E> {
        self.visit_f64(value as f64)
    }

    fn visit_u128<E: Error>(self, value: u128) -> Result<T, E> {
        self.visit_f64(value as f64)
    }
}
