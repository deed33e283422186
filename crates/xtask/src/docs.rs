//! `cargo xtask docs`: the API documentation with typeset formulas. A warning is a failure.

use std::path::Path;

use crate::command;

/// The page header that loads KaTeX, from the root of the repository.
const HEADER: &str = "docs/katex-header.html";

/// The command. With a target that needs the packages of the tests, here an example, all packages have the features that the
/// lints checked them with, and are not checked again.
const DOCUMENT: &str = "cargo doc --workspace --all-features --no-deps --lib --bin vibro --bin xtask --example branch";

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
    command::run(command)?;
    Ok("no warning from rustdoc".to_owned())
}
