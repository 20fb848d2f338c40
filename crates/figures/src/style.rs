//! What is the same in every figure: colours, strokes and sizes. Lengths are CSS pixels, 96 to the
//! inch; a figure of 688 px is as wide as a page of two columns (182 mm).

use std::fmt;

/// The width of a figure across both columns, px.
pub(crate) const FULL_WIDTH: f64 = 688.0;

/// The size of text, px: 8 pt at the full width.
pub(crate) const TEXT: f64 = 10.67;

/// The size of numbers at ticks and of text inside panels, px: 7 pt.
pub(crate) const SMALL_TEXT: f64 = 9.33;

/// A colour of the sRGB space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Colour(pub u8, pub u8, pub u8);

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

pub(crate) const INK: Colour = Colour(0x22, 0x22, 0x22);
pub(crate) const AXIS: Colour = Colour(0x55, 0x55, 0x55);
pub(crate) const GRID: Colour = Colour(0xe4, 0xe4, 0xe4);
/// The colour of the object's surface before it is shaded.
pub(crate) const SURFACE: Colour = Colour(0xa9, 0xc7, 0xde);
pub(crate) const SURFACE_EDGE: Colour = Colour(0x4c, 0x68, 0x80);
/// The band between two bounds.
pub(crate) const BAND: Colour = Colour(0xbb, 0xbb, 0xbb);

/// A line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stroke {
    pub colour: Colour,
    pub width: f64,
    /// Lengths of dash and gap; none for a solid line.
    pub dash: Option<(f64, f64)>,
}

impl Stroke {
    pub(crate) const fn solid(colour: Colour, width: f64) -> Self {
        let dash = None;
        Self {
            colour,
            width,
            dash,
        }
    }

    pub(crate) const fn dashed(colour: Colour, width: f64, dash: (f64, f64)) -> Self {
        let dash = Some(dash);
        Self {
            colour,
            width,
            dash,
        }
    }
}

/// The drift floor.
pub(crate) const FLOOR: Stroke = Stroke::dashed(INK, 0.9, (0.9, 1.9));
