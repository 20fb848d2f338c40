//! Legends, in rows of their own so that they cover nothing.

use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::error::DrawingError;
use crate::figure::Area;
use crate::shape::{Look, Shape};
use crate::sheet::{px, text_style, units};
use crate::style::{INK, TEXT};

/// The height of a row, px.
pub(crate) const ROW: f64 = 17.0;

/// The gap between a sample and its text, and between two entries, px.
const GAP: f64 = 5.0;
const BETWEEN: f64 = 15.0;

/// What a look means.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub look: Look,
    pub label: String,
}

impl Entry {
    pub(crate) fn new(look: Look, label: impl Into<String>) -> Self {
        let label = label.into();
        Self { look, label }
    }

    fn width(&self) -> f64 {
        self.sample_width() + GAP + text_width(&self.label)
    }

    fn sample_width(&self) -> f64 {
        match self.look {
            Look::Line(_) => 22.0,
            Look::Area { .. } => 16.0,
            Look::Dots { .. } | Look::Crosses { .. } => 8.0,
        }
    }
}

/// The width of a text, px: close enough to keep entries apart.
fn text_width(text: &str) -> f64 {
    let letter = |c: char| match c {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ' ' | '(' | ')' | '\'' => 0.28,
        'f' | 't' | 'r' => 0.39,
        'm' | 'w' | 'M' | 'W' | '%' => 0.9,
        c if c.is_ascii_uppercase() => 0.65,
        _ => 0.57,
    };
    text.chars().map(letter).sum::<f64>() * TEXT
}

/// The entries in as many rows as their area's width asks for.
fn rows(entries: &[Entry], width: f64) -> Vec<&[Entry]> {
    let mut rows = Vec::new();
    let mut rest = entries;
    while !rest.is_empty() {
        let mut used = 0.0;
        let fit = rest
            .iter()
            .take_while(|entry| {
                used += entry.width() + BETWEEN;
                used - BETWEEN <= width
            })
            .count();
        let (row, others) = rest.split_at(fit.max(1));
        rows.push(row);
        rest = others;
    }
    rows
}

/// How much height the entries need at this width, px.
pub(crate) fn height(entries: &[Entry], width: f64) -> f64 {
    rows(entries, width).len() as f64 * ROW
}

/// Draws the entries from the top of the area, each row centred.
pub(crate) fn draw(area: &Area<'_>, entries: &[Entry]) -> Result<(), DrawingError> {
    let (width, _) = area.dim_in_pixel();
    let width = px(i32::try_from(width).unwrap_or(i32::MAX));
    let mut y = ROW / 2.0;
    for row in rows(entries, width) {
        let gaps = row.len().saturating_sub(1) as f64 * BETWEEN;
        let used = row.iter().map(Entry::width).sum::<f64>() + gaps;
        let mut x = (width - used) / 2.0;
        for entry in row {
            sample(area, x, y, entry)?;
            let text = x + entry.sample_width() + GAP;
            let style = text_style(TEXT, INK).pos(Pos::new(HPos::Left, VPos::Center));
            area.draw_text(&entry.label, &style, (units(text), units(y)))?;
            x += entry.width() + BETWEEN;
        }
        y += ROW;
    }
    Ok(())
}

fn sample(area: &Area<'_>, x: f64, y: f64, entry: &Entry) -> Result<(), DrawingError> {
    let width = entry.sample_width();
    let at = |dx: f64, dy: f64| (units(x + dx), units(y + dy));
    let points = match entry.look {
        Look::Line(_) => vec![at(0.0, 0.0), at(width, 0.0)],
        Look::Area { .. } => [(0.0, -4.5), (width, -4.5), (width, 4.5), (0.0, 4.5)]
            .map(|(dx, dy)| at(dx, dy))
            .to_vec(),
        Look::Dots { .. } | Look::Crosses { .. } => vec![at(width / 2.0, 0.0)],
    };
    area.draw(&Shape::new(points, entry.look))
}
