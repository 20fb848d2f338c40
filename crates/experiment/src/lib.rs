//! What happens around filter and planners: scenario and configuration files, the simulated world,
//! the runner, metrics, logs and tables.

pub mod config;
pub mod consistency;
pub mod diagnostics;
mod error;
pub mod log;
mod mesh_report;
pub mod metrics;
mod near_vertices;
pub mod output;
pub mod provenance;
pub mod run;
pub mod scenario;
pub mod schema;
pub mod statistics;
pub mod study;
pub mod sweep;
pub mod tables;
pub mod world;

pub use error::ExperimentError;
pub use mesh_report::{MeshReport, MeshUse};
