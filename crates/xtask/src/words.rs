//! `cargo xtask words`: the links and the spelling of the texts, by lychee and typos.
//!
//! Only links within the repository are followed, because a check must not depend on the network.

use std::path::Path;

use crate::{command, python, venv};

/// The list of the tools and their versions, from the root of the repository.
const PINS: &str = "crates/xtask/tools.txt";
/// The check of links to files and to headings in them.
const LINKS: &str =
    "lychee --offline --no-progress --include-fragments --exclude-path target --exclude-path node_modules **/*.md";
/// The check of spelling in texts, code and file names.
const SPELLING: &str = "typos --format brief";

/// Checks the Markdown files of the repository, and the spelling of all files.
///
/// # Errors
/// A message that names the tool that found something or cannot be installed; the tool has printed its findings.
pub(crate) fn check(root: &Path) -> Result<String, String> {
    if python::found(root).is_none() {
        return Ok(python::SKIPPED.to_owned());
    }
    let folder = command::target(root)?.join("tools");
    venv::ready(root, &folder, &root.join(PINS))?;
    let programs = folder.join("bin");
    let run = |line: &str| command::run(command::words(root, &format!("{}/{line}", programs.display())));
    // run both, so that both print their findings
    let (links, spelling) = (run(LINKS), run(SPELLING));
    links.and(spelling).map(|()| String::new())
}
