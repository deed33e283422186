//! `cargo xtask release`: what must hold before the crates are published, beside the tests.
//!
//! The workspace compiles with the oldest Rust that it names, and each crate that is published is packed, and built from its archive.

use std::path::Path;

use crate::command;

/// Packs all crates that are published, and builds each from its archive.
const PACK: &str = "cargo package --workspace --exclude xtask --exclude vibroimpact-fuzz --exclude vibroimpact-py";

/// Checks both.
///
/// # Errors
/// The sentence that says which one failed; cargo has printed why.
pub(crate) fn check(root: &Path) -> Result<String, String> {
    let oldest = oldest(root)?;
    if !command::succeeds(root, &format!("rustc +{oldest} --version")) {
        command::run(command::words(root, &format!("rustup toolchain install {oldest} --profile minimal")))
            .map_err(|why| format!("Rust {oldest} is not here and cannot be installed: {why}"))?;
    }
    // in a folder of its own, or all would be built anew for the present Rust
    let folder = command::target(root)?.join("oldest");
    let mut compile = command::words(root, &format!("cargo +{oldest} check --workspace --all-features"));
    compile.env("CARGO_TARGET_DIR", folder);
    command::run(compile)?;
    command::run(command::words(root, PACK))?;
    Ok(format!("the workspace compiles with Rust {oldest}, and the crates are packed in target/package"))
}

/// The oldest Rust that the manifest names.
fn oldest(root: &Path) -> Result<String, String> {
    let metadata = command::metadata(root, "--no-deps")?;
    let version = metadata["packages"][0]["rust_version"].as_str();
    version.map(str::to_owned).ok_or_else(|| "the manifest names no oldest Rust".to_owned())
}
