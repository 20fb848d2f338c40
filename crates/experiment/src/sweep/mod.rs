//! Sweeps: some keys of a scenario varied, every planner at the same seeds at each point, and tables with
//! confidence intervals and paired tests of what came of it.
//!
//! A [`Sweep`](adslam_scenario::sweep::Sweep) is what its file says, a [`SweepPlan`] that made ready to run as a [`Study`](crate::study::Study), and
//! [`SweepResults`] what is made of the study's records.

mod markdown;
mod metrics;
mod plan;
mod point;
mod results;
#[cfg(test)]
mod tests;

pub use plan::SweepPlan;
pub use results::SweepResults;
