//! How a run ends: 0 done, 1 failed, 2 bad question, 130 stopped.

use crate::complain::complain;
use crate::failure::Failure;
use std::process::ExitCode;

/// Says what went wrong and turns it into the exit code.
pub(crate) fn code(end: Result<(), Failure>) -> ExitCode {
    let Err(failure) = end else {
        return ExitCode::SUCCESS;
    };
    let code = match failure {
        Failure::PipeClosed => return ExitCode::SUCCESS,
        Failure::Failed(_) => 1,
        Failure::BadQuestion(_) => 2,
        Failure::Stopped(_) => {
            complain(&format!("stopped: {}", failure.to_string().trim_start_matches("stopped ")));
            return ExitCode::from(130);
        }
    };
    complain(&format!("error: {failure}"));
    ExitCode::from(code)
}

/// Help and version are answers; what does not parse is a bad question.
pub(crate) fn parsed(refusal: &clap::Error) -> ExitCode {
    // where even this cannot be written there is no one left to tell
    let _ = refusal.print();
    ExitCode::from(if refusal.use_stderr() { 2 } else { 0 })
}

/// A defect of ours ends with a sentence someone can report, not with a backtrace.
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
