//! The command `vibro`.

use crate::door;
use pyo3::prelude::*;
use std::ffi::OsString;
use std::path::PathBuf;

/// Runs the command with these words, the first of which is its name. `program` is its file. Returns the exit code.
#[pyfunction]
pub(crate) fn vibro(py: Python<'_>, words: Vec<OsString>, program: PathBuf) -> u8 {
    door::here(py, || vibroimpact_cli::run(&words, Some(program)))
}
