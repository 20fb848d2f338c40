//! The results of a configuration as one web page that opens offline: report.html.
//!
//! The page holds the tables with the published values beside ours and a mark for how well each
//! cell agrees, the figures, and the files that the results were made from. Replays of one run of
//! each method lie beside it. It needs no network and no JavaScript, follows the reader's light or
//! dark setting, and prints.
//!
//! This crate knows [`Tables`] and what figures and replays are made of, and nothing of how a run
//! came about.
//!
//! ```no_run
//! use std::path::Path;
//!
//! use adslam_diagnostics::Interrupt;
//! use adslam_experiment::tables::TablePlan;
//! use adslam_scenario::config::Selection;
//!
//! let plan = TablePlan::load(Path::new("configs/paper.toml"), &Selection::default())?;
//! let tables = plan.run(&Interrupt::new(), &|| ());
//! adslam_report::write(&tables, Path::new("results"))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod drawings;
mod machine;
mod marks;
mod page;
mod tables;

use std::path::{Path, PathBuf};
use std::{fs, io};

use adslam_diagnostics::Failure;
use adslam_experiment::tables::{ExperimentTables, Tables};
use adslam_record::{AtomicFile, prepare_folder};

pub use drawings::runs_of_methods;
pub use machine::Machine;

/// The name of the page.
pub const REPORT_FILE: &str = "report.html";

/// The folder of the replays, beside the page.
pub const REPLAYS_FOLDER: &str = "replays";

/// Writes report.html, and a replay of every recorded run, into `folder`, which must exist;
/// returns the path of the page.
///
/// Figures and replays are of the runs that were recorded; without any the page has tables only.
///
/// # Errors
/// A file that cannot be written; what lay in its place is then unchanged.
pub fn write(tables: &Tables, folder: &Path) -> Result<PathBuf, Failure> {
    let replays = folder.join(REPLAYS_FOLDER);
    if tables.experiments.iter().any(|e| !e.histories.is_empty()) {
        prepare_folder(&replays)?;
    }
    for experiment in &tables.experiments {
        for (file, history) in replays_of(experiment) {
            adslam_replay::write_html(&[history], &replays.join(file))?;
        }
    }
    let path = folder.join(REPORT_FILE);
    let page = html(tables, &Machine::this());
    AtomicFile::with_content(&path, page.as_bytes())?.commit()?;
    Ok(path)
}

/// Removes report.html and the replays that [`write()`] put beside it, if they are in `folder`.
///
/// # Errors
/// A file that cannot be removed.
pub fn remove(folder: &Path) -> Result<(), Failure> {
    let mut files = vec![folder.join(REPORT_FILE)];
    if let Ok(entries) = fs::read_dir(folder.join(REPLAYS_FOLDER)) {
        let paths = entries.flatten().map(|entry| entry.path());
        files.extend(paths.filter(|path| path.extension().is_some_and(|e| e == "html")));
    }
    for path in files {
        match fs::remove_file(&path) {
            Err(cause) if cause.kind() != io::ErrorKind::NotFound => {
                return Err(Failure::Output { path, cause });
            }
            _ => {}
        }
    }
    Ok(())
}

/// The page, for results that were made on `machine`.
#[must_use]
pub fn html(tables: &Tables, machine: &Machine) -> String {
    page::page(tables, machine).into_string()
}

/// The recorded runs of an experiment with the names of their replays' files.
fn replays_of(
    experiment: &ExperimentTables,
) -> impl Iterator<Item = (String, &adslam_record::RunHistory)> {
    let histories = experiment.histories.iter();
    histories.map(|history| {
        let file = format!("{}-{}.html", experiment.label, history.planner);
        (file, history)
    })
}
