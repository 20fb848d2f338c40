//! Tables over many runs: the paper's four, and what they leave out.

mod agreement;
mod cell;
mod collect;
mod json;
mod plan;
mod render;
mod rows;
mod statistics;

pub use agreement::{Agreement, Comparison, NEAR_WITHIN};
pub use cell::{CellValue, ResultCell};
pub use collect::{ExperimentTables, PlannerRuns, SourceFile, Tables};
pub use json::json;
pub use plan::TablePlan;
pub use render::{markdown, terminal};
pub use rows::{ResultRow, ResultTable};
pub use statistics::Spread;
