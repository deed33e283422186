//! Writes the table of the line 1/beta = 1.11 into `docs/orbits.md`, and its figure into the same folder: `cargo xtask
//! line`.

use fukaya_irie_1971::{Error, line};
use std::path::Path;

fn main() -> Result<(), Error> {
    line::write(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs"))
}
