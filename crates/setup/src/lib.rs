//! A scenario made ready to run: its object built, its models, and the planners with the parameters that it gives
//! them.
//!
//! ```
//! use std::path::Path;
//!
//! use adslam_scenario::Scenario;
//! use adslam_setup::Setup;
//!
//! let setup = Setup::new(&Scenario::load(Path::new("../../scenarios/polygon.toml"))?)?;
//! assert!(setup.warnings.is_empty());
//! assert_eq!(setup.model.planning.topology.faces().len(), 24);
//! # Ok::<(), adslam_diagnostics::InputError>(())
//! ```

mod identity;
mod mesh_report;
mod near_vertices;
mod planners;
mod rest_object;
mod setup;
mod shared_objects;
mod start;

pub use mesh_report::{MeshReport, MeshUse};
pub use planners::build_planner;
pub use setup::Setup;
