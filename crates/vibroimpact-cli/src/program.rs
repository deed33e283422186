//! The file of the program, for scripts that run it again.

use crate::failure::Failure;
use std::path::PathBuf;
use std::sync::OnceLock;

static PROGRAM: OnceLock<PathBuf> = OnceLock::new();

/// Notes the file of the program, if it is not that of this process.
pub(crate) fn remember(program: Option<PathBuf>) {
    if let Some(program) = program {
        // a second call in one process keeps the first
        let _ = PROGRAM.set(program);
    }
}

/// The file of the program.
pub(crate) fn path() -> Result<PathBuf, Failure> {
    PROGRAM.get().map_or_else(
        || std::env::current_exe().map_err(|error| Failure::Failed(format!("where this program is: {error}"))),
        |program| Ok(program.clone()),
    )
}
