//! Python environments under the target folder, with what a list of pins names.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::command;

/// The Python of the environment in `folder`, which is made anew only when the file of `pins` has changed.
///
/// # Errors
/// The sentence that says which step failed.
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
