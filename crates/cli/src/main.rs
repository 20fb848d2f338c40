//! The command `adslam`.

use std::process::ExitCode;

use adslam_cli::Arguments;
use clap::Parser;

fn main() -> ExitCode {
    let interrupt = adslam_cli::stop_on_ctrl_c();
    adslam_cli::exit_code(Arguments::parse().command.execute(interrupt))
}
