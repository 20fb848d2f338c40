//! Ctrl-C, and the signals by which a system ends a program.

use std::io;

use adslam_diagnostics::Interrupt;

use crate::print::tell;

static INTERRUPT: Interrupt = Interrupt::new();

/// Makes Ctrl-C, SIGTERM and SIGHUP ask long work to stop at the next step, so that what is finished is still
/// written. A second one ends the program at once.
pub fn stop_on_signals() -> &'static Interrupt {
    // Without a handler they still end the program, only less gently.
    if let Err(cause) = listen() {
        tell(format_args!(
            "warning: Ctrl-C will not wait for the files to be written: {cause}"
        ));
    }
    &INTERRUPT
}

fn on_signal() {
    if INTERRUPT.requested() {
        std::process::exit(i32::from(crate::INTERRUPTED));
    }
    INTERRUPT.request();
}

#[cfg(unix)]
fn listen() -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let mut wanted = vec![SIGINT, SIGTERM];
    if !hangups_are_ignored() {
        wanted.push(SIGHUP);
    }
    let mut signals = Signals::new(wanted)?;
    let wait = move || signals.forever().for_each(|_| on_signal());
    std::thread::Builder::new()
        .name("signals".to_owned())
        .spawn(wait)?;
    Ok(())
}

/// Whether whoever started this program wants it to outlive the terminal, as `nohup` does. What is ignored here is
/// ignored by a child too, so a shell that hangs up itself says it: no safe call asks.
#[cfg(unix)]
fn hangups_are_ignored() -> bool {
    use std::process::{Command, Stdio};
    let survives = Command::new("sh")
        .args(["-c", "kill -HUP $$"])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    survives.is_ok_and(|status| status.success())
}

#[cfg(not(unix))]
fn listen() -> io::Result<()> {
    ctrlc::set_handler(on_signal).map_err(io::Error::other)
}
