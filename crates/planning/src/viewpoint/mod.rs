//! Viewpoints of the global planner: candidates, what is seen from them, and Algorithm 2.

mod grid;
mod sampling;
mod visibility;

pub use grid::ViewpointGrid;
pub use sampling::{ViewpointPath, ViewpointSampling, sample_viewpoints};
pub use visibility::{features_seen_from, features_seen_in_pose};
