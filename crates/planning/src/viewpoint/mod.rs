//! Viewpoints of the global planner: candidates, what is seen from them, and Algorithm 2.

mod reach;
mod sampling;
mod visibility;

pub use reach::can_be_reached;
pub use sampling::{ViewpointPath, ViewpointSampling, features_never_seen, sample_viewpoints};
pub use visibility::{features_seen_from, features_seen_in_pose};
