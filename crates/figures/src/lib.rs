//! The figures of the paper, and those that it lacks, drawn from recorded runs.
//!
//! Every function takes runs ([`RunHistory`](adslam_record::RunHistory)) or their
//! summaries and returns a [`Figure`], which is an SVG document and can be turned into a PNG. The
//! same runs give the same bytes on every machine: the font is part of the program. A method has
//! the same colour in all figures, one that is distinguished without colour vision.
//!
//! ```no_run
//! use std::path::Path;
//!
//! use adslam_figures::coverage;
//! use adslam_record::RunHistory;
//!
//! let run = RunHistory::load(Path::new("results/run"))?;
//! coverage("coverage", &[&run])?.write(Path::new("results"))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod boxes;
mod chart;
mod comparison;
mod consistency;
mod coverage;
mod environments;
mod error;
mod estimates;
mod figure;
mod font;
mod legend;
mod method;
mod methods;
mod nees;
mod pose_error;
mod scene;
mod shape;
mod sheet;
mod statistics;
mod style;
mod ticks;

pub use boxes::{RunsOfMethod, boxes};
pub use comparison::comparison;
pub use consistency::{BandedMean, ConsistencyCurve, ConsistencyCurves, consistency};
pub use coverage::coverage;
pub use environments::environments;
pub use error::{DrawingError, FigureError};
pub use estimates::estimates;
pub use figure::Figure;
pub use method::Method;
pub use nees::{CHI_SQUARED_6_BOUNDS, nees};
pub use pose_error::pose_error;
