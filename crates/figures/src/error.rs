//! Why a figure could not be made.

use std::convert::Infallible;
use std::io;

use adslam_diagnostics::Failure;
use plotters::drawing::DrawingAreaErrorKind;
use thiserror::Error;

/// Everything that can stop the drawing or writing of a figure.
#[derive(Debug, Error)]
pub enum FigureError {
    /// The plotting crate refused to draw.
    #[error("figure {figure} cannot be laid out: {cause}")]
    Layout {
        /// Which figure.
        figure: String,
        /// What the plotting crate said.
        cause: DrawingError,
    },
    /// The SVG could not be turned into pixels.
    #[error("figure {figure} cannot be turned into a PNG: {reason}")]
    Raster {
        /// Which figure.
        figure: String,
        /// What happened.
        reason: String,
    },
    /// A file could not be written.
    #[error(transparent)]
    Output(#[from] Failure),
}

/// For programs whose other errors are the experiments'.
impl From<FigureError> for Failure {
    fn from(error: FigureError) -> Self {
        let cause = io::Error::other(error.to_string());
        match error {
            FigureError::Output(error) => error,
            FigureError::Layout { figure, .. } | FigureError::Raster { figure, .. } => {
                Self::Output {
                    path: figure.into(),
                    cause,
                }
            }
        }
    }
}

/// What the plotting crate can say; writing into a string cannot fail by itself.
pub type DrawingError = DrawingAreaErrorKind<Infallible>;
