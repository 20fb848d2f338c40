//! How an object moves and deforms, step by step.
//!
//! The paper's process model, eq. (2), moves feature j from step n to step n + 1 by
//! `r_t t_n + r_d d_n^j`: a translation `t_n` that all features share, a local deformation `d_n^j`
//! of each, and a rotation of either. Here a [`Translation`] gives `t_n`; a [`Deformation`] gives
//! the *displacement* `D(n)` of a point from its rest position, whose change is `d_n`; a
//! [`Rotation`] gives `r_t` or `r_d`; and [`ObjectMotion`] puts the four together. A new kind of
//! motion is a new implementation of one of the three traits.
//!
//! The traits are functions of a continuous time, so that a motion can run faster than its model or
//! lag behind it: an [`ObjectMotion`] has a [`Clock`], which says the time at each step.
//!
//! Lengths are centimetres, angles radians, and everything is expressed in the world frame. Steps
//! are numbered from 1, the start; step 0 does not exist and is taken as step 1. Time is counted in
//! steps too, and is 1 at the start.
//!
//! This crate knows nothing of robots, filters, noise or files.
//!
//! ```
//! use std::sync::Arc;
//! use adslam_deformation::{AnchoredDeformation, BackAndForth, Direction, ObjectMotion, Schedule};
//! use nalgebra::{Point3, Vector3};
//!
//! // The polygon of the paper: back and forth along x, in and out around the first feature.
//! let anchor = Point3::new(1.5, 0.0, 0.0);
//! let schedule = Schedule::new(vec![0.0, 0.2, 0.4, 0.6, 0.4, 0.2])?;
//! let motion = ObjectMotion {
//!     translation: Arc::new(BackAndForth::new(Vector3::new(0.1, 0.0, 0.0))),
//!     deformation: Arc::new(AnchoredDeformation::new(anchor, Direction::Horizontal, schedule)),
//!     ..ObjectMotion::default()
//! };
//! let feature = Point3::new(1.5, -1.0, 1.0);
//! let moved = motion.feature_motion(&feature, 1);
//! assert!((moved - Vector3::new(0.1, -0.2, 0.0)).norm() < 1e-12);
//! # Ok::<(), adslam_deformation::MotionError>(())
//! ```

mod amount;
mod clock;
mod deformation;
mod error;
mod motion;
mod rotation;
mod translation;

pub use amount::{Amount, Schedule, Sinusoid};
pub use clock::{Clock, MAX_CLOCK_FACTOR};
pub use deformation::{AnchoredDeformation, Deformation, Direction, Rigid, ScaledDeformation};
pub use error::MotionError;
pub use motion::{ObjectMotion, Turn};
pub use rotation::{AxisRotation, Rotation};
pub use translation::{BackAndForth, NoTranslation, SinusoidalTranslation, Translation};
