//! The whole command, for this program and for others with planners of their own.

use std::process::ExitCode;

use adslam_diagnostics::Interrupt;
use adslam_scenario::registry::Registry;
use clap::FromArgMatches;

use crate::{Arguments, exit_code, stop_on_signals};

/// Reads the command line and does what it says, with the planners of `registry`: scenarios may have their keys, and
/// every command knows their names.
///
/// ```no_run
/// use adslam_scenario::registry::Registry;
///
/// fn main() -> std::process::ExitCode {
///     adslam_cli::main_with(&Registry::standard())
/// }
/// ```
#[must_use]
pub fn main_with(registry: &Registry) -> ExitCode {
    let mut line = Arguments::command_with(registry);
    let matches = line.get_matches_mut();
    let command = match Arguments::from_arg_matches(&matches) {
        Ok(arguments) => arguments.command,
        Err(error) => error.format(&mut line).exit(),
    };
    let never = Interrupt::new();
    let interrupt = if command.heeds_interrupts() {
        stop_on_signals()
    } else {
        &never
    };
    exit_code(command.execute(registry, interrupt))
}
