//! Why an episode ends before its time.

use std::error::Error;

use adslam_estimator::EstimatorError;
use adslam_planning::PlanningError;

/// Why an episode cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum EpisodeError {
    /// The planner failed.
    #[error("the planner failed at step {step}: {cause}")]
    Planning {
        /// The step at which it had to decide.
        step: usize,
        /// What happened.
        cause: PlanningError,
    },
    /// There is no planner to decide.
    #[error(
        "the episode has no planner; give it one with `set_planner`, or choose the controls yourself"
    )]
    NoPlanner,
    /// The filter failed.
    #[error("the filter failed at step {step}: {cause}")]
    Filter {
        /// The step that it was computing.
        step: usize,
        /// What happened.
        cause: EstimatorError,
    },
    /// The simulated object, or the error of an estimate, cannot be computed any more.
    #[error("step {step} cannot be simulated: {cause}")]
    World {
        /// The step.
        step: usize,
        /// What happened.
        cause: Box<dyn Error + Send + Sync>,
    },
}
