//! `cargo xtask line`: computes the worked study of `docs/orbits.md`, its table and its figure.

use std::path::Path;

use crate::command;

/// Runs the program that writes them.
///
/// # Errors
/// A message that names the step that failed.
pub(crate) fn write(root: &Path) -> Result<String, String> {
    command::run(command::words(root, "cargo run --release -p fukaya-irie-1971 --example line"))?;
    Ok("docs/orbits.md and docs/line.png written".to_owned())
}
