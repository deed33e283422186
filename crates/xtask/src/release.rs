//! `cargo xtask release`: checks before the crates are published, in addition to the tests.
//!
//! The workspace must compile with the oldest Rust that it names. Each published crate is packed, and built from its
//! archive. The Python package is built and installed with pip.

use std::path::Path;

use crate::command;

/// Packs all published crates, and builds each from its archive.
const PACK: &str = "cargo package --workspace --exclude xtask --exclude vibroimpact-cases --exclude vibroimpact-fuzz --exclude vibroimpact-py";

/// Runs both checks.
///
/// # Errors
/// A message that names the failed check; cargo has printed the reason.
pub(crate) fn check(root: &Path) -> Result<String, String> {
    let oldest = oldest(root)?;
    if !command::succeeds(root, &format!("rustc +{oldest} --version")) {
        command::run(command::words(root, &format!("rustup toolchain install {oldest} --profile minimal")))
            .map_err(|why| format!("Rust {oldest} is not here and cannot be installed: {why}"))?;
    }
    // in a separate folder, so that the crates need not be built again for the current Rust
    let folder = command::target(root)?.join("oldest");
    let mut compile = command::words(root, &format!("cargo +{oldest} check --workspace --all-features"));
    compile.env("CARGO_TARGET_DIR", folder);
    command::run(compile)?;
    command::run(command::words(root, PACK))?;
    wheel(root)?;
    Ok(format!(
        "the workspace compiles with Rust {oldest}, and the crates and the Python package build from their packages"
    ))
}

/// Installs the Python package with pip in an environment of its own, as its users do, and settles one motion.
fn wheel(root: &Path) -> Result<(), String> {
    command::run(command::words(root, "python3 -m venv --clear target/wheel"))?;
    command::run(command::words(root, "target/wheel/bin/python -m pip install --quiet --disable-pip-version-check ."))?;
    let mut settle = command::words(root, "target/wheel/bin/python -W error -c");
    settle.arg("import vibroimpact as vi; print(vi.settle(vi.Oscillator(beta=0.4, gap=0.5, restitution=0.8)))");
    command::run(settle)
}

/// The oldest Rust named in the manifest.
fn oldest(root: &Path) -> Result<String, String> {
    let metadata = command::metadata(root, "--no-deps")?;
    let version = metadata["packages"][0]["rust_version"].as_str();
    version.map(str::to_owned).ok_or_else(|| "the manifest names no oldest Rust".to_owned())
}
