//! Recorded runs in the formats of other tools: `adslam export`.
//!
//! [`write_mcap`] writes a file for Foxglove, [`write_ply`] a surface and a cloud of features for
//! each step, [`write_csv`] every component of the state at each step. All take a [`RunHistory`]
//! and know nothing of how it came about; files appear under their names only when complete.
//!
//! ```no_run
//! use std::path::Path;
//!
//! use adslam_export::write_csv;
//! use adslam_record::RunHistory;
//!
//! let run = RunHistory::load(Path::new("results/run"))?;
//! write_csv(&run, Path::new("run.csv"))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`RunHistory`]: adslam_record::RunHistory

mod ellipsoid;
mod mcap;
mod ply;
mod table;

use std::io;
use std::path::Path;

use adslam_diagnostics::Failure;

pub use mcap::{Period, write_mcap};
pub use ply::write_ply;
pub use table::write_csv;

/// The error of a write to `path`.
fn failed<E: Into<io::Error>>(path: &Path) -> impl FnOnce(E) -> Failure + '_ {
    move |cause| Failure::Output {
        path: path.to_owned(),
        cause: cause.into(),
    }
}
