//! `adslam completions`

use adslam_diagnostics::Failure;
use adslam_scenario::registry::Registry;
use clap_complete::Shell;

use crate::Arguments;
use crate::print::print;

/// Prints a script that makes a shell complete the command's arguments.
///
/// # Errors
/// A standard output that cannot be written to.
pub fn completions(shell: Shell, registry: &Registry) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(
        shell,
        &mut Arguments::command_with(registry),
        "adslam",
        &mut script,
    );
    print(String::from_utf8_lossy(&script).trim_end())
}
