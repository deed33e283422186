//! The order of the parts: each folder of the core uses only folders before it. Tests and comments are not read.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{read_dir, read_to_string};
use std::path::Path;

/// The folders of the core, in order.
const ORDER: [&str; 18] = [
    "math",
    "system",
    "machine",
    "regime",
    "arc",
    "events",
    "scenario",
    "flight",
    "contact",
    "lanes",
    "motion",
    "orbit",
    "lyapunov",
    "verdict",
    "edge",
    "quantities",
    "chaos",
    "continuation",
];

/// The code of a file before its tests, without comments.
fn code(text: &str) -> String {
    let lines = text.lines().take_while(|line| !line.trim_start().starts_with("#[cfg(test)]"));
    lines.map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// The first names of the paths that begin behind each `head`: one, or those of a group in braces.
fn first_names<'a>(code: &'a str, head: &str) -> Vec<&'a str> {
    let name = |text: &'a str| text.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default();
    let mut found = Vec::new();
    for rest in code.split(head).skip(1) {
        let Some(group) = rest.strip_prefix('{') else {
            found.push(name(rest));
            continue;
        };
        let mut level = 0;
        for part in group.split_inclusive(['{', '}', ',']) {
            if level == 0 {
                found.push(name(part.trim_start()));
            }
            level += i32::from(part.ends_with('{')) - i32::from(part.ends_with('}'));
            if level < 0 {
                break;
            }
        }
    }
    found.retain(|name| !name.is_empty());
    found
}

/// The uses of a folder by a folder that stands before it. The root exports names of folders, which count as these.
fn upwards(source: &Path) -> BTreeSet<String> {
    let root = code(&read_to_string(source.join("lib.rs")).expect("there is a root"));
    let mut exported = BTreeMap::new();
    for statement in root.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next()) {
        let folder = statement.split("::").next().unwrap_or_default();
        let names = statement.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        exported.extend(names.map(|name| (name.to_owned(), folder.to_owned())));
    }
    let place = |name: &str| ORDER.iter().position(|known| *known == name);
    let mut found = BTreeSet::new();
    let mut open = vec![source.to_owned()];
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(read_dir(&path).expect("it can be listed").map(|entry| entry.expect("it can be read").path()));
            continue;
        }
        let file = path.strip_prefix(source).expect("it is below").display().to_string();
        let own = file.split('/').next().unwrap_or_default().trim_end_matches(".rs");
        if own == "lib" || file.contains("tests") {
            continue;
        }
        let place_of_own = place(own).unwrap_or_else(|| panic!("`{own}` has no place in the order"));
        let text = code(&read_to_string(&path).expect("it can be read"));
        for name in first_names(&text, "crate::") {
            let folder = if place(name).is_some() { Some(name) } else { exported.get(name).map(String::as_str) };
            if folder.and_then(place).is_some_and(|other| other > place_of_own) {
                found.insert(format!("{file} uses {name}"));
            }
        }
    }
    found
}

#[test]
fn folders_of_the_core_use_those_before_them() {
    let found = upwards(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../vibroimpact/src"));
    assert!(found.is_empty(), "{found:#?}");
}

/// Checks that the test above can fail: directly, in a group, and through a name of the root.
#[test]
fn an_import_upwards_is_found() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("it can be written");
    for name in ["math", "verdict"] {
        std::fs::create_dir(folder.path().join(name)).expect("it can be made");
    }
    write("lib.rs", "pub mod math;\npub mod verdict;\npub use verdict::{Settled, Verdict};\n");
    write("verdict/mod.rs", "use crate::math::Sum;\npub struct Verdict(Sum);\n");
    for (text, uses) in [
        ("pub struct Sum; // crate::verdict\n#[cfg(test)]\nmod tests { use crate::Verdict; }\n", None),
        ("use crate::Verdict;\n", Some("Verdict")),
        ("use crate::{math::{Half, Sum}, verdict::{self}};\nuse core::mem;\n", Some("verdict")),
        ("fn there() { crate::verdict::new(format!(\"{}\", 1)); }\n", Some("verdict")),
    ] {
        write("math/sum.rs", text);
        let expected: Vec<String> = uses.iter().map(|name| format!("math/sum.rs uses {name}")).collect();
        assert_eq!(upwards(folder.path()).into_iter().collect::<Vec<_>>(), expected, "{text}");
    }
}
