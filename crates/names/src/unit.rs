//! Units of length.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Named;

/// The unit of a mesh file's coordinates.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LengthUnit {
    /// Millimetres, which medical images use.
    #[default]
    Mm,
    /// Centimetres.
    Cm,
    /// Metres.
    M,
}

impl Named for LengthUnit {
    const KIND: &'static str = "unit of length";
    const ALL: &'static [Self] = &[Self::Mm, Self::Cm, Self::M];

    fn as_str(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::M => "m",
        }
    }
}

impl LengthUnit {
    /// Centimetres in one of this unit.
    pub fn in_cm(self) -> f64 {
        match self {
            Self::Mm => 0.1,
            Self::Cm => 1.0,
            Self::M => 100.0,
        }
    }
}

impl fmt::Display for LengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}
