//! The invariants of ARCHITECTURE.md that can be read off the source: the core is pure, and each outside thing has one
//! owner.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fs;
use std::path::{Path, PathBuf};

fn sources(dir: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files
}

/// Code lines of a crate that mention one of `words`, comments and tests left out.
fn mentions(source: &Path, words: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for file in sources(source) {
        let text = fs::read_to_string(&file).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap();
        for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
            if words.iter().any(|word| line.contains(word)) {
                found.push(format!("{}: {}", file.display(), line.trim()));
            }
        }
    }
    found
}

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

#[test]
fn the_core_is_pure() {
    let outside = [
        "std::fs",
        "std::io",
        "std::thread",
        "std::time",
        "std::env",
        "std::net",
        "std::process",
        "println!",
        "serde",
        "rand::",
        "log::",
        "static mut",
        "thread_local",
        "Mutex",
        "Atomic",
    ];
    let found = mentions(&crates().join("vibroimpact/src"), &outside);
    assert!(found.is_empty(), "{}", found.join("\n"));
    let manifest = fs::read_to_string(crates().join("vibroimpact/Cargo.toml")).unwrap();
    let needs = manifest.split("[dependencies]").nth(1).unwrap().split("\n[").next().unwrap();
    let names: Vec<&str> =
        needs.lines().filter_map(|line| line.split(['.', ' ', '=']).next()).filter(|n| !n.is_empty()).collect();
    assert_eq!(names, ["libm", "thiserror"]);
}

#[test]
fn each_outside_thing_has_one_owner() {
    // threads belong to the study, disks to the store, pictures and reports own no files, the terminal belongs to the command
    let none: [(&str, &[&str]); 4] = [
        ("vibroimpact-plot/src", &["std::fs", "std::thread", "rayon", "println!"]),
        ("vibroimpact-report/src", &["std::fs", "std::thread", "rayon", "println!", "clap"]),
        ("vibroimpact-study/src", &["println!", "eprintln!", "indicatif", "clap", "std::fs", "zstd"]),
        ("vibroimpact-store/src", &["println!", "eprintln!", "indicatif", "clap"]),
    ];
    for (source, words) in none {
        let found = mentions(&crates().join(source), words);
        assert!(found.is_empty(), "{}", found.join("\n"));
    }
}
