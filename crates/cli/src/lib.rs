//! The command `adslam`: arguments, progress, exit codes. What is computed is computed elsewhere.

mod args;
mod commands;
mod exit;
mod interrupt;
mod print;
mod progress;

pub use args::{
    Command, ExportArgs, ExportFormat, FilterArgs, MeshArgs, ReplayArgs, RunArgs, TablesArgs,
};
pub use commands::{check, export, filter, mesh, replay, run, tables};
pub use exit::{BAD_INPUT, FAILURE, INTERRUPTED, exit_code};
pub use interrupt::stop_on_ctrl_c;
