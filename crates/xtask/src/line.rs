//! `cargo xtask line`: the worked study of `docs/orbits.md`, its table and its figure, computed anew.

use std::path::Path;

use crate::command;

/// Runs the program that writes them.
///
/// # Errors
/// The sentence that says which step failed.
pub(crate) fn write(root: &Path) -> Result<String, String> {
    command::run(command::words(root, "cargo run --release -p fukaya-irie-1971 --example line"))?;
    Ok("docs/orbits.md and docs/line.png written".to_owned())
}
