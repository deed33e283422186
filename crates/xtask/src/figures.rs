//! `cargo xtask figures`: draws the figures of the README again, with the command named in the README. `cargo xtask line`:
//! computes the worked study of `docs/orbits.md`, its table and its figure.

use std::fs;
use std::path::Path;

use crate::command;

/// The figures of the reproduction and the files of the documents to which they are copied.
const PICTURES: [(&str, &str); 1] = [("figure-04.png", "docs/figure-04.png")];

/// Reproduces the paper into a folder under `target`, and copies the figures of the documents.
///
/// # Errors
/// A message that names the step that failed.
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

/// Runs the program that writes the worked study.
///
/// # Errors
/// A message that names the step that failed.
pub(crate) fn line(root: &Path) -> Result<String, String> {
    command::run(command::words(root, "cargo run --release -p fukaya-irie-1971 --example line"))?;
    Ok("docs/orbits.md and docs/line.png written".to_owned())
}
