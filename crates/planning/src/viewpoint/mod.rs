//! Viewpoints of the global planner: candidates, what is seen from them, and Algorithm 2.

mod sampling;
mod visibility;

pub use sampling::{ViewpointPath, ViewpointSampling, features_never_seen, sample_viewpoints};
pub use visibility::{features_seen_from, features_seen_in_pose};
