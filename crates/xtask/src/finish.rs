//! The end of a command of xtask.

use std::process::ExitCode;

/// Prints the result of a check, and converts it to an exit status.
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
