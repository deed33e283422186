//! `cargo xtask wasm`: checks that the crates a page could use compile for WebAssembly. These are all but the store,
//! the server, the command and the Python package.

use std::path::Path;

use crate::command;

const TARGET: &str = "wasm32-unknown-unknown";
const CRATES: [&str; 4] = ["vibroimpact", "vibroimpact-study", "vibroimpact-plot", "vibroimpact-report"];

/// Checks these crates for the target, which rustup installs if possible.
///
/// # Errors
/// A message with the exit status of cargo.
pub(crate) fn check(root: &Path) -> Result<String, String> {
    if !command::succeeds(root, &format!("rustup target add {TARGET}")) {
        return Ok(format!("skipped: the target {TARGET} is not there, and rustup cannot install it"));
    }
    let crates: Vec<String> = CRATES.iter().map(|name| format!("-p {name}")).collect();
    command::run(command::words(root, &format!("cargo check --target {TARGET} {}", crates.join(" "))))?;
    Ok(format!("{} crates compile for {TARGET}", CRATES.len()))
}
