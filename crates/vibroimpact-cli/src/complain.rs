//! Remarks and errors on stderr.

use std::io::{self, Write};

/// A line on stderr; if stderr is gone there is no one to tell.
pub(crate) fn complain(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}
