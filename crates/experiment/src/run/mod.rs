//! One run: a planner, a filter and the simulated world, step by step; and many of them in parallel.

mod batch;
mod planners;
mod record;
mod setup;
mod simulate;

pub use batch::{Batch, BatchResult, Interrupt, Progress};
pub use planners::build_planner;
pub use record::RunRecorder;
pub use setup::Setup;
pub use simulate::{NoObserver, Observer, RunOutcome, StepView, simulate};
