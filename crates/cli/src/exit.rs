//! Errors for people, and exit codes for scripts.

use std::process::ExitCode;

use adslam_diagnostics::Failure;

use crate::print::tell;

/// The work failed: the covariance broke down, the disk is full.
pub const FAILURE: u8 = 1;
/// The input cannot be used. The argument parser ends with it too.
pub const BAD_INPUT: u8 = 2;
/// Stopped by Ctrl-C, SIGTERM or SIGHUP.
pub const INTERRUPTED: u8 = 130;

/// Prints what went wrong, if anything did, and returns the exit code.
#[must_use]
pub fn exit_code(result: Result<(), Failure>) -> ExitCode {
    let Err(error) = result else {
        return ExitCode::SUCCESS;
    };
    let code = code(&error);
    tell(format_args!("{:?}", miette::Report::new(error)));
    ExitCode::from(code)
}

/// The exit code of an error.
pub(crate) fn code(error: &Failure) -> u8 {
    match error {
        Failure::Interrupted => INTERRUPTED,
        error if error.is_bad_input() => BAD_INPUT,
        _ => FAILURE,
    }
}
