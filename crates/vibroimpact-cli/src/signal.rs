//! Ctrl-C: the first one requests a clean stop, the second one ends the program at once.
//!
//! Work that reads the stop flag ends within milliseconds. If other work takes longer, the program ends after a few
//! seconds without waiting for it. This is safe, because output files appear only when they are complete.

use crate::exit::complain;
use crate::files;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

static STOP: AtomicBool = AtomicBool::new(false);

/// The stop flag, which is set by Ctrl-C.
pub(crate) fn flag() -> &'static AtomicBool {
    &STOP
}

/// Installs the handler. If this fails, Ctrl-C ends the program at once.
pub(crate) fn listen() {
    let _ = ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::Relaxed) {
            end();
        }
        std::thread::spawn(|| {
            std::thread::sleep(PATIENCE);
            complain("stopped in the middle of a long motion; nothing is left half-written");
            end();
        });
    });
}

/// Time limit for a clean stop.
const PATIENCE: Duration = Duration::from_secs(3);

fn end() -> ! {
    files::sweep();
    std::process::exit(130)
}
