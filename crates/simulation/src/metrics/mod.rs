//! How good an estimate is: the paper's measures, consistency, errors relative to the object, and
//! the error that the noise alone must cost.

mod alignment;
mod decision_times;
mod drift_floor;
mod step;
mod summary;

pub use alignment::align;
pub use decision_times::DecisionTimes;
pub use drift_floor::{DriftFloor, MEAN_NORM_OF_UNIT_GAUSSIAN};
pub use step::{StepMetrics, measure_step};
pub use summary::{RunSummary, SummaryBuilder};
