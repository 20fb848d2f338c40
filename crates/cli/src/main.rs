//! The command `adslam`.

use std::process::ExitCode;

use adslam_cli::Arguments;
use adslam_diagnostics::Interrupt;
use clap::Parser;

fn main() -> ExitCode {
    let command = Arguments::parse().command;
    let never = Interrupt::new();
    let interrupt = if command.heeds_interrupts() {
        adslam_cli::stop_on_signals()
    } else {
        &never
    };
    adslam_cli::exit_code(command.execute(interrupt))
}
