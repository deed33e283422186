//! `cargo xtask s3`: the tests of studies in buckets. They need a server with the S3 protocol and a build with the
//! feature `s3`.
//!
//! The server is a program from PyPI in its own environment under the target folder. The tests are built for the whole
//! workspace with all features. The tests in Python run in the environment of [`python`], with a module built likewise.

use std::path::Path;

use crate::totals::skipped;
use crate::{command, python, tools, venv};

/// The arguments with which a shell starts the server.
const SERVER: &str = "-m moto.server -H 127.0.0.1 -p $PORT";
/// The variable with the command of the server. If it is set, the tests fail if the server does not start.
const VARIABLE: &str = "VIBROIMPACT_S3_SERVER";
/// The tests to build and run.
const TESTS: &str = "--workspace --all-features --test s3 --no-fail-fast";
/// The tests in Python.
const PYTHON_TESTS: &str = "-m pytest -q crates/vibroimpact-py/tests/test_s3.py";

/// Installs the server and runs the tests. Without Python, a line is printed that counts no test.
///
/// # Errors
/// A message that states the failure.
pub(crate) fn test(root: &Path) -> Result<String, String> {
    if !command::succeeds(root, "python3 --version") {
        return Ok(skipped("there is no python3 to run a server with"));
    }
    let pins = root.join("crates/vibroimpact-store/tests/s3-server.txt");
    let python = venv::ready(root, &command::target(root)?.join("s3-venv"), &pins).map_err(|why| {
        format!("{why}\nhint: the server needs Python 3.10 or later with venv, and for the first run access to PyPI")
    })?;
    let run = |line: &str| {
        let mut tests = command::words(root, line);
        tests.env(VARIABLE, format!("'{}' {SERVER}", python.display()));
        // a proxy could not reach a server on this machine
        tests.env("NO_PROXY", "127.0.0.1");
        command::run(tests)
    };
    let cargo = if tools::has_nextest(root) { "cargo nextest run" } else { "cargo test" };
    run(&format!("{cargo} {TESTS}"))?;
    if python::found(root).is_some() {
        python::install_with(root, "--all-features")?;
        run(&format!("{} {PYTHON_TESTS}", python::PYTHON))?;
    }
    Ok("studies in buckets are as those in folders".to_owned())
}
