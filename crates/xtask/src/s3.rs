//! `cargo xtask s3`: the tests of studies in buckets. They need a server with the S3 protocol and a build with the
//! feature `s3`.
//!
//! The server is a program from PyPI in its own environment under the target folder. The tests are built for the whole
//! workspace with all features, as in the other steps, so that existing builds are used. The compiled module of the
//! Python package is built in the same way, placed next to a copy of the Python files, and tested in the environment of
//! [`python`].

use std::fs;
use std::path::{Path, PathBuf};

use crate::totals::skipped;
use crate::{command, python, tools, venv};

/// The arguments with which a shell starts the server.
const SERVER: &str = "-m moto.server -H 127.0.0.1 -p $PORT";
/// The variable with the command of the server. If it is set, the tests fail if the server does not start.
const VARIABLE: &str = "VIBROIMPACT_S3_SERVER";
/// The tests to build and run.
const TESTS: &str = "--workspace --all-features --test s3 --no-fail-fast";
/// The command that builds the compiled module of the Python package. Tests are included so that dependencies have the
/// same features.
const COMPILED: &str = "cargo build --workspace --all-features --profile test --lib --tests";
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
    let run = |line: &str, packages: Option<PathBuf>| {
        let mut tests = command::words(root, line);
        tests.env(VARIABLE, format!("'{}' {SERVER}", python.display()));
        // a proxy could not reach a server on this machine
        tests.env("NO_PROXY", "127.0.0.1");
        tests.envs(packages.map(|folder| ("PYTHONPATH", folder)));
        command::run(tests)
    };
    let cargo = if tools::has_nextest(root) { "cargo nextest run" } else { "cargo test" };
    run(&format!("{cargo} {TESTS}"), None)?;
    if python::found(root).is_some() {
        run(&format!("{} {PYTHON_TESTS}", python::PYTHON), Some(package(root)?))?;
    }
    Ok("studies in buckets are as those in folders".to_owned())
}

/// A folder with the Python package built with all features, for an environment with its dependencies.
fn package(root: &Path) -> Result<PathBuf, String> {
    if !root.join(python::PYTHON).is_file() {
        python::install(root)?;
    }
    command::run(command::words(root, COMPILED))?;
    let target = command::target(root)?;
    let built = |end: &str| target.join("debug").join(format!("lib_core.{end}"));
    let compiled = if cfg!(target_os = "macos") { built("dylib") } else { built("so") };
    let all = target.join("s3-package");
    let folder = all.join("vibroimpact");
    let copied = || {
        fs::create_dir_all(&folder)?;
        for entry in fs::read_dir(root.join("crates/vibroimpact-py/python/vibroimpact"))? {
            let file = entry?.path();
            if let Some(name) = file.file_name().filter(|_| file.is_file()) {
                fs::copy(&file, folder.join(name))?;
            }
        }
        fs::copy(&compiled, folder.join("_core.abi3.so")).map(drop)
    };
    copied().map_err(|error: std::io::Error| {
        format!("the package cannot be put together in {}: {error}", folder.display())
    })?;
    Ok(all)
}
