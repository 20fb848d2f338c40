//! Tables over many runs: the paper's four, and what they leave out.

mod agreement;
mod cell;
mod collect;
mod json;
mod render;
mod rows;
mod statistics;

pub use agreement::{AGREES_WITHIN, Agreement, NEAR_WITHIN};
pub use cell::{CellValue, ResultCell};
pub use collect::{
    ExperimentTables, PlannerRuns, SourceFile, TablePlan, Tables, TablesOptions, TablesProgress,
};
pub use json::write_json;
pub use render::{markdown, terminal};
pub use rows::{ResultRow, ResultTable};
pub use statistics::Spread;
