//! The whole command, for this program and for others with planners of their own.

use std::process::ExitCode;

use adslam_diagnostics::{Failure, Interrupt};
use adslam_scenario::registry::Registry;
use clap::FromArgMatches;

use crate::{Arguments, Command, commands, exit_code, stop_on_signals};

/// Reads the command line and does what it says, with the planners of `registry`: scenarios may have their keys, and
/// every command knows their names.
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

impl Command {
    /// Does it, with the planners of a registry.
    ///
    /// # Errors
    /// Bad input, a failure, or an interruption; see [`crate::exit_code`].
    pub fn execute(&self, registry: &Registry, interrupt: &Interrupt) -> Result<(), Failure> {
        match self {
            Self::Run(args) => commands::run(args, registry, interrupt),
            Self::Replay(args) => commands::replay(args),
            Self::Export(args) => commands::export(args),
            Self::Filter(args) => commands::filter(args, registry, interrupt),
            Self::Tables(args) => commands::tables(args, registry, interrupt),
            Self::Sweep(args) => commands::sweep(args, registry, interrupt),
            Self::Consistency(args) => commands::consistency(args, registry, interrupt),
            Self::Mesh(args) => commands::mesh(args),
            Self::Check(args) => commands::check(args, registry),
            Self::New(file) => commands::new(file, registry),
            Self::Schema { kind } => commands::schema(*kind, registry),
            Self::Completions { shell } => commands::completions(*shell, registry),
        }
    }
}
