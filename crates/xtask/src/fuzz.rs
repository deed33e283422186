//! `cargo xtask fuzz`: random and adversarial questions to the command, plans, stores and the explorer.
//!
//! The driver is a separate program, built together with the command as for the other tests.

use std::path::Path;
use std::process::ExitCode;

use crate::command;
use crate::finish;

/// Builds the command and the driver in the form that the tests of the workspace need.
const BUILD: &str = "cargo test --workspace --no-run --test cli --test fuzz";
/// The path of the driver in the target folder.
const PROGRAM: &str = "debug/vibroimpact-fuzz";

/// Builds both, runs the driver with the given arguments, and returns its exit status.
pub(crate) fn run(root: &Path, words: &[&str]) -> ExitCode {
    let built = command::run(command::words(root, BUILD)).and_then(|()| command::target(root));
    let driver = built.and_then(|target| {
        let mut driver = command::words(root, &target.join(PROGRAM).to_string_lossy());
        driver.args(words);
        driver.status().map_err(|error| format!("the driver cannot be started: {error}"))
    });
    match driver {
        Ok(status) => ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1)),
        Err(sentence) => finish(Err(sentence)),
    }
}
