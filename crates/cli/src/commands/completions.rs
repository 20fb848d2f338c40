//! `adslam completions`

use clap::CommandFactory;
use clap_complete::Shell;

use crate::Arguments;
use crate::print::say;

/// Prints a script that makes a shell complete the command's arguments.
pub fn completions(shell: Shell) {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "adslam", &mut script);
    say(String::from_utf8_lossy(&script).trim_end());
}
