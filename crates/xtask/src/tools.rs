//! The tools of the checks. Small ones are installed; for those that take long to build, a command is suggested.

use std::path::Path;

use crate::command;

/// Ensures that rustfmt and clippy are installed, which a minimal toolchain lacks.
///
/// # Errors
/// A message that names the tool that is missing and cannot be installed.
pub(crate) fn ensure(root: &Path) -> Result<String, String> {
    for (tool, component) in [("cargo fmt", "rustfmt"), ("cargo clippy", "clippy")] {
        if !command::succeeds(root, &format!("{tool} --version")) {
            command::run(command::words(root, &format!("rustup component add {component}")))
                .map_err(|why| format!("`{tool}` is missing and cannot be installed: {why}"))?;
        }
    }
    Ok(if has_nextest(root) {
        "rustfmt, clippy, nextest".to_owned()
    } else {
        // a build from source takes minutes, more than the tool saves here
        "rustfmt, clippy; tests run through `cargo test`\n\
         hint: cargo-nextest runs them faster; get it built from https://nexte.st"
            .to_owned()
    })
}

/// Whether `cargo nextest` is installed.
pub(crate) fn has_nextest(root: &Path) -> bool {
    command::succeeds(root, "cargo nextest --version")
}
