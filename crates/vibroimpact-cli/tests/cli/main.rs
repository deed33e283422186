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
mod pages;
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
use std::path::{Path, PathBuf};

/// A run of `vibro` with a time limit.
fn vibro(line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vibro"));
    command.args(line.split_whitespace()).timeout(std::time::Duration::from_secs(60));
    command
}

/// What a command that succeeds prints.
fn printed(line: &str) -> String {
    Folder::new().printed(line)
}

/// The complaint of a command that refuses.
fn refused(line: &str) -> String {
    Folder::new().refused(line)
}

/// Checks that commands refuse with these words.
fn refuse<L: AsRef<str>, W: AsRef<str>>(lines: impl IntoIterator<Item = (L, W)>) {
    Folder::new().refuse(lines);
}

/// The JSON object that a command prints.
fn json(line: &str) -> Value {
    Folder::new().json(line)
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

/// The text of this name in each object of a list.
fn texts<'a>(list: &'a Value, name: &str) -> Vec<&'a str> {
    crate::list(list).iter().map(|of| of[name].as_str().expect("a text")).collect()
}

/// The rows of a table, its head too.
fn rows(table: &str) -> Vec<Vec<&str>> {
    table.lines().map(|row| row.split(',').collect()).collect()
}

/// Checks that a text has all these parts.
fn has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// The line with few points along an axis, few starts, and without long searches that other tests have: what examples and
/// pages can do does not depend on their number.
fn with_few_points(line: &str) -> String {
    let fewer = |word: &str| match word.splitn(4, ':').collect::<Vec<_>>()[..] {
        [from, to, count, ..] if count.parse().is_ok_and(|count: u32| count > 5) => {
            word.replacen(&format!("{from}:{to}:{count}"), &format!("{from}:{to}:5"), 1)
        }
        _ => word.to_owned(),
    };
    let shorter = [
        ("--layers regions,", "--layers "),
        ("--starts 20", "--starts 2"),
        ("frequency=1:1.2", "frequency=1.1:1.2"),
        ("lhs:2000", "lhs:200"),
        ("lhs:1e4", "lhs:200"),
        ("lhs:1e5", "lhs:100"),
        ("0.7:1.3:", "1:1.2:"),
        ("--csv region.csv", "--grid 4 --csv region.csv"),
    ];
    let line = shorter.iter().fold(line.to_owned(), |line, (long, short)| line.replace(long, short));
    line.split(' ').map(fewer).collect::<Vec<_>>().join(" ")
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

/// A folder of its own, in which commands run. It is removed at the end of the test.
struct Folder(tempfile::TempDir);

impl AsRef<Path> for Folder {
    fn as_ref(&self) -> &Path {
        self.0.path()
    }
}

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    /// A folder with one file.
    fn with(name: &str, text: &str) -> Self {
        let folder = Self::new();
        folder.write(name, text);
        folder
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        std::fs::write(self.at(name), text).expect("it can be written");
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.at(name)).expect("a file")
    }

    fn read(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).expect("text")
    }

    /// All files of a folder in it, by their names from there.
    fn files(&self, name: &str) -> BTreeMap<String, Vec<u8>> {
        files(&self.at(name))
    }

    /// The number of files and folders in it.
    fn count(&self) -> usize {
        std::fs::read_dir(self).expect("a folder").count()
    }

    /// The exit code of `vibro` in it, what it prints, and what it complains of.
    fn ran(&self, line: &str) -> (Option<i32>, String, String) {
        let output = vibro(line).current_dir(self).output().expect("vibro runs");
        let text = |bytes| String::from_utf8(bytes).expect("text");
        (output.status.code(), text(output.stdout), text(output.stderr))
    }

    fn printed(&self, line: &str) -> String {
        let (code, printed, complaint) = self.ran(line);
        assert_eq!(code, Some(0), "{line}: {complaint}");
        printed
    }

    fn json(&self, line: &str) -> Value {
        serde_json::from_str(&self.printed(&format!("{line} --json"))).expect("stdout is one JSON object")
    }

    fn refused(&self, line: &str) -> String {
        let (code, printed, complaint) = self.ran(line);
        assert_eq!((code, printed.as_str()), (Some(2), ""), "{line}: {complaint}");
        complaint
    }

    /// Checks that commands refuse with these words.
    fn refuse<L: AsRef<str>, W: AsRef<str>>(&self, lines: impl IntoIterator<Item = (L, W)>) {
        for (line, words) in lines {
            let (line, words) = (line.as_ref(), words.as_ref());
            let complaint = self.refused(line);
            assert!(complaint.contains(words), "{line}: {complaint}\nwanted: {words}");
        }
    }

    /// The figure that a command writes into this file.
    fn drawn(&self, line: &str, file: &str) -> String {
        self.printed(&format!("{line} --force --plot {file}"));
        self.read(file)
    }
}

/// S of the 1971 paper, where two motions coexist.
const S: &str = "--inverse-beta 1.3 --gap 0.75 --restitution 0.5";
