//! Tables over many runs: the paper's four, and what they leave out.

mod collect;
mod json;
mod render;
mod statistics;

pub use collect::{
    ExperimentTables, PlannerRuns, TablePlan, Tables, TablesOptions, TablesProgress,
};
pub use json::write_json;
pub use render::{markdown, terminal};
pub use statistics::Spread;
