//! By which program results were made.

use serde::{Deserialize, Serialize};

/// Counts up whenever the program's results change: whole runs with the same scenario, planner and seed
/// give other numbers than before.
pub const RESULTS_VERSION: u32 = 1;

/// What made a result.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Build {
    /// Name and version.
    pub program: String,
    /// [`RESULTS_VERSION`].
    pub results_version: u32,
}

impl Build {
    /// This program.
    #[must_use]
    pub fn this() -> Self {
        Self {
            program: concat!("adslam ", env!("CARGO_PKG_VERSION")).to_owned(),
            results_version: RESULTS_VERSION,
        }
    }
}
