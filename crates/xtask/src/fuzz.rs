//! `cargo xtask fuzz`: random and adversarial questions to the command, to plans, stores and the explorer.
//!
//! The driver is a program of its own, built together with the command as the other tests build it.

use std::path::Path;
use std::process::ExitCode;

use crate::command;
use crate::finish::finish;

/// The command and the driver, as the tests of the workspace need them.
const BUILD: &str = "cargo test --workspace --all-features --no-run --test cli --test fuzz";
/// The driver among what is built.
const PROGRAM: &str = "debug/vibroimpact-fuzz";

/// Builds both and runs the driver with these words; its exit status is the answer.
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
