//! One run from start to end, in its folder; and many of them in parallel.

mod batch;
mod folder;
mod manifest;
mod record;
mod simulate;
pub(crate) mod warnings;

pub use batch::{Batch, BatchResult, Progress};
pub use folder::{PAGE_FILE, StoredRun, refuse_part_of_run};
pub use manifest::{RUN_FILE, RunManifest};
pub use record::{RunRecorder, RunReport};
pub use simulate::{RunOutcome, simulate};
