//! Tests that the driver finds faults where there are some, and draws the same cases from the same seed.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn fuzz(vibro: &Path, line: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vibroimpact-fuzz"));
    command.args(line.split(' ')).arg("--vibro").arg(vibro).output().expect("the driver runs")
}

/// A program that replaces `vibro`.
fn instead(folder: &Path, script: &str) -> PathBuf {
    let path = folder.join("vibro");
    fs::write(&path, format!("#!/bin/sh\n{script}\n")).expect("a script is written");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).expect("a script may be run");
    path
}

#[test]
fn planted_faults_are_found() {
    for (script, sentence) in [
        ("echo \"thread 'main' panicked at src/x.rs:1\" >&2; exit 101", "exit code 101"),
        ("kill -SEGV $$", "it was killed"),
        ("exit 2", "no sentence says why"),
        ("echo 'error: called `Option::unwrap()` on a `None` value' >&2; exit 2", "a message says"),
        ("echo half; echo 'error: gap = 1' >&2; exit 1", "5 bytes on stdout"),
        ("touch out.csv; echo 'error: gap = 1' >&2; exit 1", "a file `out.csv` is left"),
        ("echo '{\"beta\":NaN}'; exit 0", "the JSON does not read"),
        ("date +%N; exit 0", "has another answer"),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let output = fuzz(&instead(folder.path(), script), "--only commands --seed 1 --cases 20 --seconds 60");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.code(), Some(1), "{script}: {text}");
        assert!(text.contains(sentence), "{script}: {text}");
        assert!(text.contains("again: cargo xtask fuzz --seed 1 --only commands --case "), "{script}: {text}");
        assert!(text.trim_end().ends_with("test result: FAILED. 0 passed; 1 failed"), "{script}: {text}");
    }
}

#[test]
fn the_same_seed_asks_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept = folder.path().join("asked");
    let script = format!("echo \"$@\" >> '{}'; echo 'error: a refusal' >&2; exit 2", kept.display());
    let asked = |seed: u64| {
        let vibro = instead(folder.path(), &script);
        let output = fuzz(&vibro, &format!("--only commands --seed {seed} --cases 40 --seconds 60"));
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
        let text = fs::read_to_string(&kept).expect("something was asked");
        fs::remove_file(&kept).expect("it is there");
        text
    };
    let first = asked(1);
    assert!(first.lines().count() >= 40, "{first}");
    assert_eq!(first, asked(1));
    assert_ne!(first, asked(2));
}

#[test]
fn nonsense_is_refused() {
    let output = fuzz(Path::new("vibro"), "--quick 1");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("Usage: cargo xtask fuzz"));
}
