//! The command `adslam`: arguments, progress, exit codes. What is computed is computed elsewhere.
//!
//! ```no_run
//! use adslam_scenario::registry::Registry;
//!
//! fn main() -> std::process::ExitCode {
//!     adslam_cli::main_with(&Registry::standard())
//! }
//! ```

mod answer;
mod args;
mod commands;
mod estimates;
mod exit;
mod interrupt;
mod main_with;
mod named;
mod paths;
mod print;
mod progress;

pub use args::{
    Arguments, CheckArgs, Command, ConsistencyArgs, ExportArgs, ExportFormat, FilterArgs, MeshArgs,
    NewArgs, NewFile, ReplayArgs, RunArgs, SchemaKind, SelectionArgs, SweepArgs, TablesArgs,
};
pub use commands::{
    check, completions, export, filter, mesh, new, replay, run, schema, schema_text, sweep, tables,
};
pub use exit::{BAD_INPUT, FAILURE, INTERRUPTED, exit_code};
pub use interrupt::stop_on_signals;
pub use main_with::main_with;
