//! How good an estimate is: the paper's measures, consistency, errors relative to the object, and
//! the error that the noise alone must cost.

mod alignment;
mod drift_floor;
mod step;
mod summary;

pub use alignment::align;
pub use drift_floor::{DriftFloor, MEAN_NORM_OF_UNIT_GAUSSIAN};
pub use step::{StepMetrics, measure_step};
pub use summary::{DecisionTimes, RunSummary, SummaryBuilder};
