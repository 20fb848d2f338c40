//! Planners for active SLAM in deformable environments: which control the robot should take next.
//!
//! Every planner stands behind the trait [`Planner`] and chooses from the same safe actions:
//!
//! | planner | rule | in the paper |
//! | --- | --- | --- |
//! | [`PredeterminedPlanner`] | the same control at every step | Section IV |
//! | [`LocalPlanner`] | smallest trace of the next covariance | III-B, eqs. (6), (7) |
//! | [`GlobalPlanner`] | nearest to the current viewpoint | III-C, Algorithm 2, eqs. (8), (9) |
//! | [`CombinedPlanner`] | smallest trace among those nearest to the viewpoint | III-D |
//!
//! No planner that chooses goes through the estimated surface: where nothing is safe, [`SafeActions`] has the robot stay,
//! or go where the way is free.
//!
//! For planners of one's own: [`ObjectSurfaces`], [`SafeActions`] and [`VisibleSets`] say where the object
//! will be, what is safe and what would be seen, and [`ActionScorer`] which candidate leaves the
//! smallest trace. All reuse their allocations from decision to decision.
//!
//! A planner sees the belief and the known motion of the object, never the truth, a random number
//! generator or a clock: the draws of Algorithm 2 are handed in. Units are cm and radians.
//!
//! ```
//! use adslam_planning::ActionSet;
//!
//! // Turning by -10°, 0° or 10°, and 1 cm ahead or not at all; roll and pitch stay within 45°.
//! let turn = 10_f64.to_radians();
//! let actions = ActionSet::grid(
//!     [&[0.0], &[0.0], &[-turn, 0.0, turn]],
//!     [&[0.0, 1.0], &[0.0]],
//!     45_f64.to_radians(),
//!     45_f64.to_radians(),
//! );
//! assert_eq!(actions.controls().len(), 6);
//! ```

mod action;
mod combined;
mod error;
mod fallback;
mod global;
mod goal;
mod local;
mod model;
mod planner;
mod predetermined;
mod safety;
mod scoring;
mod surfaces;
mod ties;
mod trace_choice;
mod viewpoint;
mod visible_sets;

pub use action::ActionSet;
pub use combined::{CombinedPlanner, Nearest};
pub use error::PlanningError;
pub use global::GlobalPlanner;
pub use goal::{Approach, Goals};
pub use local::LocalPlanner;
pub use model::PlanningModel;
pub use planner::{Decision, Planner, Score, Situation};
pub use predetermined::PredeterminedPlanner;
pub use safety::{Candidate, SafeActions};
pub use scoring::{ActionScorer, PlanningNoise, TRACE_TOLERANCE};
pub use surfaces::ObjectSurfaces;
pub use viewpoint::{
    ViewpointPath, ViewpointSampling, can_be_reached, features_never_seen, features_seen_from,
    features_seen_in_pose, sample_viewpoints,
};
pub use visible_sets::VisibleSets;
