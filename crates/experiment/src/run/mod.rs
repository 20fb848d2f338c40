//! One run: a planner, a filter and the simulated world, step by step; and many of them in parallel.

mod batch;
mod folder;
mod history;
mod identity;
mod manifest;
mod name;
mod observer;
mod planners;
mod record;
mod rest_object;
mod setup;
mod shared_objects;
mod simulate;
mod start;
pub(crate) mod warnings;
mod watch;

pub use batch::{Batch, BatchResult, Interrupt, Progress};
pub use folder::{PAGE_FILE, StoredRun, refuse_part_of_run};
pub use history::{
    ActionRuns, Candidate, DrawnSurface, HISTORY_FILE, HISTORY_FORMAT, HISTORY_VERSION,
    HistoryDecision, HistoryMetrics, HistoryRecorder, HistoryStep, ObjectStep, RunHistory,
};
pub use manifest::{RUN_FILE, RunManifest};
pub use observer::{FilterInput, NoObserver, Observer, StepView};
pub use planners::build_planner;
pub use record::{RunRecorder, RunReport};
pub(crate) use rest_object::{features_of, parted};
pub use setup::Setup;
pub(crate) use setup::gate;
pub use simulate::{RunOutcome, simulate};
pub(crate) use watch::GateWatch;
