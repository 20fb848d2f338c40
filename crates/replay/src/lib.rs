//! Runs as one web page that opens offline: `adslam replay`.
//!
//! The page holds one or two runs as they stand in their history.json, and the program that shows
//! them. The program is written in TypeScript in `web/src`; what `web/build.sh` makes of it lies in
//! `web/dist` and is compiled in here, so that building adslam needs neither node nor a network.
//!
//! This crate knows the form of a history and of the page, and nothing of how a run came about.
//!
//! ```no_run
//! use std::path::Path;
//!
//! use adslam_record::RunHistory;
//!
//! let run = RunHistory::load(Path::new("results/run"))?;
//! adslam_replay::write_html(&[&run], Path::new("replay.html"))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod embed;
mod page;

use std::path::Path;

use adslam_diagnostics::{Failure, InputError};
use adslam_record::{AtomicFile, RunHistory};

pub use embed::{EmbedError, embedded_histories};
pub use page::MOST_RUNS;

/// Writes the page of one or two runs to `out`; returns its size in bytes.
///
/// # Errors
/// Too few or too many runs, a history that does not fit together, or a file that cannot be
/// written; what lay at `out` is then unchanged.
pub fn write_html(histories: &[&RunHistory], out: &Path) -> Result<usize, Failure> {
    let page = page_for(histories, out)?;
    AtomicFile::with_content(out, page.as_bytes())?.commit()?;
    Ok(page.len())
}

/// The page of one or two runs as a file that will lie at `out`; it still has to be committed.
///
/// # Errors
/// As [`write_html`].
pub fn to_file(histories: &[&RunHistory], out: &Path) -> Result<AtomicFile, Failure> {
    AtomicFile::with_content(out, page_for(histories, out)?.as_bytes())
}

fn page_for(histories: &[&RunHistory], out: &Path) -> Result<String, InputError> {
    html(histories).map_err(|reason| {
        InputError::about_file(out, format_args!("no replay can be made: {reason}"))
            .with_help("give the folders of one or two runs of this version of adslam")
    })
}

/// The page of one or two runs.
///
/// # Errors
/// [`EmbedError`]: too few or too many runs, or one that does not fit together.
pub fn html(histories: &[&RunHistory]) -> Result<String, EmbedError> {
    if histories.is_empty() || histories.len() > MOST_RUNS {
        return Err(EmbedError::Count(histories.len()));
    }
    let mut elements = String::new();
    for (i, history) in histories.iter().enumerate() {
        history.check().map_err(EmbedError::DoesNotFit)?;
        elements.push_str(&embed::element(i, history)?);
    }
    Ok(page::fill(&page::title(histories), &elements))
}
