//! What a run leaves: its history, tables, trajectories and logs, in files that are whole or not there at all.
//!
//! Recorders are [`Observer`]s of a run: [`HistoryRecorder`] keeps what pictures and replays are made of,
//! [`StepsFile`] and its kin write tables, [`log::LogRecorder`] writes the log from which [`log::Replay`] makes the run's
//! estimates again.
//!
//! ```
//! use std::path::Path;
//!
//! use adslam_names::PlannerName;
//! use adslam_record::{HistoryRecorder, Observer};
//! use adslam_scenario::Scenario;
//! use adslam_setup::Setup;
//!
//! let setup = Setup::new(&Scenario::load(Path::new("../../scenarios/polygon.toml"))?)?;
//! let (mut episode, _) = setup.episode(PlannerName::GLOBAL, 1)?;
//! let mut recorder = HistoryRecorder::new(&setup.model, PlannerName::GLOBAL, 1);
//! recorder.step(&episode.view())?;
//! let decision = episode.decide()?;
//! episode.take(&decision.control)?;
//! recorder.step(&episode.view())?;
//! assert_eq!(recorder.history().steps.len(), 2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod file;
mod history;
pub mod log;
mod observer;
mod table;
mod trajectory;

pub use file::{AtomicFile, FolderLock, checksum, make_folder, not_writable, prepare_folder};
pub use history::{
    ActionRuns, Candidate, DrawnSurface, HISTORY_FILE, HISTORY_FORMAT, HISTORY_VERSION,
    HistoryDecision, HistoryMetrics, HistoryRecorder, HistoryStep, ObjectStep, RunHistory,
};
pub use observer::{NoObserver, Observer};
pub use table::{
    Column, ColumnKind, FeaturesFile, LastFeatures, POSE_COMPONENTS, PoseCovarianceFile, StepsFile,
    TableFile,
};
pub use trajectory::{TumFile, TumTime};
