//! Ctrl-C.

use adslam_experiment::run::Interrupt;

use crate::print::tell;

static INTERRUPT: Interrupt = Interrupt::new();

/// Makes Ctrl-C ask long work to stop at the next step, so that what is finished is still written.
/// Pressed a second time it ends the program at once.
pub fn stop_on_ctrl_c() -> &'static Interrupt {
    let handler = || {
        if INTERRUPT.requested() {
            std::process::exit(i32::from(crate::INTERRUPTED));
        }
        INTERRUPT.request();
    };
    // Without a handler Ctrl-C still ends the program, only less gently.
    if ctrlc::set_handler(handler).is_err() {
        tell("warning: Ctrl-C will not wait for the files to be written");
    }
    &INTERRUPT
}
