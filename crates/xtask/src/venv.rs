//! Python environments under the target folder, with the packages of a list of fixed versions.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::command;

/// The Python of the environment in `folder`. The environment is created again only when the file `pins` has changed.
///
/// # Errors
/// A message that names the step that failed.
pub(crate) fn ready(root: &Path, folder: &Path, pins: &Path) -> Result<PathBuf, String> {
    let wanted = fs::read_to_string(pins).map_err(|error| format!("{} cannot be read: {error}", pins.display()))?;
    let python = folder.join("bin/python");
    let stamp = folder.join("installed.txt");
    if python.exists() && fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) {
        return Ok(python);
    }
    let mut make = command::words(root, "python3 -m venv");
    make.arg(folder);
    command::run(make)?;
    let mut install = Command::new(&python);
    install.current_dir(root).stdin(Stdio::null());
    install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--requirement"]).arg(pins);
    command::run(install)?;
    fs::write(&stamp, wanted).map_err(|error| format!("{} cannot be written: {error}", stamp.display()))?;
    Ok(python)
}
