//! The simulated world and an episode in it: what is true, what a robot measures of it, what its agent makes of that,
//! and how far that is from the truth.
//!
//! An [`Episode`] is one run, a step at a time: [`Episode::decide`] asks the agent's planner, [`Episode::take`] moves the
//! world by a control, be it the planner's or the caller's own, and lets the agent measure; [`Episode::view`] shows all
//! of the present step, [`Episode::summary`] the run so far in numbers. Same seed, same episode: nothing else is random.
//!
//! Only this crate knows the truth and draws its noise. Nothing here reads or writes files.
//!
//! ```
//! use std::path::Path;
//!
//! use adslam_names::PlannerName;
//! use adslam_scenario::Scenario;
//! use adslam_setup::Setup;
//!
//! let setup = Setup::new(&Scenario::load(Path::new("../../scenarios/polygon.toml"))?)?;
//! let (mut episode, _) = setup.episode(PlannerName::LOCAL, 1)?;
//! for _ in 0..2 {
//!     let decision = episode.decide()?;
//!     episode.take(&decision.control)?;
//! }
//! assert_eq!(episode.view().step, 3);
//! assert!(episode.summary().observed > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod episode;
mod error;
mod metrics;
mod model;
mod view;
mod watch;
mod world;

pub use episode::Episode;
pub use error::EpisodeError;
pub use metrics::{
    DecisionTimes, DriftFloor, MEAN_NORM_OF_UNIT_GAUSSIAN, RunSummary, StepMetrics, SummaryBuilder,
    align, measure_step,
};
pub use model::EpisodeModel;
pub use view::StepView;
pub use watch::{GateWatch, RunWatch};
#[cfg(test)]
pub(crate) use world::NOISE;
pub use world::{
    DeformationNoise, FaultCounts, Faults, SimulatedMeasurements, Stream, World, WorldModel,
    WorldNoise, stream,
};
