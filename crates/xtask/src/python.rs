//! Builds the Python package and installs it into its own environment under `target/`, ready for its tests.

use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

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
pub(crate) const TESTS: &str = "target/python/bin/python -m pytest -q -n 2 --dist loadfile";

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

/// Builds the package and installs it with the packages for its tests.
///
/// # Errors
/// A message that names the step that failed; pip has printed its own messages.
pub(crate) fn install(root: &Path) -> Result<String, String> {
    let Some(python) = found(root) else { return Ok(SKIPPED.to_owned()) };
    let here = root.join(ENVIRONMENT);
    if !here.join("bin/python").is_file() {
        command::run(command::words(root, &format!("{python} -m venv {ENVIRONMENT}")))?;
    }
    // an isolated build environment would be another Python each time, and dependent crates would be built again
    pip(root, &["maturin>=1.9.4,<2"])?;
    pip(root, &["--no-build-isolation", ".[test]"])?;
    Ok(format!("vibroimpact is installed in {ENVIRONMENT}"))
}

fn pip(root: &Path, words: &[&str]) -> Result<(), String> {
    let mut command = command::words(root, &format!("{ENVIRONMENT}/bin/python -m pip install --quiet"));
    command.args(["--disable-pip-version-check", "--no-input"]).args(words);
    with_programs(&mut command, &root.join(ENVIRONMENT).join("bin"));
    command::run(command)
}

/// Puts the programs of the environment first in the search path of a command.
fn with_programs(command: &mut Command, programs: &Path) {
    let old = env::var_os("PATH").unwrap_or_default();
    let all = std::iter::once(PathBuf::from(programs)).chain(env::split_paths(&old));
    if let Ok(path) = env::join_paths(all) {
        command.env("PATH", path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_programs_of_the_environment_come_first() {
        let mut command = Command::new("pip");
        with_programs(&mut command, Path::new("/environment/bin"));
        let path = command.get_envs().find(|(name, _)| *name == "PATH").and_then(|(_, value)| value).unwrap();
        let all: Vec<PathBuf> = env::split_paths(path).collect();
        assert_eq!(all[0], Path::new("/environment/bin"));
        assert_eq!(all.len(), 1 + env::split_paths(&env::var_os("PATH").unwrap_or_default()).count());
    }

    #[test]
    fn what_zarr_asks_for_is_what_is_looked_for() {
        let project = std::fs::read_to_string(command::root().join("pyproject.toml")).unwrap();
        let (major, minor) = OLDEST;
        assert!(project.contains(&format!("zarr>=3; python_version >= '{major}.{minor}'")));
        assert!(SKIPPED.contains(&format!("Python {major}.{minor}")) && TESTS.starts_with(ENVIRONMENT));
    }
}
