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

/// A run of `vibro` with a time limit.
fn vibro(line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vibro"));
    command.args(line.split_whitespace()).timeout(std::time::Duration::from_secs(60));
    command
}

/// The JSON object a command prints.
fn json(line: &str) -> Value {
    let output = vibro(line).arg("--json").output().expect("vibro runs");
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{line}: {complaint}");
    serde_json::from_slice(&output.stdout).expect("stdout is one JSON object")
}

/// S of the 1971 paper, where two motions coexist.
const S: &str = "--inverse-beta 1.3 --gap 0.75 --restitution 0.5";
