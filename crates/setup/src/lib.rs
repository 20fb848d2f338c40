//! A scenario made ready to run: its object built, its models, and the planners with the parameters that it gives
//! them.

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
