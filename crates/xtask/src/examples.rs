//! `cargo xtask examples`: runs the examples of the core, each of which prints a table.

use std::path::Path;
use std::process::Stdio;

use crate::command;

/// The folder of the examples, from the root of the repository.
const FOLDER: &str = "crates/vibroimpact/examples";
/// The command that builds them, with the settings of the tests, which build them too. Nothing is built again.
const BUILD: &str = "cargo build --workspace --profile test --examples";

/// Builds and runs all examples.
///
/// # Errors
/// A message that names an example that fails or prints nothing.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    command::run(command::words(root, BUILD))?;
    let programs = command::target(root)?.join("debug/examples");
    let entries = std::fs::read_dir(root.join(FOLDER)).map_err(|error| format!("{FOLDER}: {error}"))?;
    let mut names: Vec<String> =
        entries.filter_map(|entry| Some(entry.ok()?.path().file_stem()?.to_string_lossy().into_owned())).collect();
    names.sort_unstable();
    for name in &names {
        let mut program = command::words(root, &programs.join(name).to_string_lossy());
        let output = program.stdin(Stdio::null()).output().map_err(|error| format!("the example {name}: {error}"))?;
        if !output.status.success() || output.stdout.is_empty() {
            let words = String::from_utf8_lossy(&output.stderr);
            return Err(format!("the example {name} ends with {}, and prints: {words}", output.status));
        }
    }
    Ok(format!("{} examples print what they compute", names.len()))
}
