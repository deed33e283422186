//! Remarks and error messages on stderr.

use std::io::{self, Write};

/// Writes a line to stderr. A failure is ignored, because there is no other place to report it.
pub(crate) fn complain(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}
