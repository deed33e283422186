//! The exit code: 0 done, 1 failed, 2 invalid question, 130 stopped; and messages on stderr.

use crate::failure::Failure;
use crate::units_typed;
use std::io::{self, Write};

/// Writes a line to stderr. A failure is ignored, because there is no other place to report it.
pub(crate) fn complain(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Prints the error, if any, and returns the exit code.
pub(crate) fn code(end: Result<(), Failure>) -> u8 {
    let Err(failure) = end else {
        return 0;
    };
    let code = match failure {
        Failure::PipeClosed => return 0,
        Failure::Failed(_) => 1,
        Failure::BadQuestion(_) => 2,
        Failure::Stopped(_) => {
            complain(&format!("stopped: {}", failure.to_string().trim_start_matches("stopped ")));
            return 130;
        }
    };
    complain(&format!("error: {failure}"));
    code
}

/// The exit code when the arguments are not parsed: 0 for help and version, 2 for an invalid command line.
pub(crate) fn parsed(refusal: &clap::Error) -> u8 {
    match units_typed::refusal(refusal) {
        Some(text) => complain(&text),
        // a failure to print cannot be reported anywhere
        None => drop(refusal.print()),
    }
    if refusal.use_stderr() { 2 } else { 0 }
}

/// Makes a panic end with a message that users can report instead of a backtrace.
pub(crate) fn no_backtraces() {
    std::panic::set_hook(Box::new(|defect| {
        let place = defect.location().map_or_else(String::new, |at| format!(" ({}:{})", at.file(), at.line()));
        complain(&format!(
            "error: this is a defect of vibro{place}, not of your question\nhint: please report it with the command line"
        ));
        crate::files::sweep();
        std::process::exit(1);
    }));
}
