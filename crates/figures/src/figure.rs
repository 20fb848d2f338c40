//! A finished figure, as SVG and PNG.

use std::path::{Path, PathBuf};

use adslam_record::AtomicFile;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use crate::error::{DrawingError, FigureError};
use crate::font;
use crate::sheet::{Escaped, Sheet, units};

/// A part of a figure.
pub(crate) type Area<'a> = DrawingArea<Sheet<'a>, Shift>;

/// Pixels of a PNG to a pixel of the SVG: 300 to the inch.
const PNG_SCALE: f32 = 3.125;

/// A finished figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    name: String,
    title: String,
    width: f64,
    height: f64,
    svg: String,
}

/// What a figure is called, and how large it is, px.
#[derive(Clone, Debug)]
pub(crate) struct Frame<'a> {
    pub name: &'a str,
    /// What it shows, for those who cannot see it.
    pub title: &'a str,
    pub width: f64,
    pub height: f64,
}

impl Frame<'_> {
    /// Draws a figure.
    pub(crate) fn draw(
        &self,
        draw: impl FnOnce(&Area<'_>) -> Result<(), DrawingError>,
    ) -> Result<Figure, FigureError> {
        let mut body = String::new();
        let sheet = Sheet::new(&mut body, self.width, self.height);
        draw(&sheet.into_drawing_area()).map_err(|cause| FigureError::Layout {
            figure: self.name.to_owned(),
            cause,
        })?;
        let (width, height) = (self.width, self.height);
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\">\n\
             <title>{}</title>\n<style>{}</style>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n\
             <g font-family=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"butt\">\n\
             {body}</g>\n</svg>\n",
            Escaped(self.title),
            font::style_sheet(),
            font::FAMILIES,
        );
        Ok(Figure {
            name: self.name.to_owned(),
            title: self.title.to_owned(),
            width,
            height,
            svg,
        })
    }
}

impl Figure {
    /// The name of its files without their endings.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it shows, in a sentence.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The figure as an SVG file, its font embedded.
    #[must_use]
    pub fn svg(&self) -> &str {
        &self.svg
    }

    /// The figure as a PNG file of 300 dots to the inch.
    ///
    /// # Errors
    /// [`FigureError::Raster`] if it is too large for the memory there is.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        self.png_scaled(PNG_SCALE)
    }

    /// The figure as a PNG file with so many pixels to one of the SVG.
    ///
    /// # Errors
    /// As [`Figure::png`].
    pub fn png_scaled(&self, scale: f32) -> Result<Vec<u8>, FigureError> {
        let failed = |reason: String| FigureError::Raster {
            figure: self.name.clone(),
            reason,
        };
        let options = Options {
            fontdb: font::database(),
            font_family: "Noto Sans".to_owned(),
            ..Options::default()
        };
        let tree = Tree::from_str(&self.svg, &options).map_err(|e| failed(e.to_string()))?;
        let pixels = |px: f64| (units(px * f64::from(scale)).unsigned_abs()).div_ceil(10);
        let (width, height) = (pixels(self.width), pixels(self.height));
        let mut pixmap = Pixmap::new(width, height)
            .ok_or_else(|| failed(format!("no memory for {width} × {height} pixels")))?;
        resvg::render(
            &tree,
            Transform::from_scale(scale, scale),
            &mut pixmap.as_mut(),
        );
        pixmap.encode_png().map_err(|e| failed(e.to_string()))
    }

    /// Writes NAME.svg and NAME.png into `folder`, which must exist; returns their paths.
    ///
    /// # Errors
    /// [`FigureError::Raster`] or [`FigureError::Output`].
    pub fn write(&self, folder: &Path) -> Result<[PathBuf; 2], FigureError> {
        let [svg, png] =
            ["svg", "png"].map(|ending| folder.join(format!("{}.{ending}", self.name)));
        AtomicFile::with_content(&svg, self.svg.as_bytes())?.commit()?;
        AtomicFile::with_content(&png, &self.png()?)?.commit()?;
        Ok([svg, png])
    }
}
