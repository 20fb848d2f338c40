//! Printing that never fails: a reader that has gone away, as in `adslam … | head`, is no reason to
//! panic or to lose work. Results are files, and verdicts are exit codes.

use std::fmt::Display;
use std::io::{Write, stderr, stdout};

/// Prints a line on the standard output.
pub(crate) fn say(text: impl Display) {
    let _ = writeln!(stdout().lock(), "{text}");
}

/// Prints a line on the standard error stream.
pub(crate) fn tell(text: impl Display) {
    let _ = writeln!(stderr().lock(), "{text}");
}

/// Prints warnings on the standard error stream.
pub(crate) fn warn(warnings: &[String]) {
    for warning in warnings {
        tell(format_args!("warning: {warning}"));
    }
}
