//! `cargo xtask words`: the links and the spelling of the texts, by lychee and typos.
//!
//! Only links within the repository are followed: a check must not depend on the network.

use std::path::Path;

use crate::{command, python, venv};

/// The tools and their versions, from the root of the repository.
const PINS: &str = "crates/xtask/tools.txt";
/// Links to files and to headings in them.
const LINKS: &str =
    "lychee --offline --no-progress --include-fragments --exclude-path target --exclude-path node_modules **/*.md";
/// Words in texts, code and the names of files.
const SPELLING: &str = "typos --format brief";

/// Checks the Markdown files of the repository, and the spelling of all files.
///
/// # Errors
/// The sentence that names the tool that found something, or that cannot be installed; it has printed what it found.
pub(crate) fn check(root: &Path) -> Result<String, String> {
    if python::found(root).is_none() {
        return Ok(python::SKIPPED.to_owned());
    }
    let folder = command::target(root)?.join("tools");
    venv::ready(root, &folder, &root.join(PINS))?;
    let programs = folder.join("bin");
    let run = |line: &str| command::run(command::words(root, &format!("{}/{line}", programs.display())));
    // both print what they find
    let (links, spelling) = (run(LINKS), run(SPELLING));
    links.and(spelling).map(|()| String::new())
}
