//! `cargo xtask figures`: the pictures of the README, drawn anew by the command the README names.

use std::fs;
use std::path::Path;

use crate::command;

/// Which figure of the reproduction becomes which picture of the documents.
const PICTURES: [(&str, &str); 1] = [("figure-04.png", "docs/figure-04.png")];

/// Reproduces the paper into a folder under `target` and copies the pictures the documents show.
///
/// # Errors
/// The sentence that says which step failed.
pub(crate) fn draw(root: &Path) -> Result<String, String> {
    let out = root.join("target/figures");
    let mut reproduce = command::words(root, "cargo run --release -- reproduce --quiet --out");
    reproduce.arg(&out);
    command::run(reproduce)?;
    for (from, to) in PICTURES {
        fs::copy(out.join(from), root.join(to)).map_err(|error| format!("{from} cannot be copied to {to}: {error}"))?;
    }
    Ok(format!("{} picture(s) drawn", PICTURES.len()))
}
