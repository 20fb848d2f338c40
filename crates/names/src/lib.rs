//! What goes by a name in files, on the command line and in results, and what is said where nothing has the name that
//! was given.
//!
//! ```
//! use adslam_names::{EstimatorName, Named, PlannerName};
//!
//! assert_eq!(PlannerName::new("local"), Ok(PlannerName::LOCAL));
//! let error = EstimatorName::named("so3_ekv").unwrap_err();
//! assert!(error.to_string().contains("did you mean so3_ekf?"));
//! ```

mod estimators;
mod listed;
mod named;
mod near;
mod planners;
mod unit;

pub use estimators::EstimatorName;
pub use listed::numbers;
pub use named::{Named, UnknownName};
pub use near::nearest;
pub use planners::{BadPlannerName, PlannerLook, PlannerName};
pub use unit::LengthUnit;
