//! `cargo xtask docs`: the API documentation with typeset formulas. A warning is a failure.

use std::path::{Path, PathBuf};

use crate::command;

/// The page header that loads KaTeX, from the root of the repository.
const HEADER: &str = "docs/katex-header.html";

/// The command. With a target that needs the packages of the tests, here an example, all packages have the features that the
/// lints checked them with.
const DOCUMENT: &str = "cargo doc --workspace --all-features --no-deps --lib --bin xtask --example branch";

/// Builds the documentation of every crate of the workspace.
///
/// # Errors
/// An error message with the exit status of cargo; rustdoc has printed its own messages.
pub(crate) fn build(root: &Path) -> Result<String, String> {
    let header = root.join(HEADER);
    if !header.is_file() {
        return Err(format!("{HEADER} is missing; the formulas of the documentation need it"));
    }
    let mut command = command::words(root, DOCUMENT);
    // rustdoc needs the absolute path, and the encoded form allows blanks in it
    let flags = ["-D", "warnings", "--html-in-header", &header.to_string_lossy()].join("\u{1f}");
    command.env("CARGO_ENCODED_RUSTDOCFLAGS", flags);
    if let Some((clippy, arguments)) = clippy(root) {
        command.env("RUSTC_WORKSPACE_WRAPPER", clippy).env("CLIPPY_ARGS", arguments);
    }
    command::run(command)?;
    Ok("no warning from rustdoc".to_owned())
}

/// The compiler of the lints and its arguments, as `cargo clippy -- -D warnings` calls it: what the lints checked is then not
/// checked a second time for rustdoc, which saves half of the time. Without it the documentation is the same.
fn clippy(root: &Path) -> Option<(PathBuf, String)> {
    let rustc = command::words(root, "rustc --print sysroot").output().ok()?;
    let clippy = Path::new(String::from_utf8(rustc.stdout).ok()?.trim()).join("bin/clippy-driver");
    let arguments = ["-D", "warnings", ""].join("__CLIPPY_HACKERY__");
    clippy.is_file().then_some((clippy, arguments))
}
