//! Whole numbers within bounds.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;
use serde::de::{Deserialize, Deserializer, Error, Visitor};

use super::ValueError;

/// A whole number from `MIN` to `MAX`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Count<const MIN: u64, const MAX: u64>(u64);

/// Steps of a run.
pub type Steps = Count<1, 1_000_000>;
/// Features of an object: four make a body; the covariance of 2000 takes 0.3 GB.
pub type FeatureCount = Count<4, 2_000>;
/// The number of a feature, from 0.
pub type FeatureNumber = Count<0, 1_999>;
/// How many times, or how many things.
pub type Many = Count<1, 1_000_000>;
/// The seed of random numbers (TOML has no larger integers).
pub type Seed = Count<0, { i64::MAX as u64 }>;

impl<const MIN: u64, const MAX: u64> Count<MIN, MAX> {
    /// The number, if it is in range.
    ///
    /// # Errors
    /// When it is not; the error names the range.
    pub fn new(value: u64) -> Result<Self, ValueError> {
        Self::checked(i128::from(value))
    }

    fn checked(value: i128) -> Result<Self, ValueError> {
        u64::try_from(value)
            .ok()
            .filter(|value| (MIN..=MAX).contains(value))
            .map(Self)
            .ok_or_else(|| {
                let problem = if value < i128::from(MIN) {
                    "too small"
                } else {
                    "too large"
                };
                ValueError::new(
                    format!("{value} is {problem}"),
                    format!("write {}", Self::range()),
                )
            })
    }

    fn range() -> String {
        format!("a whole number from {MIN} to {MAX}")
    }

    /// A default, whose validity is in plain sight.
    pub const fn default_of(value: u64) -> Self {
        Self(value)
    }

    /// The number, to count or to index with.
    pub fn get(self) -> usize {
        usize::try_from(self.0).unwrap_or(usize::MAX)
    }

    /// The number, to seed with.
    pub fn as_u64(self) -> u64 {
        self.0
    }
}

impl<'de, const MIN: u64, const MAX: u64> Deserialize<'de> for Count<MIN, MAX> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct CountVisitor<const MIN: u64, const MAX: u64>;

        // The number is checked in here, where an error still gets its place.
        impl<const MIN: u64, const MAX: u64> Visitor<'_> for CountVisitor<MIN, MAX> {
            type Value = Count<MIN, MAX>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&Count::<MIN, MAX>::range())
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
                self.visit_i128(value.into())
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
                self.visit_i128(value.into())
            }

            fn visit_i128<E: Error>(self, value: i128) -> Result<Self::Value, E> {
                Count::checked(value).map_err(E::custom)
            }
        }

        deserializer.deserialize_any(CountVisitor::<MIN, MAX>)
    }
}

impl<const MIN: u64, const MAX: u64> JsonSchema for Count<MIN, MAX> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Count_{MIN}_to_{MAX}").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "minimum": MIN, "maximum": MAX })
    }
}
