//! The drawing backend: SVG in tenths of a pixel, with dashes, round joins and groups of one opacity.

use std::convert::Infallible;
use std::fmt::{self, Display, Write};

use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{FontTransform, TextStyle};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
};

use crate::style::{Colour, Stroke};

/// Backend units to a pixel. Backends count in whole units, so a unit is the precision.
const UNITS_PER_PX: f64 = 10.0;

/// Lengths in backend units.
#[allow(
    clippy::cast_possible_truncation,
    reason = "clamped to what fits, and NaN becomes 0"
)]
pub(crate) fn units(px: f64) -> i32 {
    (px * UNITS_PER_PX).round().clamp(-1e8, 1e8) as i32
}

/// The same where it cannot be negative.
pub(crate) fn size_in_units(px: f64) -> u32 {
    units(px).max(0).unsigned_abs()
}

/// Backend units as pixels.
pub(crate) fn px(units: i32) -> f64 {
    f64::from(units) / UNITS_PER_PX
}

/// A font of this size and colour for the plotting crate.
pub(crate) fn text_style<'a>(size: f64, colour: Colour) -> TextStyle<'a> {
    use plotters::style::IntoTextStyle;
    let font = ("sans-serif", size * UNITS_PER_PX);
    // A fixed size needs no parent to be relative to.
    let style = font.into_text_style(&(0, 0));
    TextStyle {
        color: BackendColor {
            alpha: 1.0,
            rgb: (colour.0, colour.1, colour.2),
        },
        ..style
    }
}

/// A backend that writes the elements of an SVG file into a string.
#[derive(Debug)]
pub(crate) struct Sheet<'a> {
    body: &'a mut String,
    size: (u32, u32),
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl<'a> Sheet<'a> {
    /// A sheet of so many pixels, empty.
    pub(crate) fn new(body: &'a mut String, width: f64, height: f64) -> Self {
        let size = (size_in_units(width), size_in_units(height));
        Self { body, size }
    }

    pub(crate) fn line(&mut self, points: &[BackendCoord], stroke: &Stroke) {
        if points.len() < 2 {
            return;
        }
        let path = Path(points, false);
        self.push(format_args!(
            r#"<path d="{path}" fill="none"{}/>"#,
            StrokeAttributes(stroke)
        ));
    }

    pub(crate) fn area(
        &mut self,
        points: &[BackendCoord],
        fill: Colour,
        opacity: f64,
        edge: Option<&Stroke>,
    ) {
        let (path, opacity) = (Path(points, true), Opacity(opacity));
        match edge {
            None => self.push(format_args!(r#"<path d="{path}" fill="{fill}"{opacity}/>"#)),
            Some(edge) => self.push(format_args!(
                r#"<path d="{path}" fill="{fill}"{opacity}{}/>"#,
                StrokeAttributes(edge)
            )),
        }
    }

    pub(crate) fn circle(
        &mut self,
        (x, y): BackendCoord,
        radius: f64,
        fill: Option<Colour>,
        edge: Option<&Stroke>,
    ) {
        let (x, y, r) = (Tenths(x), Tenths(y), Tenths(units(radius)));
        let mut attributes = String::new();
        let _ = match fill {
            Some(fill) => write!(attributes, r#" fill="{fill}""#),
            None => write!(attributes, r#" fill="none""#),
        };
        if let Some(edge) = edge {
            let _ = write!(attributes, "{}", StrokeAttributes(edge));
        }
        self.push(format_args!(
            r#"<circle cx="{x}" cy="{y}" r="{r}"{attributes}/>"#
        ));
    }

    /// Everything until the group ends is drawn opaque, and then laid on what is there as one.
    pub(crate) fn begin_group(&mut self, opacity: f64) {
        self.push(format_args!(r#"<g opacity="{}">"#, Short(opacity)));
    }

    pub(crate) fn end_group(&mut self) {
        self.push(format_args!("</g>"));
    }

    fn push(&mut self, element: fmt::Arguments<'_>) {
        // Writing to a string does not fail.
        let _ = writeln!(self.body, "{element}");
    }
}

impl DrawingBackend for Sheet<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, _: BackendCoord, _: BackendColor) -> Drawn {
        // Only rasterised text and bitmaps would come here, and a sheet draws text itself.
        Ok(())
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Drawn {
        self.line(&[from, to], &stroke_of(style));
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let points: Vec<BackendCoord> = path.into_iter().collect();
        self.line(&points, &stroke_of(style));
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> Drawn {
        let size = style.size();
        let anchor = match style.anchor().h_pos {
            HPos::Left => "start",
            HPos::Center => "middle",
            HPos::Right => "end",
        };
        // From the middle of its small letters, or the height of its capitals.
        let down = size
            * match style.anchor().v_pos {
                VPos::Top => 0.76,
                VPos::Center => 0.35,
                VPos::Bottom => -0.22,
            };
        let turned = match style.transform() {
            FontTransform::None => "",
            FontTransform::Rotate90 => " rotate(90)",
            FontTransform::Rotate180 => " rotate(180)",
            FontTransform::Rotate270 => " rotate(-90)",
        };
        let colour = colour_of(style.color());
        self.push(format_args!(
            r#"<text transform="translate({} {}){turned}" y="{}" font-size="{}" text-anchor="{anchor}" fill="{colour}">{}</text>"#,
            Tenths(x),
            Tenths(y),
            Short(down / UNITS_PER_PX),
            Short(size / UNITS_PER_PX),
            Escaped(text),
        ));
        Ok(())
    }
}

fn stroke_of(style: &impl BackendStyle) -> Stroke {
    let width = f64::from(style.stroke_width()) / UNITS_PER_PX;
    Stroke::solid(colour_of(style.color()), width)
}

fn colour_of(colour: BackendColor) -> Colour {
    let (r, g, b) = colour.rgb;
    Colour(r, g, b)
}

/// Backend units as a decimal number of pixels.
struct Tenths(i32);

impl Display for Tenths {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", px(self.0))
    }
}

/// A number with at most three decimals.
struct Short(f64);

impl Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", (self.0 * 1e3).round() / 1e3)
    }
}

/// Path data; closed or open.
struct Path<'a>(&'a [BackendCoord], bool);

impl Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, &(x, y)) in self.0.iter().enumerate() {
            let command = if i == 0 { "M" } else { "L" };
            write!(f, "{command}{} {}", Tenths(x), Tenths(y))?;
        }
        f.write_str(if self.1 { "Z" } else { "" })
    }
}

struct Opacity(f64);

impl Display for Opacity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 < 1.0 {
            write!(f, r#" fill-opacity="{}""#, Short(self.0))?;
        }
        Ok(())
    }
}

struct StrokeAttributes<'a>(&'a Stroke);

impl Display for StrokeAttributes<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stroke {
            colour,
            width,
            dash,
        } = self.0;
        write!(f, r#" stroke="{colour}" stroke-width="{}""#, Short(*width))?;
        if let Some((dash, gap)) = dash {
            write!(f, r#" stroke-dasharray="{} {}""#, Short(*dash), Short(*gap))?;
        }
        Ok(())
    }
}

/// Text between tags.
pub(crate) struct Escaped<'a>(pub &'a str);

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            match c {
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '&' => f.write_str("&amp;")?,
                // XML allows no other control characters, not even escaped.
                c if c.is_control() => f.write_char(' ')?,
                c => f.write_char(c)?,
            }
        }
        Ok(())
    }
}
