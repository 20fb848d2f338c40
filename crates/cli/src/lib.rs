//! The command `adslam`: arguments, progress, exit codes. What is computed is computed elsewhere.

mod args;
mod commands;
mod exit;
mod interrupt;
mod print;
mod progress;

pub use args::{Command, FilterArgs, ReplayArgs, RunArgs, SchemaKind, TablesArgs};
pub use commands::{check, filter, replay, run, schema, schema_text, tables};
pub use exit::{BAD_INPUT, FAILURE, INTERRUPTED, exit_code};
pub use interrupt::stop_on_ctrl_c;
