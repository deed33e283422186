//! Finds which file uses which: imports and paths are followed through re-exports to the file that defines the name.

use crate::tree::{Module, Tree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// The files that each file uses.
pub(crate) type Uses = BTreeMap<PathBuf, BTreeSet<PathBuf>>;

/// Maximum number of consecutive re-exports.
const DEPTH: usize = 16;

/// Follows every import and path of a crate. A re-export in a `mod.rs` or `lib.rs` is not a use by that file.
pub(crate) fn of(tree: &Tree) -> Uses {
    let mut uses = Uses::new();
    for (at, module) in tree {
        let entry = uses.entry(module.file.clone()).or_default();
        let root = module.file.ends_with("mod.rs") || at.is_empty();
        let imported = module.imports.iter().filter(|import| !(root && import.exported)).map(|import| &import.path);
        for path in imported.chain(&module.paths) {
            entry.extend(resolve(tree, at, path, DEPTH).filter(|file| *file != module.file));
        }
    }
    uses
}

/// The file that defines `path`, as written in the module `at`; `None` for names of another crate or of the language.
fn resolve(tree: &Tree, at: &[String], path: &[String], depth: usize) -> Option<PathBuf> {
    let (first, rest) = path.split_first()?;
    let depth = depth.checked_sub(1)?;
    match first.as_str() {
        "crate" => inside(tree, &[], rest, depth),
        "self" => inside(tree, at, rest, depth),
        "super" => {
            let (mut at, mut rest) = (at.split_last()?.1, rest);
            while let [next, after @ ..] = rest
                && next == "super"
            {
                (at, rest) = (at.split_last()?.1, after);
            }
            inside(tree, at, rest, depth)
        }
        _ => inside(tree, at, path, depth),
    }
}

/// The same for a path within a module.
fn inside(tree: &Tree, at: &[String], path: &[String], depth: usize) -> Option<PathBuf> {
    let module: &Module = tree.get(at)?;
    let Some((first, rest)) = path.split_first() else { return Some(module.file.clone()) };
    let child = [at, core::slice::from_ref(first)].concat();
    if tree.contains_key(&child) {
        return inside(tree, &child, rest, depth);
    }
    if module.items.contains(first) {
        return Some(module.file.clone());
    }
    let joined = |path: &[String]| [path, rest].concat();
    let named = module.imports.iter().filter(|import| import.name.as_ref() == Some(first));
    let named =
        named.filter(|import| import.path != path).find_map(|import| resolve(tree, at, &joined(&import.path), depth));
    named.or_else(|| {
        let globs = module.imports.iter().filter(|import| import.name.is_none());
        globs.into_iter().find_map(|import| resolve(tree, at, &[&import.path[..], path].concat(), depth))
    })
}
