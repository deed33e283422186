//! What names stand for: a coordinate, a body, a point of a structure with modes, or the ground.

use super::error::{MachineFileError, MachineProblem};
use super::named::Named;
use super::number::NumberText;
use super::shapes::VectorText;

/// The name of what does not move.
const GROUND: &str = "ground";

/// The name of a mode's coordinate, counted from 1.
pub(super) fn name_of_mode(number: usize) -> String {
    format!("mode{number}")
}

/// Checks a name that is a part of paths.
pub(super) fn check_name(path: &str, name: &str) -> Result<(), MachineFileError> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if name.is_empty() || !name.chars().all(plain) {
        return Err(MachineFileError::new(path, MachineProblem::Name(name.to_owned())));
    }
    Ok(())
}

/// Checks the name of a coordinate, a body or a point.
pub(super) fn check_place(path: &str, name: &str) -> Result<(), MachineFileError> {
    if name == GROUND {
        return Err(MachineFileError::new(path, MachineProblem::Name(name.to_owned())));
    }
    check_name(path, name)
}

/// What is wrong in a number where a vector is needed.
pub(super) const NUMBER_ALONE: &str = "a number alone is given, and a list or a table of names is needed";

/// Directions by name.
pub(super) struct Places<'a> {
    /// The parameters of the expressions.
    pub(super) parameters: &'a Named<f64>,
    /// The names of the coordinates.
    pub(super) coordinates: Vec<String>,
    /// Bodies and points with their directions.
    pub(super) others: Vec<(String, Vec<f64>)>,
}

impl Places<'_> {
    pub(super) fn n(&self) -> usize {
        self.coordinates.len()
    }

    /// The value of a number.
    pub(super) fn value(&self, path: &str, number: &NumberText) -> Result<f64, MachineFileError> {
        number.value(self.parameters).map_err(|error| MachineFileError::new(path, error))
    }

    /// The value of a number that may be absent.
    pub(super) fn value_or(
        &self,
        path: &str,
        number: Option<&NumberText>,
        absent: f64,
    ) -> Result<f64, MachineFileError> {
        number.map_or(Ok(absent), |number| self.value(path, number))
    }

    /// The values of a list.
    pub(super) fn values(&self, path: &str, list: &[NumberText]) -> Result<Vec<f64>, MachineFileError> {
        list.iter().map(|number| self.value(path, number)).collect()
    }

    /// What a name stands for: the displacement there is this direction times the coordinates.
    pub(super) fn direction(&self, path: &str, name: &str) -> Result<Vec<f64>, MachineFileError> {
        if name == GROUND {
            return Ok(vec![0.0; self.n()]);
        }
        if let Some((_, direction)) = self.others.iter().find(|(known, _)| known == name) {
            return Ok(direction.clone());
        }
        let place = self.coordinates.iter().position(|known| known == name).ok_or_else(|| {
            let mut known: Vec<&str> = self.others.iter().map(|(name, _)| name.as_str()).collect();
            let more = self.coordinates.iter().map(String::as_str).filter(|name| !known.contains(name));
            known.extend(more.collect::<Vec<_>>());
            known.push(GROUND);
            let problem = MachineProblem::Unknown { name: name.to_owned(), known: known.join(", ") };
            MachineFileError::new(path, problem)
        })?;
        let mut direction = vec![0.0; self.n()];
        direction[place] = 1.0;
        Ok(direction)
    }

    /// The direction from the second to the first of two names: their relative displacement.
    pub(super) fn between(&self, path: &str, [one, other]: &[String; 2]) -> Result<Vec<f64>, MachineFileError> {
        let mut direction = self.direction(path, one)?;
        for (value, minus) in direction.iter_mut().zip(self.direction(path, other)?) {
            *value -= minus;
        }
        Ok(direction)
    }

    /// A vector: a list as it is, or the sum of what its names stand for.
    pub(super) fn vector(&self, path: &str, text: &VectorText) -> Result<Vec<f64>, MachineFileError> {
        match text {
            VectorText::List(list) => {
                self.check_size(path, list.len())?;
                self.values(path, list)
            }
            VectorText::Named(table) => {
                let mut sum = vec![0.0; self.n()];
                for (name, number) in &table.0 {
                    let direction = self.direction(path, name)?;
                    add(&mut sum, self.value(&format!("{path}.{name}"), number)?, &direction);
                }
                Ok(sum)
            }
            VectorText::One(_) => Err(MachineFileError::text(path, NUMBER_ALONE)),
        }
    }

    pub(super) fn check_size(&self, path: &str, given: usize) -> Result<(), MachineFileError> {
        if given == self.n() {
            return Ok(());
        }
        let given = if given == 1 { "1 number".to_owned() } else { format!("{given} numbers") };
        let of = format!("the coordinates {}", self.coordinates.join(", "));
        Err(MachineFileError::new(path, MachineProblem::Size { given, wanted: self.n(), of }))
    }
}

/// Refuses a number that is negative or not finite, with what it is.
pub(super) fn not_negative(path: impl Into<String>, what: &str, value: f64) -> Result<(), MachineFileError> {
    let wrong = || MachineFileError::text(path, format!("{value} lies outside {what} >= 0"));
    if value >= 0.0 && value.is_finite() { Ok(()) } else { Err(wrong()) }
}

/// Adds a multiple of a vector.
pub(super) fn add(sum: &mut [f64], factor: f64, vector: &[f64]) {
    for (sum, value) in sum.iter_mut().zip(vector) {
        *sum += factor * value;
    }
}
