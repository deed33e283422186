//! Tests of the `vibro` command from outside: answers, refusals, files, and random arguments.

mod answers;
mod arguments;
mod branches;
mod colours;
mod contact;
mod diagrams;
mod edge;
mod edges;
mod excitation;
mod figures;
mod files;
mod help;
mod lyapunov;
mod machine_studies;
mod machines;
mod many;
mod margins;
mod overlays;
mod planes;
mod questions;
mod refusals;
mod stability;
mod states;
mod studies;
mod summaries;
mod units;
mod vocabulary;

use assert_cmd::Command;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// A run of `vibro` with a time limit.
fn vibro(line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vibro"));
    command.args(line.split_whitespace()).timeout(std::time::Duration::from_secs(60));
    command
}

/// The exit code of `vibro` in a folder, what it prints, and what it complains of.
fn ran(folder: impl AsRef<Path>, line: &str) -> (Option<i32>, String, String) {
    let output = vibro(line).current_dir(folder).output().expect("vibro runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// What a command that succeeds prints in a folder.
fn printed_in(folder: impl AsRef<Path>, line: &str) -> String {
    let (code, printed, complaint) = ran(folder, line);
    assert_eq!(code, Some(0), "{line}: {complaint}");
    printed
}

fn printed(line: &str) -> String {
    printed_in(".", line)
}

/// The complaint of a command that refuses in a folder.
fn refused_in(folder: impl AsRef<Path>, line: &str) -> String {
    let (code, printed, complaint) = ran(folder, line);
    assert_eq!((code, printed.as_str()), (Some(2), ""), "{line}: {complaint}");
    complaint
}

fn refused(line: &str) -> String {
    refused_in(".", line)
}

/// The JSON object a command prints.
fn json(line: &str) -> Value {
    serde_json::from_str(&printed(&format!("{line} --json"))).expect("stdout is one JSON object")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// All files in a folder and below, by their names from there.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.strip_prefix(folder).expect("it is inside").display().to_string();
        if path.is_dir() {
            found.extend(files(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)));
        } else {
            found.insert(name, std::fs::read(&path).expect("a file"));
        }
    }
    found
}

/// A machine file in a folder of its own.
fn machine_file(machine: &str) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("machine.toml");
    std::fs::write(&path, machine).expect("it can be written");
    (folder, path)
}

/// S of the 1971 paper, where two motions coexist.
const S: &str = "--inverse-beta 1.3 --gap 0.75 --restitution 0.5";
