//! The planner's objective, eqs. (6), (7): the trace of the covariance that an action would leave.
//!
//! Structure measurements touch the features only and an action moves the robot only, so conditioning
//! on them commutes with the motion: [`prior`] applies them once a decision. From there,
//!
//! * [`DirectTrace`] does for each action one dense update of the whole covariance. It takes any noise,
//!   and it is what the other is measured against.
//! * [`PosteriorTrace`] does the work that does not depend on the action once for each *set* of visible
//!   features, and is left with algebra of size 12 for each action. It needs isotropic noise.

mod action;
mod direct;
mod fast;
mod group;
mod pose_factor;
mod prior;
mod shared;
mod workspace;

pub use direct::{DirectTrace, PlannedMeasurement};
pub use fast::{PosteriorTrace, SetId};
