//! Sweeps: some keys of a scenario varied, every planner at the same seeds at each point, and tables with
//! confidence intervals and paired tests of what came of it.
//!
//! A [`Sweep`] is what its file says, a [`SweepPlan`] that made ready to run as a [`Study`](crate::study::Study), and
//! [`SweepResults`] what is made of the study's records.

mod file;
mod markdown;
mod metrics;
mod places;
mod plan;
mod point;
mod results;
#[cfg(test)]
mod tests;

pub(crate) use file::SweepFile;
pub use file::{Sweep, SweepPoint};
pub use places::MOST_POINTS;
pub use plan::SweepPlan;
pub use results::SweepResults;
