//! The order of the parts: each folder of the core uses only folders before it.
//!
//! Imports and paths are followed through re-exports to the file that defines the name, so an import from `mod.rs`
//! hides nothing. Tests and documentation are not checked.

mod tree;
mod uses;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The folders of the core, in order.
const ORDER: [&str; 18] = [
    "math",
    "system",
    "machine",
    "regime",
    "arc",
    "events",
    "scenario.rs",
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

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// The uses of a folder by a folder that stands before it.
fn upwards(uses: &uses::Uses, source: &Path) -> BTreeSet<String> {
    let name = |path: &Path| path.strip_prefix(source).map(|path| path.display().to_string()).unwrap_or_default();
    let place = |path: &Path| {
        let folder = name(path);
        let folder = folder.split('/').next().unwrap_or_default();
        ORDER.iter().position(|known| *known == folder)
    };
    let mut found = BTreeSet::new();
    for (from, to) in uses.iter().flat_map(|(from, all)| all.iter().map(move |to| (from, to))) {
        // the root exports names of all folders
        if let Some(own) = place(from)
            && place(to).is_none_or(|other| other > own)
        {
            found.insert(format!("{} uses {}", name(from), name(to)));
        }
    }
    found
}

#[test]
fn folders_of_the_core_use_those_before_them() {
    let root = file("crates/vibroimpact/src/lib.rs");
    let source = root.parent().expect("a file is in a folder");
    let folders = std::fs::read_dir(source).expect("the folder is there").filter_map(Result::ok);
    let unknown: Vec<String> = folders
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| name != "lib.rs" && !ORDER.contains(&name.as_str()))
        .collect();
    assert!(unknown.is_empty(), "these have no place in the order: {unknown:?}");
    let found = upwards(&uses::of(&tree::read(&root)), source);
    assert!(found.is_empty(), "{found:#?}");
}

/// Checks that the test above can fail, with a crate that has an import in the wrong direction, directly and through a
/// `pub use`.
#[test]
fn an_import_upwards_is_found() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let at = |name: &str| folder.path().join(name);
    for name in ["math", "verdict"] {
        std::fs::create_dir(at(name)).expect("it can be made");
    }
    let write = |name: &str, text: &str| std::fs::write(at(name), text).expect("it can be written");
    write("lib.rs", "pub mod math;\npub mod verdict;\npub use verdict::Verdict;\n");
    write("math/mod.rs", "mod sum;\npub use sum::Sum;\n");
    write("verdict/mod.rs", "mod verdict;\nmod other;\npub use verdict::Verdict;\n");
    write("verdict/verdict.rs", "use crate::math::Sum;\npub struct Verdict(Sum);\n");
    write("verdict/other.rs", "pub fn other() {}\n");
    write("math/sum.rs", "pub struct Sum;\n#[cfg(test)]\nmod tests { use crate::Verdict; }\n");
    let found = |root: &Path| upwards(&uses::of(&tree::read(root)), folder.path());
    let none = found(&at("lib.rs"));
    assert!(none.is_empty(), "{none:?}");
    write("math/sum.rs", "use crate::Verdict;\npub struct Sum;\npub type Other = Option<Verdict>;\n");
    let one = found(&at("lib.rs"));
    assert_eq!(one.into_iter().collect::<Vec<_>>(), ["math/sum.rs uses verdict/verdict.rs"]);
    write("math/sum.rs", "pub struct Sum;\nfn there() { crate::verdict::Verdict::new(format!(\"{}\", 1)); }\n");
    assert_eq!(found(&at("lib.rs")).len(), 1);
}
