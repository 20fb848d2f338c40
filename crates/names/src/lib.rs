//! What goes by a name in files, on the command line and in results, and what is said where nothing has the name that
//! was given.
//!
//! ```
//! use adslam_names::{LengthUnit, Named, PlannerName};
//!
//! assert_eq!(PlannerName::new("local"), Ok(PlannerName::LOCAL));
//! let error = LengthUnit::named("cn").unwrap_err();
//! assert!(error.to_string().contains("did you mean cm?"));
//! ```

mod listed;
mod look;
mod named;
mod near;
mod registered;
mod short_name;
mod unit;

pub use listed::numbers;
pub use look::Look;
pub use named::{Named, UnknownName};
pub use near::nearest;
pub use registered::{EstimatorName, PlannerName};
pub use short_name::BadName;
pub use unit::LengthUnit;
