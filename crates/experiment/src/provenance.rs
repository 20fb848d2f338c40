//! By which program results were made.

/// Counts up whenever the program's results change: whole runs with the same scenario, planner and seed
/// give other numbers than before.
pub const RESULTS_VERSION: u32 = 1;
