//! Printing. A reader that has gone away, as in `adslam … | head`, is no reason to panic or to lose work.

use std::fmt::Display;
use std::io::{ErrorKind, Write, stderr, stdout};

use adslam_diagnostics::Failure;

/// Prints what was asked for on the standard output.
///
/// # Errors
/// [`Failure::Output`] where it cannot be written, as to a file on a full disk.
pub(crate) fn print(text: impl Display) -> Result<(), Failure> {
    let mut out = stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(cause) if cause.kind() != ErrorKind::BrokenPipe => Err(Failure::Output {
            path: "the standard output".into(),
            cause,
        }),
        _ => Ok(()),
    }
}

/// Prints a line for people on the standard output, if that is possible: results are files, and verdicts exit codes.
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
