//! The planners' names, and what planners look like in results.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde::{Serialize, Serializer};
use thiserror::Error as ThisError;

/// The name of a planner in files, on the command line and in results: letters, digits, `_` and `-`, a letter first, 31 at
/// most.
///
/// Any program may have planners of its own, so that a name by itself says only how a planner is called; which there are
/// is known by a registry.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct PlannerName {
    bytes: [u8; Self::LONGEST],
    length: u8,
}

/// A text that cannot be the name of a planner.
#[derive(Debug, Clone, PartialEq, Eq, ThisError)]
#[error("{0:?} is no name of a planner; write up to 31 letters, digits, _ and -, a letter first")]
pub struct BadPlannerName(String);

impl PlannerName {
    const LONGEST: usize = 31;

    /// The same control at every step.
    pub const PREDETERMINED: Self = Self::literal("predetermined");
    /// Greedy: the smallest trace of the covariance, section III-B.
    pub const LOCAL: Self = Self::literal("local");
    /// Through viewpoints that see everything, section III-C.
    pub const GLOBAL: Self = Self::literal("global");
    /// Both, section III-D.
    pub const COMBINED: Self = Self::literal("combined");

    /// The paper's, in the order of its tables.
    pub const PAPER: [Self; 4] = [
        Self::PREDETERMINED,
        Self::LOCAL,
        Self::GLOBAL,
        Self::COMBINED,
    ];

    /// The name, known when the program is written.
    ///
    /// # Panics
    /// If it is no name; in a constant, that ends the compilation.
    #[must_use]
    #[allow(clippy::panic, reason = "in a constant it ends the compilation")]
    pub const fn literal(name: &'static str) -> Self {
        match Self::checked(name) {
            Some(name) => name,
            None => {
                panic!("a planner's name has up to 31 letters, digits, _ and -, a letter first")
            }
        }
    }

    /// The name that `text` is.
    ///
    /// # Errors
    /// Where it is none.
    pub fn new(text: &str) -> Result<Self, BadPlannerName> {
        Self::checked(text).ok_or_else(|| BadPlannerName(text.to_owned()))
    }

    const fn checked(text: &str) -> Option<Self> {
        let given = text.as_bytes();
        if given.is_empty() || given.len() > Self::LONGEST || !given[0].is_ascii_alphabetic() {
            return None;
        }
        let mut bytes = [0; Self::LONGEST];
        let mut i = 0;
        while i < given.len() {
            if !(given[i].is_ascii_alphanumeric() || given[i] == b'_' || given[i] == b'-') {
                return None;
            }
            bytes[i] = given[i];
            i += 1;
        }
        Some(Self {
            bytes,
            // It is at most 31.
            #[allow(clippy::cast_possible_truncation)]
            length: given.len() as u8,
        })
    }

    /// As text.
    #[must_use]
    pub fn as_str(&self) -> &str {
        // ASCII, as it was checked.
        std::str::from_utf8(&self.bytes[..usize::from(self.length)]).unwrap_or_default()
    }

    /// The paper's planners first, in the order of its tables.
    fn rank(self) -> usize {
        let place = Self::PAPER.iter().position(|known| *known == self);
        place.unwrap_or(Self::PAPER.len())
    }
}

/// The paper's planners in the order of its tables, then others by their names.
impl Ord for PlannerName {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.rank(), self.as_str()).cmp(&(other.rank(), other.as_str()))
    }
}

impl PartialOrd for PlannerName {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Debug for PlannerName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl fmt::Display for PlannerName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

impl Serialize for PlannerName {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.as_str())
    }
}

impl<'de> Deserialize<'de> for PlannerName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameVisitor;

        // The text is checked in here, where an error still gets its place.
        impl Visitor<'_> for NameVisitor {
            type Value = PlannerName;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the name of a planner in quotes, such as \"combined\"")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<PlannerName, E> {
                PlannerName::new(text).map_err(E::custom)
            }
        }

        deserializer.deserialize_str(NameVisitor)
    }
}

/// Which planners there are is for a registry to say.
impl JsonSchema for PlannerName {
    fn schema_name() -> Cow<'static, str> {
        "PlannerName".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string" })
    }
}

/// What a planner looks like in figures, replays and pages.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannerLook {
    /// What it is called there.
    pub label: String,
    /// Its colour: red, green, blue.
    pub colour: [u8; 3],
}

impl PlannerLook {
    /// With a label and a colour.
    #[must_use]
    pub fn new(label: &str, colour: [u8; 3]) -> Self {
        Self {
            label: label.to_owned(),
            colour,
        }
    }

    /// That of a planner of which nothing but the name is known. The paper's have colours of Okabe and Ito, which can be
    /// distinguished without colour vision.
    #[must_use]
    pub fn of(name: PlannerName) -> Self {
        let (label, colour) = match name {
            PlannerName::PREDETERMINED => ("Predetermined", [0x99, 0x99, 0x99]),
            PlannerName::LOCAL => ("Local", [0xd5, 0x5e, 0x00]),
            PlannerName::GLOBAL => ("Global", [0x00, 0x72, 0xb2]),
            PlannerName::COMBINED => ("Combined", [0x00, 0x9e, 0x73]),
            _ => (name.as_str(), [0xcc, 0x79, 0xa7]),
        };
        Self::new(label, colour)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_kept_as_it_is_given() {
        for text in ["local", "a", "tour_2", "Next-best", &"x".repeat(31)] {
            assert_eq!(PlannerName::new(text).unwrap().to_string(), text);
            let json = serde_json::to_string(&PlannerName::new(text).unwrap()).unwrap();
            assert_eq!(json, format!("{text:?}"));
            let read: PlannerName = serde_json::from_str(&json).unwrap();
            assert_eq!(read.as_str(), text);
        }
        for text in ["", "2nd", "a.b", "a b", "σ", &"x".repeat(32)] {
            assert!(PlannerName::new(text).is_err(), "{text}");
            assert!(serde_json::from_str::<PlannerName>(&format!("{text:?}")).is_err());
        }
    }

    #[test]
    fn the_papers_planners_come_first() {
        let mut names = [
            "tour",
            "combined",
            "abc",
            "predetermined",
            "global",
            "local",
        ]
        .map(PlannerName::literal);
        names.sort();
        let sorted = names.map(|name| name.to_string());
        assert_eq!(
            sorted,
            [
                "predetermined",
                "local",
                "global",
                "combined",
                "abc",
                "tour"
            ]
        );
    }
}
