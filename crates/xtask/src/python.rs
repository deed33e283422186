//! Builds the Python package and installs it into its own environment under `target/`, ready for its tests.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::JoinHandle;
use std::{fs, io};

use crate::command;

/// The folder of the environment, from the root of the repository.
const ENVIRONMENT: &str = "target/python";
/// The Python interpreter of the environment.
pub(crate) const PYTHON: &str = "target/python/bin/python";
/// The oldest Python in which all tests run, because zarr 3 needs it. The package itself supports older ones.
const OLDEST: (u32, u32) = (3, 11);
/// The reason why the tests are skipped.
pub(crate) const SKIPPED: &str = "skipped: there is no Python 3.11 or later here with venv";

/// The command that runs the tests. It needs the environment that [`install`] creates.
pub(crate) const TESTS: &str = "target/python/bin/python -m pytest -q -n 2 --dist loadfile --no-loadscope-reorder";

/// The name of a Python that can create environments.
pub(crate) fn found(root: &Path) -> Option<&'static str> {
    let (major, minor) = OLDEST;
    let can = format!("import sys, venv, ensurepip; sys.exit(sys.version_info < ({major}, {minor}))");
    ["python3", "python"].into_iter().find(|python| {
        let mut ask = command::words(root, python);
        ask.args(["-c", &can]).stdout(Stdio::null()).stderr(Stdio::null());
        ask.status().is_ok_and(|status| status.success())
    })
}

/// The packages that the tests need, from pyproject.toml, without the package itself.
const PACKAGES: &str = "-m uv pip install --quiet --requirements pyproject.toml --extra test";
/// The command that builds the compiled module. With the flags and the tests of the other steps, all dependencies have
/// the same features, and what those steps built is used.
const COMPILED: &str = "cargo build --workspace --profile test --lib --tests";
/// The files of the package in Python.
const FILES: &str = "crates/vibroimpact-py/python/vibroimpact";

/// Builds the package as the tests of Rust are built, and installs it with the packages for its tests.
/// `cargo xtask release` builds it as its users do.
///
/// # Errors
/// A message that names the step that failed; the program that failed has printed its own messages.
pub(crate) fn install(root: &Path) -> Result<String, String> {
    install_with(root, "")
}

/// As [`install`], with these switches for the build of the module.
///
/// # Errors
/// As [`install`].
pub(crate) fn install_with(root: &Path, switches: &str) -> Result<String, String> {
    let Some(python) = found(root) else { return Ok(SKIPPED.to_owned()) };
    environment(root, python, command::run)?;
    command::run(command::words(root, &format!("{COMPILED} {switches}")))?;
    copy(root)?;
    Ok(format!("vibroimpact is installed in {ENVIRONMENT}"))
}

/// Begins to download the packages for the tests, which takes time but no processor, while other steps compute. A failure
/// is not reported here: [`install`] does the same again, and finds what is there.
pub(crate) fn begin(root: &Path) -> JoinHandle<()> {
    let root = root.to_owned();
    std::thread::spawn(move || {
        if let Some(python) = found(&root) {
            let _ = environment(&root, python, |mut command| command::run_quietly(&mut command));
        }
    })
}

/// Creates the environment if there is none, and installs the packages that it lacks.
fn environment(root: &Path, python: &str, run: impl Fn(Command) -> Result<(), String>) -> Result<(), String> {
    if !root.join(PYTHON).is_file() {
        run(command::words(root, &format!("{python} -m venv {ENVIRONMENT}")))?;
    }
    // an environment whose creation was interrupted has no uv
    if !command::succeeds(root, &format!("{PYTHON} -m uv --version")) {
        run(command::words(root, &format!("{PYTHON} -m pip install --quiet --disable-pip-version-check uv")))?;
    }
    let mut packages = command::words(root, &format!("{PYTHON} {PACKAGES} --python"));
    packages.arg(root.join(PYTHON));
    run(packages)
}

/// Copies the files of the package and the compiled module into the environment.
fn copy(root: &Path) -> Result<(), String> {
    let end = if cfg!(target_os = "macos") { "dylib" } else { "so" };
    let compiled = command::target(root)?.join("debug").join(format!("lib_core.{end}"));
    let folder = site_packages(root)?.join("vibroimpact");
    let failed = |error: io::Error| format!("the package cannot be copied to {}: {error}", folder.display());
    // a file that is gone from the sources must be gone from the environment too
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    command::copy(&root.join(FILES), &folder)?;
    fs::copy(&compiled, folder.join("_core.abi3.so")).map(drop).map_err(failed)
}

/// The folder of the environment in which Python looks for packages.
fn site_packages(root: &Path) -> Result<PathBuf, String> {
    let mut ask = command::words(root, PYTHON);
    ask.args(["-c", "import sysconfig; print(sysconfig.get_path('platlib'), end='')"]);
    let answer = ask.output().map_err(|error| format!("{PYTHON} cannot be started: {error}"))?;
    Ok(PathBuf::from(String::from_utf8_lossy(&answer.stdout).into_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_zarr_asks_for_is_what_is_looked_for() {
        let project = fs::read_to_string(command::root().join("pyproject.toml")).unwrap();
        let (major, minor) = OLDEST;
        assert!(project.contains(&format!("zarr>=3; python_version >= '{major}.{minor}'")));
        assert!(SKIPPED.contains(&format!("Python {major}.{minor}")) && TESTS.starts_with(ENVIRONMENT));
    }
}
