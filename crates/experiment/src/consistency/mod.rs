//! Whether estimators know how wrong they are: NEES and NIS of many runs against the intervals of χ².
//!
//! A [`ConsistencyPlan`] is a configuration with several estimators, made ready to run as a
//! [`Study`](crate::study::Study); [`ConsistencyResults`] is what is made of the study's records.

mod markdown;
mod measure;
mod plan;
mod record;
mod results;
#[cfg(test)]
mod tests;

pub use measure::{CHI_SQUARED_CONFIDENCE, Judgement, Measure, StepMean, Verdict};
pub use plan::ConsistencyPlan;
pub use record::ConsistencyRecord;
pub use results::{ConsistencyCell, ConsistencyResults};
