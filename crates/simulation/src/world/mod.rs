//! The simulated world: the only place that knows the truth and draws random numbers.

mod faults;
mod noise;
mod streams;
mod truth;

pub use faults::{FaultCounts, Faults};
#[cfg(test)]
pub use noise::NOISE;
pub use noise::{DeformationNoise, WorldNoise};
pub use streams::{Stream, stream};
pub use truth::{SimulatedMeasurements, World, WorldModel};
