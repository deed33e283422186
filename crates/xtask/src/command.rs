//! Other programs, which are started in the root of the repository and never prompt.

use std::io::{self, BufRead, BufReader, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

/// The root of the repository this program was started in.
pub(crate) fn root() -> PathBuf {
    // cargo sets the variable at run time; the compiled value is used when the program is started without cargo
    let here =
        std::env::var_os("CARGO_MANIFEST_DIR").map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    here.ancestors().nth(2).map_or(here.clone(), Path::to_path_buf)
}

/// The target folder of cargo.
///
/// # Errors
/// An error message if cargo does not report it.
pub(crate) fn target(root: &Path) -> Result<PathBuf, String> {
    let metadata = metadata(root, "--no-deps")?;
    let target = metadata["target_directory"].as_str().ok_or("`cargo metadata` names no target directory")?;
    Ok(PathBuf::from(target))
}

/// The metadata of the packages from cargo.
///
/// # Errors
/// An error message if cargo does not report them.
pub(crate) fn metadata(root: &Path, switches: &str) -> Result<Value, String> {
    let output = words(root, &format!("cargo metadata --format-version 1 {switches}"))
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| format!("`cargo metadata` cannot be started: {error}"))?;
    if !output.status.success() {
        return Err(format!("`cargo metadata` ended with {}", output.status));
    }
    serde_json::from_slice(&output.stdout)
        .map_err(|error| format!("the answer of `cargo metadata` cannot be read: {error}"))
}

/// A command from the line that a user would type: words separated by blanks, without quoting.
pub(crate) fn words(root: &Path, line: &str) -> Command {
    let mut words = line.split_whitespace();
    let mut command = Command::new(words.next().unwrap_or_default());
    command.args(words).current_dir(root).stdin(Stdio::null());
    // variables that cargo sets for this program are removed, because some build scripts would run again for them
    for (name, _) in std::env::vars_os() {
        let plain = name.to_string_lossy();
        if plain.starts_with("CARGO_PKG_") || plain.starts_with("CARGO_MANIFEST_") {
            command.env_remove(&name);
        }
    }
    command
}

/// Whether the command exists and succeeds. Its output is discarded.
pub(crate) fn succeeds(root: &Path, line: &str) -> bool {
    run_quietly(&mut words(root, line)).is_ok()
}

/// Runs a command with its own output.
///
/// # Errors
/// An error message if it cannot be started, or with its exit status if it fails.
pub(crate) fn run(mut command: Command) -> Result<(), String> {
    let outcome = command.status();
    verdict(&command, outcome)
}

/// Runs a command and discards its output.
///
/// # Errors
/// As [`run`].
pub(crate) fn run_quietly(command: &mut Command) -> Result<(), String> {
    let outcome = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
    verdict(command, outcome)
}

/// Runs a command, copies every line to the terminal at once, and passes it to `read` without colours.
///
/// # Errors
/// As [`run`].
pub(crate) fn run_reading(mut command: Command, mut read: impl FnMut(&str)) -> Result<(), String> {
    if io::stdout().is_terminal() {
        // without this, the tools would print no colours into a pipe
        command.env("CARGO_TERM_COLOR", "always");
    }
    let program = command.get_program().to_string_lossy().into_owned();
    let broken = |error: io::Error| format!("the output of `{program}` cannot be read: {error}");

    // one pipe for both streams keeps the lines in order
    let (reader, writer) = io::pipe().map_err(broken)?;
    command.stdout(writer.try_clone().map_err(broken)?).stderr(writer);
    let mut child = command.spawn().map_err(|error| not_started(&command, &error))?;
    // the command holds the writing ends of the pipe; reading ends only when they are closed
    drop(command);

    let mut reader = BufReader::new(reader);
    let mut line = Vec::new();
    while reader.read_until(b'\n', &mut line).map_err(broken)? > 0 {
        // continue to count even if the terminal is gone
        let _ = io::stdout().write_all(&line);
        let _ = io::stdout().flush();
        read(without_colours(&String::from_utf8_lossy(&line)).trim_end());
        line.clear();
    }
    let status = child.wait().map_err(broken)?;
    if status.success() { Ok(()) } else { Err(format!("`{program}` ended with {status}")) }
}

/// Copies the files of a folder without subfolders.
///
/// # Errors
/// An error message that names both folders.
pub(crate) fn copy(from: &Path, to: &Path) -> Result<(), String> {
    let failed = |error: io::Error| format!("cannot copy {} to {}: {error}", from.display(), to.display());
    std::fs::create_dir_all(to).map_err(failed)?;
    for entry in std::fs::read_dir(from).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if entry.path().is_file() {
            std::fs::copy(entry.path(), to.join(entry.file_name())).map_err(failed)?;
        }
    }
    Ok(())
}

fn verdict(command: &Command, outcome: io::Result<std::process::ExitStatus>) -> Result<(), String> {
    let program = command.get_program().to_string_lossy();
    match outcome {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{program}` ended with {status}")),
        Err(error) => Err(not_started(command, &error)),
    }
}

fn not_started(command: &Command, error: &io::Error) -> String {
    format!("`{}` cannot be started: {error}", command.get_program().to_string_lossy())
}

/// The line without terminal sequences of the form `ESC [ ... letter`.
fn without_colours(line: &str) -> String {
    let mut plain = String::with_capacity(line.len());
    let mut rest = line;
    while let Some((before, after)) = rest.split_once("\u{1b}[") {
        plain.push_str(before);
        rest = after.find(|c: char| c.is_ascii_alphabetic()).map_or("", |end| &after[end + 1..]);
    }
    plain.push_str(rest);
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_dropped_and_the_words_kept() {
        assert_eq!(without_colours("\u{1b}[32;1m   Summary\u{1b}[0m [x]"), "   Summary [x]");
        assert_eq!(without_colours("plain"), "plain");
        assert_eq!(without_colours("cut\u{1b}[3"), "cut");
    }

    #[test]
    fn the_root_holds_the_workspace() {
        assert!(root().join("Cargo.toml").is_file());
        assert!(root().join("crates/xtask").is_dir());
    }

    #[test]
    fn both_streams_are_read_and_a_failure_is_a_sentence() {
        let mut seen = String::new();
        let error = run_reading(words(&root(), "cargo --no-such-switch"), |line| {
            seen.push_str(line);
        });
        assert!(seen.contains("--no-such-switch"), "{seen}");
        assert!(error.is_err_and(|sentence| sentence.starts_with("`cargo` ended with ")));
    }

    #[test]
    fn a_missing_program_is_named() {
        let error = run(words(&root(), "no-such-program-anywhere --version"));
        assert!(error.is_err_and(|sentence| sentence.contains("`no-such-program-anywhere`")));
    }
}
