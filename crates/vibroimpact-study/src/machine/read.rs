//! From the text of a machine file to a source, with the modes of another file.

use super::error::{MachineFileError, MachineProblem};
use super::modes;
use super::source::MachineSource;
use crate::text::Document;

/// Reads no files: for machine files that name none.
///
/// # Errors
/// Always.
pub fn no_files(_: &str) -> Result<String, String> {
    Err("cannot be read here".to_owned())
}

impl MachineSource {
    /// Reads a machine file, written as TOML or, where it begins with a brace, as JSON. `files` returns the text of a
    /// file that it names, or says why not.
    ///
    /// # Errors
    /// [`MachineFileError`] with the path of the part, or the line and the column, and what is expected there. What the
    /// numbers mean is checked by [`MachineSource::machine`].
    pub fn from_text(text: &str, files: impl FnOnce(&str) -> Result<String, String>) -> Result<Self, MachineFileError> {
        let mut source: Self = Document::parse(text)?.read()?;
        source.read_modes(files)?;
        Ok(source)
    }

    /// Replaces the name of a table of modes by the modes in it.
    pub(crate) fn read_modes(
        &mut self,
        files: impl FnOnce(&str) -> Result<String, String>,
    ) -> Result<(), MachineFileError> {
        let Some(name) = self.machine.modes.take() else { return Ok(()) };
        if !self.machine.mode.is_empty() {
            return Err(MachineFileError::new("modes", MachineProblem::Several("modes and tables mode")));
        }
        let read = files(&name).and_then(|table| modes::from_csv(&table));
        let wrong = |why| MachineFileError::new("modes", MachineProblem::File { name: name.clone(), why });
        self.machine.mode = read.map_err(wrong)?;
        Ok(())
    }
}
