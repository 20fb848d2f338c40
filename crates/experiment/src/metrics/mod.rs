//! How good an estimate is: the paper's measures, consistency, and errors relative to the object.

mod alignment;
mod step;
mod summary;

pub use alignment::align;
pub use step::{StepMetrics, measure_step};
pub use summary::{DecisionTimes, RunSummary, SummaryBuilder};
