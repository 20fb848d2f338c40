//! A panel with axes.

use plotters::chart::ChartBuilder;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, RGBColor, ShapeStyle};

use crate::axis::Axis;
use crate::error::DrawingError;
use crate::figure::Area;
use crate::shape::Shape;
use crate::sheet::{size_in_units, text_style, units};
use crate::style::{AXIS, Colour, GRID, INK, SMALL_TEXT, TEXT};

/// A panel with a title and axes. Shapes drawn in it have the values of its axes.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    /// What stands above it.
    pub title: String,
    /// The colour of that.
    pub title_colour: Colour,
    pub x: Axis,
    pub y: Axis,
    /// Texts below points.
    pub notes: Vec<((f64, f64), String)>,
    /// Room for the labels below and at the left, px.
    pub margins: Margins,
}

/// Room around the plot, px.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Margins {
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
    pub left: f64,
}

impl Margins {
    /// Room for a title, numbers and labels.
    pub(crate) const USUAL: Self = Self {
        top: 22.0,
        right: 14.0,
        bottom: 32.0,
        left: 48.0,
    };
}

/// Between the label at the left and the panel beside, px.
const OUTSIDE: f64 = 4.0;

impl Chart {
    /// A chart with the usual margins.
    pub(crate) fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            title_colour: INK,
            x,
            y,
            notes: Vec::new(),
            margins: Margins::USUAL,
        }
    }

    /// Draws the panel and, in this order, the shapes.
    pub(crate) fn draw(
        &self,
        area: &Area<'_>,
        shapes: impl IntoIterator<Item = Shape<(f64, f64)>>,
    ) -> Result<(), DrawingError> {
        let Margins {
            top,
            right,
            bottom,
            left,
        } = self.margins;
        let mut chart = ChartBuilder::on(area)
            .margin_top(size_in_units(top))
            .margin_right(size_in_units(right))
            .margin_left(size_in_units(OUTSIDE))
            .x_label_area_size(size_in_units(bottom))
            .y_label_area_size(size_in_units(left))
            .build_cartesian_2d(self.x.clone(), self.y.clone())?;
        chart
            .configure_mesh()
            .bold_line_style(line(GRID, 0.8))
            .light_line_style(line(GRID, 0.0))
            .axis_style(line(AXIS, 0.8))
            .label_style(text_style(SMALL_TEXT, INK))
            .axis_desc_style(text_style(TEXT, INK))
            .set_all_tick_mark_size(units(2.5))
            .x_desc(&self.x.label)
            .y_desc(&self.y.label)
            .draw()?;
        for shape in shapes {
            chart.plotting_area().draw(&shape)?;
        }
        let style = text_style(SMALL_TEXT, INK).pos(Pos::new(HPos::Center, VPos::Top));
        let (x0, y0) = area.get_base_pixel();
        for (at, text) in &self.notes {
            let (x, y) = chart.backend_coord(at);
            area.draw_text(text, &style, (x - x0, y - y0 + units(2.0)))?;
        }
        if !self.title.is_empty() {
            let style = text_style(TEXT, self.title_colour).pos(Pos::new(HPos::Left, VPos::Bottom));
            area.draw_text(
                &self.title,
                &style,
                (units(OUTSIDE + left), units(top - 4.0)),
            )?;
        }
        Ok(())
    }
}

fn line(colour: Colour, width: f64) -> ShapeStyle {
    let rgb = RGBColor(colour.0, colour.1, colour.2);
    // A line of no width is not drawn at all.
    let alpha = if width > 0.0 { 1.0 } else { 0.0 };
    rgb.mix(alpha).stroke_width(size_in_units(width))
}
