//! A machine file: a machine with its title, its parameters and the numbers that were changed in it.

use super::error::{MachineFileError, MachineProblem};
use super::expand::expand;
use super::expression::reserved;
use super::named::Named;
use super::number::NumberText;
use super::start::StartText;
use super::text::WrittenMachine;
use super::written::{listed_path, numbers};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use vibroimpact::events::Start;
use vibroimpact::machine::{Machine, MachineError, MachineParts};

/// A machine file: the table `[machine]`, and optionally a title, the source, parameters and changed numbers.
///
/// ```
/// use vibroimpact_study::machine::{MachineSource, no_files};
/// let source = MachineSource::from_text(r#"
///     [parameters]
///     mu = 0.25
///     [machine]
///     bodies = { body = 1, shoe = "mu" }
///     link = [{ between = ["body", "shoe"], stiffness = "1/(1+mu)" }, { between = ["shoe", "ground"], stiffness = 1 }]
///     stop = [{ name = "wall", at = "body", gap = 1, restitution = 0.8 }]
/// "#, no_files)?;
/// assert_eq!(source.number("link.body-shoe.stiffness")?, 0.8);
/// assert_eq!(source.number("stiffness.shoe")?, 1.8);
/// let heavier = source.with("mu", 1.0)?;
/// assert_eq!(heavier.machine()?.number("mass.shoe")?, 1.0);
/// # Ok::<(), vibroimpact_study::machine::MachineFileError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineSource {
    /// A title in a few words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Where the machine comes from: authors, title, year, DOI.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// What it is, and what was chosen where the source says nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub summary: Option<String>,
    /// Numbers that expressions use, in the notation of the source.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub parameters: Named<f64>,
    /// Numbers of the expansion that are changed after it, by path, such as `"stiffness.body" = 2`.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub set: Named<f64>,
    /// Where it begins if nothing else is asked; at rest at 0 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartText>,
    /// The machine.
    pub machine: WrittenMachine,
}

impl MachineSource {
    /// The expansion: matrices, vectors and directions, which are not checked yet.
    ///
    /// # Errors
    /// [`MachineFileError`] with the path of the first part that has no meaning.
    pub fn parts(&self) -> Result<MachineParts, MachineFileError> {
        for (name, value) in &self.parameters.0 {
            let path = format!("parameters.{name}");
            let letter = |c: char| c.is_ascii_alphabetic() || c == '_';
            let plain = name.starts_with(letter) && name.chars().all(|c| letter(c) || c.is_ascii_digit());
            if !plain || reserved(name) || matches!(name.as_str(), "frequency" | "frequency_hz") {
                return Err(MachineFileError::new("parameters", MachineProblem::ParameterName(name.clone())));
            }
            if !value.is_finite() {
                return Err(MachineFileError::text(path, format!("{value} is not a finite number")));
            }
        }
        let mut parts = expand(&self.machine, &self.parameters)?;
        for (path, value) in &self.set.0 {
            let wrong = |error: MachineError| MachineFileError::new("set", MachineProblem::Set(error));
            parts.set(path, *value).map_err(wrong)?;
        }
        Ok(parts)
    }

    /// The machine. A start that has no meaning is refused here too, so that a file is right as a whole.
    ///
    /// # Errors
    /// [`MachineFileError`] with the path of the first number or part that is not allowed.
    pub fn machine(&self) -> Result<Machine, MachineFileError> {
        let parts = self.parts()?;
        self.start_of(&parts)?;
        Ok(Machine::new(parts)?)
    }

    /// The start of the table `[start]`, or else at rest at 0. Whether a stop is in the way is not checked.
    ///
    /// # Errors
    /// [`MachineFileError`] with the path of the first number that has no meaning, or if the file describes no machine.
    pub fn start(&self) -> Result<Start, MachineFileError> {
        self.start_of(&self.parts()?)
    }

    fn start_of(&self, parts: &MachineParts) -> Result<Start, MachineFileError> {
        self.start.clone().unwrap_or_default().numbers(parts, &self.parameters)
    }

    /// The number at a path: of a parameter, of the file, or else of its expansion.
    ///
    /// # Errors
    /// [`MachineFileError`] if the path leads to no number, or if the file describes no machine.
    pub fn number(&self, path: &str) -> Result<f64, MachineFileError> {
        if let Some(value) = self.parameters.get(path) {
            return Ok(*value);
        }
        let mut copy = self.machine.clone();
        let listed = listed_path(&copy, path);
        if self.set.get(&listed).is_none()
            && let Some((_, number)) = numbers(&mut copy).into_iter().find(|(known, _)| *known == listed)
        {
            return number.value(&self.parameters).map_err(|error| MachineFileError::new(path, error));
        }
        self.parts()?.number(path).map_err(|error| self.explained(error.into()))
    }

    /// The same machine with another number at a path. A parameter or a number that the file has is changed there, and
    /// the machine expands anew; another number is changed in the expansion. The result is not checked, so that
    /// several numbers can change one after the other.
    ///
    /// # Errors
    /// [`MachineFileError`] if the path leads to no number, or if the file describes no machine.
    pub fn with(&self, path: &str, value: f64) -> Result<Self, MachineFileError> {
        self.with_all([(path, value)])
    }

    /// The same in place.
    fn set(&mut self, path: &str, value: f64) -> Result<(), MachineFileError> {
        if let Some(place) = self.parameters.get_mut(path) {
            *place = value;
            return Ok(());
        }
        let listed = listed_path(&self.machine, path);
        let mut found = false;
        for (_, number) in numbers(&mut self.machine).into_iter().filter(|(known, _)| *known == listed) {
            *number = NumberText::Value(value);
            found = true;
        }
        if found {
            self.set.0.retain(|(known, _)| *known != listed);
            return Ok(());
        }
        self.parts()?.set(path, value).map_err(|error| self.explained(error.into()))?;
        self.set.set(&listed, value);
        Ok(())
    }

    /// The same machine with other numbers at several paths, one after another.
    pub(crate) fn with_all<'a>(
        &self,
        changes: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<Self, MachineFileError> {
        let mut changed = self.clone();
        changes.into_iter().try_for_each(|(path, value)| changed.set(path, value))?;
        Ok(changed)
    }

    /// The paths of all numbers: parameters, those of the file, and those of its expansion that are not zero.
    ///
    /// # Errors
    /// [`MachineFileError`] if the file describes no machine.
    pub fn paths(&self) -> Result<Vec<String>, MachineFileError> {
        Ok(self.numbers()?.0.into_iter().map(|(path, _)| path).collect())
    }

    /// The same paths with their numbers.
    ///
    /// # Errors
    /// As [`Self::paths`].
    pub fn numbers(&self) -> Result<Named<f64>, MachineFileError> {
        let machine = self.machine()?;
        let mut all = self.parameters.clone();
        let mut known: BTreeSet<String> = all.names().into_iter().map(str::to_owned).collect();
        let mut copy = self.machine.clone();
        for (path, number) in numbers(&mut copy) {
            // the zeros of a matrix that is written as rows are not listed
            let inside = path.matches('.').count() == 2 && path.starts_with(['m', 'd', 's']);
            let inside = inside && ["mass.", "damping.", "stiffness."].iter().any(|kind| path.starts_with(kind));
            if inside && *number == NumberText::Value(0.0) || known.contains(&path) {
                continue;
            }
            let value = match self.set.get(&path) {
                Some(_) => machine.number(&path).map_err(|error| self.explained(error.into()))?,
                None => number.value(&self.parameters).map_err(|error| MachineFileError::new(&path, error))?,
            };
            known.insert(path.clone());
            all.0.push((path, value));
        }
        all.0.extend(machine.numbers().into_iter().filter(|(path, _)| !known.contains(path)));
        Ok(all)
    }

    /// The numbers by which a machine of this file can be changed one at a time: the parameters, and the numbers that are written as
    /// such and are not 0, without directions and shapes of modes.
    pub(crate) fn free_numbers(&self) -> Result<Named<f64>, MachineFileError> {
        let mut copy = self.machine.clone();
        let written: BTreeSet<String> = (numbers(&mut copy).into_iter())
            .filter(|(path, number)| {
                matches!(number, NumberText::Value(_)) && !path.contains(".direction.") && !path.contains(".shape.")
            })
            .map(|(path, _)| path)
            .collect();
        let parameters = self.parameters.names();
        let free = |path: &str| written.contains(path) || parameters.contains(&path);
        Ok(Named(self.numbers()?.0.into_iter().filter(|(path, value)| *value != 0.0 && free(path)).collect()))
    }

    /// The expansion as a source: it has matrices and directions only, and no parameters.
    ///
    /// # Errors
    /// As [`Self::machine`].
    pub fn expansion(&self) -> Result<Self, MachineFileError> {
        let machine = self.machine()?;
        let (title, source, summary) = (self.title.clone(), self.source.clone(), self.summary.clone());
        let start = self.start.is_some().then(|| self.start()).transpose()?;
        let start = start.map(|start| StartText::of_numbers(&start, machine.parts()));
        let start = start.filter(|start| *start != StartText::default());
        let machine = WrittenMachine::from(machine.parts());
        Ok(Self { title, source, summary, start, machine, ..Self::default() })
    }

    /// The JSON schema of machine files, for editors and other programs.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        let mut schema = schemars::schema_for!(Self).to_value();
        schema["title"] = "a machine of vibroimpact".into();
        schema
    }

    /// The error with what the file has at paths that begin alike.
    fn explained(&self, error: MachineFileError) -> MachineFileError {
        let mut copy = self.machine.clone();
        let first = error.path.split('.').next().unwrap_or_default();
        let own = ["body", "link", "mode", "modal_damping"].contains(&first);
        let like: Vec<String> = if own {
            numbers(&mut copy)
                .into_iter()
                .map(|(path, _)| path)
                .filter(|path| path.split('.').next() == Some(first))
                .collect()
        } else if !error.path.contains('.') && !self.parameters.is_empty() {
            self.parameters.names().into_iter().map(str::to_owned).collect()
        } else {
            return error;
        };
        if like.is_empty() {
            return error;
        }
        let problem = format!("no such number in this machine\nhint: there are {}", like.join(", "));
        MachineFileError::text(error.path, problem)
    }
}

impl From<&Machine> for MachineSource {
    fn from(machine: &Machine) -> Self {
        Self { machine: WrittenMachine::from(machine.parts()), ..Self::default() }
    }
}
