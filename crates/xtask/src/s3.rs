//! `cargo xtask s3`: the tests of studies in buckets, which need a server that speaks S3 and a build with the feature.
//!
//! The server is a program from PyPI in an environment of its own under the target folder. The tests are built for the whole
//! workspace, so that what the other tests have built already serves.

use std::path::Path;

use crate::{command, tools, venv};

/// How the server is started by a shell.
const SERVER: &str = "-m moto.server -H 127.0.0.1 -p $PORT";
/// The variable by which the tests learn of it; they fail where it names a server that does not start.
const VARIABLE: &str = "VIBROIMPACT_S3_SERVER";
/// What is built and run.
const TESTS: &str = "--workspace --features vibroimpact-study/s3 --test s3 --no-fail-fast";

/// Installs the server and runs the tests; without Python says so, in a line that counts no test.
///
/// # Errors
/// The sentence that says what failed.
pub(crate) fn test(root: &Path) -> Result<String, String> {
    if !command::succeeds(root, "python3 --version") {
        return Ok(skipped("there is no python3 to run a server with"));
    }
    let pins = root.join("crates/vibroimpact-study/tests/s3-server.txt");
    let python = venv::ready(root, &command::target(root)?.join("s3-venv"), &pins).map_err(|why| {
        format!("{why}\nhint: the server needs Python 3.10 or later with venv, and for the first run access to PyPI")
    })?;
    let cargo = if tools::has_nextest(root) { "cargo nextest run" } else { "cargo test" };
    let mut tests = command::words(root, &format!("{cargo} {TESTS}"));
    tests.env(VARIABLE, format!("'{}' {SERVER}", python.display()));
    // a proxy knows nothing of a server on this machine
    tests.env("NO_PROXY", "127.0.0.1");
    command::run(tests)?;
    Ok("studies in buckets are as those in folders".to_owned())
}

/// A line that [`totals`](crate::totals) can read.
fn skipped(why: &str) -> String {
    format!("test result: skipped, {why}. 0 passed; 0 failed")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::totals::{Totals, in_line};

    #[test]
    fn what_is_skipped_counts_as_nothing() {
        assert_eq!(in_line(&skipped("there is no server")), Some(Totals::default()));
    }
}
