//! What is drawn: points, in whatever coordinates, and a look.

use std::convert::Infallible;

use plotters::element::{Drawable, PointCollection};
use plotters_backend::{BackendCoord, DrawingErrorKind};

use crate::sheet::{Sheet, units};
use crate::style::{Colour, Stroke};

/// How points are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Look {
    /// A line through them.
    Line(Stroke),
    /// The area that they surround.
    Area {
        fill: Colour,
        opacity: f64,
        edge: Option<Stroke>,
    },
    /// A circle of this radius (px) at each.
    Dots {
        radius: f64,
        fill: Option<Colour>,
        edge: Option<Stroke>,
    },
    /// An upright cross with arms of this length (px) at each.
    Crosses { arm: f64, stroke: Stroke },
}

/// Points in the coordinates `C`, and how they look.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shape<C> {
    pub points: Vec<C>,
    pub look: Look,
}

impl<C> Shape<C> {
    pub(crate) const fn new(points: Vec<C>, look: Look) -> Self {
        Self { points, look }
    }

    /// A line through the points.
    pub(crate) const fn line(points: Vec<C>, stroke: Stroke) -> Self {
        Self::new(points, Look::Line(stroke))
    }
}

impl<'a, C> PointCollection<'a, C> for &'a Shape<C> {
    type Point = &'a C;
    type IntoIter = &'a [C];

    fn point_iter(self) -> &'a [C] {
        &self.points
    }
}

impl<C> Drawable<Sheet<'_>> for Shape<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        points: I,
        sheet: &mut Sheet<'_>,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        let points: Vec<BackendCoord> = points.collect();
        match &self.look {
            Look::Line(stroke) => sheet.line(&points, stroke),
            Look::Area {
                fill,
                opacity,
                edge,
            } => sheet.area(&points, *fill, *opacity, edge.as_ref()),
            Look::Dots { radius, fill, edge } => {
                for point in points {
                    sheet.circle(point, *radius, *fill, edge.as_ref());
                }
            }
            Look::Crosses { arm, stroke } => {
                let arm = units(*arm);
                for (x, y) in points {
                    sheet.line(&[(x - arm, y), (x + arm, y)], stroke);
                    sheet.line(&[(x, y - arm), (x, y + arm)], stroke);
                }
            }
        }
        Ok(())
    }
}

/// Draws shapes that are laid on what is there as one, with one opacity.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub shapes: Vec<Shape<BackendCoord>>,
    pub opacity: f64,
    /// Where pixel (0, 0) of the shapes lies; the only point that is mapped.
    origin: [BackendCoord; 1],
}

impl Group {
    pub(crate) const fn new(shapes: Vec<Shape<BackendCoord>>, opacity: f64) -> Self {
        let origin = [(0, 0)];
        Self {
            shapes,
            opacity,
            origin,
        }
    }
}

impl<'a> PointCollection<'a, BackendCoord> for &'a Group {
    type Point = &'a BackendCoord;
    type IntoIter = &'a [BackendCoord];

    fn point_iter(self) -> &'a [BackendCoord] {
        &self.origin
    }
}

impl Drawable<Sheet<'_>> for Group {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        mut origin: I,
        sheet: &mut Sheet<'_>,
        parent: (u32, u32),
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        let (x0, y0) = origin.next().unwrap_or_default();
        if self.shapes.is_empty() {
            return Ok(());
        }
        sheet.begin_group(self.opacity);
        for shape in &self.shapes {
            let points = shape.points.iter().map(|&(x, y)| (x + x0, y + y0));
            shape.draw(points, sheet, parent)?;
        }
        sheet.end_group();
        Ok(())
    }
}
