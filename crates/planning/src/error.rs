//! Why no decision could be made.

use std::error::Error;

use adslam_estimator::EstimatorError;
use adslam_surface::SurfaceError;

/// A decision or a viewpoint set that could not be made.
#[derive(Debug, thiserror::Error)]
pub enum PlanningError {
    /// The filter's mathematics failed.
    #[error(transparent)]
    Estimator(#[from] EstimatorError),
    /// The estimated features do not make a surface.
    #[error("the surface of the estimated features cannot be used: {0}")]
    Surface(#[from] SurfaceError),
    /// What a planner of one's own has to say.
    #[error(transparent)]
    Other(#[from] Box<dyn Error + Send + Sync>),
    /// The robot has nothing to choose from.
    #[error("the set of actions is empty; give at least one value for each of its lists")]
    NoActions,
    /// Visible sets that belong to another list of candidates.
    #[error(
        "{sets} visible sets are given for {candidates} candidates; find the sets of these candidates \
         first"
    )]
    SetsOfOtherCandidates {
        /// How many sets there are.
        sets: usize,
        /// How many candidates there are.
        candidates: usize,
    },
    /// A grid of viewpoints that are all too near to the object.
    #[error(
        "none of the {candidates} viewpoint candidates can be reached: a robot that keeps {clearance} cm from \
         the object comes within {reached_within} cm of none; widen the grid or let viewpoints count as reached \
         from farther away"
    )]
    NoReachableViewpoints {
        /// How many candidates the grid has.
        candidates: usize,
        /// What the robot keeps from the object, cm.
        clearance: f64,
        /// From where on a viewpoint counts as reached, cm.
        reached_within: f64,
    },
    /// A grid of viewpoints without a usable point.
    #[error(
        "none of the {candidates} viewpoint candidates lies outside the object; widen the grid or \
         shrink the block that it leaves out"
    )]
    NoViewpoints {
        /// How many candidates the grid has.
        candidates: usize,
    },
}
