//! The modules of a crate: the items that each defines, its imports and exports, and the paths in its code. Tests are
//! left out.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};
use syn::{Attribute, Item, UseTree};

/// A name that a module imports.
#[derive(Clone, Debug)]
pub(crate) struct Import {
    /// The name in this module; `None` for a glob import.
    pub(crate) name: Option<String>,
    /// The path of the import.
    pub(crate) path: Vec<String>,
    /// Whether other modules can use the name from here.
    pub(crate) exported: bool,
}

/// One module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Module {
    /// The file of the module.
    pub(crate) file: PathBuf,
    /// The names of its items, except modules.
    pub(crate) items: Vec<String>,
    /// Its `use` declarations, one for each name.
    pub(crate) imports: Vec<Import>,
    /// Paths in its code.
    pub(crate) paths: Vec<Vec<String>>,
}

/// All modules of a crate by their path, which is empty for the root.
pub(crate) type Tree = BTreeMap<Vec<String>, Module>;

/// Reads a crate from its root file.
pub(crate) fn read(root: &Path) -> Tree {
    let mut tree = Tree::new();
    let folder = root.parent().expect("a file has a folder").to_path_buf();
    file(&mut tree, Vec::new(), root, &folder);
    tree
}

fn file(tree: &mut Tree, at: Vec<String>, path: &Path, folder: &Path) {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let parsed = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    items(tree, at, path, folder, &parsed.items);
}

fn items(tree: &mut Tree, at: Vec<String>, path: &Path, folder: &Path, list: &[Item]) {
    let mut module = Module { file: path.to_path_buf(), ..Module::default() };
    for item in list.iter().filter(|item| !of_tests(attributes(item))) {
        match item {
            Item::Mod(inner) => {
                let name = inner.ident.to_string();
                let mut child = at.clone();
                child.push(name.clone());
                if let Some((_, list)) = &inner.content {
                    items(tree, child, path, &folder.join(&name), list);
                } else {
                    let own = folder.join(&name);
                    let (single, whole) = (folder.join(format!("{name}.rs")), own.join("mod.rs"));
                    file(tree, child, if single.exists() { &single } else { &whole }, &own);
                }
            }
            Item::Use(of) => {
                let exported = !matches!(of.vis, syn::Visibility::Inherited);
                imports(&of.tree, Vec::new(), exported, &mut module.imports);
            }
            _ => {
                module.items.extend(name(item));
                Paths(&mut module.paths).visit_item(item);
            }
        }
    }
    tree.insert(at, module);
}

fn imports(tree: &UseTree, mut path: Vec<String>, exported: bool, found: &mut Vec<Import>) {
    let named = |path: Vec<String>, name: String| Import { name: Some(name), path, exported };
    match tree {
        UseTree::Path(of) => {
            path.push(of.ident.to_string());
            imports(&of.tree, path, exported, found);
        }
        UseTree::Name(of) if of.ident == "self" => {
            let name = path.last().cloned().unwrap_or_default();
            found.push(named(path, name));
        }
        UseTree::Name(of) => {
            path.push(of.ident.to_string());
            found.push(named(path, of.ident.to_string()));
        }
        UseTree::Rename(of) => {
            path.push(of.ident.to_string());
            found.push(named(path, of.rename.to_string()));
        }
        UseTree::Glob(_) => found.push(Import { name: None, path, exported }),
        UseTree::Group(of) => of.items.iter().for_each(|tree| imports(tree, path.clone(), exported, found)),
    }
}

/// The paths in code.
struct Paths<'a>(&'a mut Vec<Vec<String>>);

impl<'ast> Visit<'ast> for Paths<'_> {
    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.0.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_attribute(&mut self, _: &'ast Attribute) {}

    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}

    // visits the arguments of a macro if they are expressions
    fn visit_macro(&mut self, of: &'ast syn::Macro) {
        self.visit_path(&of.path);
        let list = syn::punctuated::Punctuated::<syn::Expr, syn::Token![,]>::parse_terminated;
        if let Ok(list) = of.parse_body_with(list) {
            list.iter().for_each(|expression| self.visit_expr(expression));
        }
    }
}

fn of_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg") && attribute.parse_args::<syn::Path>().is_ok_and(|of| of.is_ident("test"))
    })
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(of) => &of.attrs,
        Item::Enum(of) => &of.attrs,
        Item::Fn(of) => &of.attrs,
        Item::Impl(of) => &of.attrs,
        Item::Macro(of) => &of.attrs,
        Item::Mod(of) => &of.attrs,
        Item::Static(of) => &of.attrs,
        Item::Struct(of) => &of.attrs,
        Item::Trait(of) => &of.attrs,
        Item::Type(of) => &of.attrs,
        Item::Use(of) => &of.attrs,
        _ => &[],
    }
}

fn name(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(of) => &of.ident,
        Item::Enum(of) => &of.ident,
        Item::Fn(of) => &of.sig.ident,
        Item::Macro(of) => of.ident.as_ref()?,
        Item::Static(of) => &of.ident,
        Item::Struct(of) => &of.ident,
        Item::Trait(of) => &of.ident,
        Item::Type(of) => &of.ident,
        _ => return None,
    };
    Some(name.to_string())
}
