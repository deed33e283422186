//! Named machines of the literature. Each is a machine file in the folder `catalogue`.

use super::error::{MachineFileError, MachineProblem};
use super::read::no_files;
use super::source::MachineSource;

/// A machine of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CatalogueEntry {
    /// Its name.
    pub name: &'static str,
    /// Its file.
    pub text: &'static str,
}

macro_rules! catalogue {
    ($($name:literal)*) => {
        /// All machines of the catalogue.
        pub const CATALOGUE: &[CatalogueEntry] =
            &[$(CatalogueEntry { name: $name, text: include_str!(concat!("catalogue/", $name, ".toml")) }),*];
    };
}

catalogue! {
    "soft-stop"
    "bouncing-ball"
    "impact-pair"
    "impact-damper"
    "vi-nes"
    "two-mass-hammer"
    "gear-rattle"
    "chain"
    "cantilever"
    "pounding-buildings"
    "capsule"
    "den-hartog"
    "stick-slip"
    "fukaya-irie-1971"
    "sdnd101"
    "sdnd102"
    "sdnd106"
    "sdnd122"
}

impl CatalogueEntry {
    /// The machine file, read.
    ///
    /// # Errors
    /// None: each file of the catalogue is read in the tests.
    pub fn source(&self) -> Result<MachineSource, MachineFileError> {
        MachineSource::from_text(self.text, no_files)
    }
}

impl MachineSource {
    /// The machine of the catalogue with this name; or the machine of this text, if it is not a single word.
    ///
    /// # Errors
    /// As [`Self::of_catalogue`] and [`Self::from_text`]. Texts that name a file are refused.
    pub fn open(name_or_text: &str) -> Result<Self, MachineFileError> {
        let word = name_or_text.trim();
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if !word.is_empty() && word.chars().all(plain) {
            Self::of_catalogue(word)
        } else {
            Self::from_text(name_or_text, no_files)
        }
    }

    /// The machine of the catalogue with this name.
    ///
    /// # Errors
    /// [`MachineProblem::NoMachine`] with the known names.
    pub fn of_catalogue(name: &str) -> Result<Self, MachineFileError> {
        let found = CATALOGUE.iter().find(|entry| entry.name == name).ok_or_else(|| {
            let names: Vec<&str> = CATALOGUE.iter().map(|entry| entry.name).collect();
            MachineFileError::new(name, MachineProblem::NoMachine(format!("there are {}", names.join(", "))))
        })?;
        found.source()
    }
}
