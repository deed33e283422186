//! Ctrl-C: the first asks for a clean stop, the second ends at once.
//!
//! Work that checks the flag stops within milliseconds. A single motion that takes longer cannot hold the program: a
//! little later it ends anyhow, just as cleanly, because files appear only when they are complete.

use crate::complain::complain;
use crate::failure::Failure;
use crate::files;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
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

/// Does one piece of work that knows no stop flag, and leaves it behind when asked to stop.
pub(crate) fn interruptible<T: Send + 'static>(
    what: &str,
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<T, Failure> {
    let (sender, receiver) = channel();
    // if the receiver is gone, so is the wish for the result
    let worker = move || drop(sender.send(work()));
    std::thread::Builder::new()
        .spawn(worker)
        .map_err(|error| Failure::Failed(format!("cannot start a thread: {error}")))?;
    loop {
        match receiver.recv_timeout(Duration::from_millis(50)) {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Timeout) if STOP.load(Ordering::Relaxed) => {
                return Err(Failure::Stopped(format!("while {what}; nothing was written")));
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Failure::Failed(format!("{what} ended without a result")));
            }
        }
    }
}
