//! The tools the checks need: what is small is installed, what is slow to build is suggested.

use std::path::Path;

use crate::command;

/// Makes sure of rustfmt and clippy, which a minimal toolchain leaves out.
///
/// # Errors
/// The sentence that says which one is missing and cannot be installed.
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
        // built from source it takes minutes, more than it saves here
        "rustfmt, clippy; tests run through `cargo test`\n\
         hint: cargo-nextest runs them faster; get it built from https://nexte.st"
            .to_owned()
    })
}

/// True where `cargo nextest` can run the tests.
pub(crate) fn has_nextest(root: &Path) -> bool {
    command::succeeds(root, "cargo nextest --version")
}
