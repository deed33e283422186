//! Ctrl-C: the first asks for a clean stop, the second ends at once.
//!
//! Work that checks the flag stops within milliseconds. A single motion that takes longer cannot hold the program: a
//! little later it ends anyhow, just as cleanly, because files appear only when they are complete.

use crate::complain::complain;
use crate::files;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

static STOP: AtomicBool = AtomicBool::new(false);

/// Set once someone asked to stop.
pub(crate) fn flag() -> &'static AtomicBool {
    &STOP
}

/// Listens from now on. Where no handler can be installed, Ctrl-C simply ends the program.
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

/// How long a clean stop may take.
const PATIENCE: Duration = Duration::from_secs(3);

fn end() -> ! {
    files::sweep();
    std::process::exit(130)
}
