//! Trajectories in the formats of other tools.

mod tum;

pub use tum::{TumFile, TumTime};
