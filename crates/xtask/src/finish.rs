//! How a command of xtask ends.

use std::process::ExitCode;

/// Prints what a check found, and turns it into an exit status.
pub(crate) fn finish(outcome: Result<String, String>) -> ExitCode {
    match outcome {
        Ok(sentence) => {
            println!("{sentence}");
            ExitCode::SUCCESS
        }
        Err(sentence) => {
            eprintln!("{sentence}");
            ExitCode::FAILURE
        }
    }
}
