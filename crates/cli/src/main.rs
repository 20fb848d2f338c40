//! The command `adslam`.

use std::process::ExitCode;

use adslam_scenario::registry::Registry;

fn main() -> ExitCode {
    adslam_cli::main_with(&Registry::standard())
}
