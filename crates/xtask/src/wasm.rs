//! `cargo xtask wasm`: what a page could compute in the browser compiles for WebAssembly: all but the store, the server, the command and
//! the Python package.

use std::path::Path;

use crate::command;

const TARGET: &str = "wasm32-unknown-unknown";
const CRATES: [&str; 4] = ["vibroimpact", "vibroimpact-study", "vibroimpact-plot", "vibroimpact-report"];

/// Checks these crates for the target, which rustup installs where it can.
///
/// # Errors
/// The sentence that says how cargo ended.
pub(crate) fn check(root: &Path) -> Result<String, String> {
    if !command::succeeds(root, &format!("rustup target add {TARGET}")) {
        return Ok(format!("skipped: the target {TARGET} is not there, and rustup cannot install it"));
    }
    let crates: Vec<String> = CRATES.iter().map(|name| format!("-p {name}")).collect();
    command::run(command::words(root, &format!("cargo check --target {TARGET} {}", crates.join(" "))))?;
    Ok(format!("{} crates compile for {TARGET}", CRATES.len()))
}
