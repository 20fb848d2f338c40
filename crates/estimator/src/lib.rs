//! The dense extended Kalman filter of Algorithm 1, for a robot and the features of an object that
//! moves and deforms.
//!
//! [`Ekf`] propagates and updates a [`Belief`]: the estimated state and its joint [`Covariance`].
//! [`PosteriorTrace`] tells a planner what trace an action would leave (eqs. 6, 7).
//!
//! The filter sees controls, the known motion of the features and measurements, never the truth.
//! All units are cm and radians.

mod belief;
mod buffer;
mod covariance;
mod ekf;
mod error;
mod feature_update;
mod linear_algebra;
mod noise;
mod objective;
mod parallel;
mod structure_update;
mod workspace;

pub use belief::Belief;
pub use covariance::Covariance;
pub use ekf::{Ekf, FeatureMeasurement, Measurements};
pub use error::EstimatorError;
pub use noise::FilterNoise;
pub use objective::{DirectTrace, PlannedMeasurement, PosteriorTrace, SetId};
pub use parallel::Parallelism;
pub use structure_update::{PairMeasurement, StructureMeasurements};
