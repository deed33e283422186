//! Machines by the name of the catalogue or of a file.

use crate::failure::Failure;
use std::fs;
use std::path::Path;
use vibroimpact_study::machine::{CATALOGUE, MachineSource};

/// Reads the machine of this name from the catalogue, or from the file of this name.
pub(crate) fn read(name: &str) -> Result<MachineSource, Failure> {
    if let Some(entry) = CATALOGUE.iter().find(|entry| entry.name == name) {
        return Ok(entry.source()?);
    }
    let path = Path::new(name);
    let like_a_file = name.contains(['/', '\\']) || path.extension().is_some();
    let text = fs::read_to_string(path).map_err(|error| {
        Failure::bad(if like_a_file {
            format!("the machine `{name}` cannot be read: {error}\nhint: `vibro machine show chain --written` prints an example")
        } else {
            format!(
                "`{name}` is neither a machine of the catalogue nor a file\nhint: `vibro machine list` lists the catalogue; the name of a file ends in .toml"
            )
        })
    })?;
    MachineSource::from_text(&text, |other| beside(path, other))
        .map_err(|error| Failure::bad(format!("{name}: {error}")))
}

/// The text of a file that a machine names: it is beside the file of the machine.
pub(crate) fn beside(path: &Path, other: &str) -> Result<String, String> {
    let place = path.parent().unwrap_or(Path::new("")).join(other);
    fs::read_to_string(place).map_err(|error| format!("cannot be read: {error}"))
}
