//! The table `[start]` of a machine file: where the machine begins if nothing else is asked.

use super::error::{MachineProblem, MachineTextError};
use super::named::Named;
use super::number::NumberText;
use super::shapes::VectorText;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::events::MachineStart;

/// The table `[start]`: coordinates, velocities and phase of the forcing at time 0, each 0 when absent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StartText {
    /// The coordinates: a number for each, or `{ body = 0.1 }` with names of coordinates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub q: Option<VectorText>,
    /// The velocities, likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub qdot: Option<VectorText>,
    /// The phase of the forcing, in radians.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase: Option<NumberText>,
}

/// The numbers of a start.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StartNumbers {
    /// The coordinates.
    pub q: Vec<f64>,
    /// The velocities.
    pub qdot: Vec<f64>,
    /// The phase of the forcing, in radians.
    pub phase: f64,
}

impl StartText {
    /// The numbers, for these coordinates.
    pub(super) fn numbers(
        &self,
        coordinates: &[String],
        parameters: &Named<f64>,
    ) -> Result<StartNumbers, MachineTextError> {
        let value = |path: &str, number: &NumberText| {
            let value = number.value(parameters).map_err(|error| MachineTextError::new(path, error))?;
            let finite = value.is_finite().then_some(value);
            finite.ok_or_else(|| wrong(path, format!("{value} is not a finite number")))
        };
        let vector = |path: &str, vector: Option<&VectorText>| {
            let mut values = vec![0.0; coordinates.len()];
            match vector {
                None => {}
                Some(VectorText::One(_)) => {
                    let what = "a number alone is given, and a list or a table of names is needed";
                    return Err(wrong(path, what.to_owned()));
                }
                Some(VectorText::List(list)) if list.len() != coordinates.len() => {
                    let given = format!("{} numbers", list.len());
                    let of = format!("the coordinates {}", coordinates.join(", "));
                    let problem = MachineProblem::Size { given, wanted: coordinates.len(), of };
                    return Err(MachineTextError::new(path, problem));
                }
                Some(VectorText::List(list)) => {
                    for ((place, number), name) in values.iter_mut().zip(list).zip(coordinates) {
                        *place = value(&format!("{path}.{name}"), number)?;
                    }
                }
                // points of modes have no coordinates of their own
                Some(VectorText::Named(table)) => {
                    for (name, number) in &table.0 {
                        let path = format!("{path}.{name}");
                        let place = coordinates.iter().position(|known| known == name).ok_or_else(|| {
                            let known = coordinates.join(", ");
                            MachineTextError::new(&path, MachineProblem::Unknown { name: name.clone(), known })
                        })?;
                        values[place] = value(&path, number)?;
                    }
                }
            }
            Ok(values)
        };
        Ok(StartNumbers {
            q: vector("start.q", self.q.as_ref())?,
            qdot: vector("start.qdot", self.qdot.as_ref())?,
            phase: self.phase.as_ref().map_or(Ok(0.0), |number| value("start.phase", number))?,
        })
    }
}

fn wrong(path: &str, what: String) -> MachineTextError {
    MachineTextError::new(path, MachineProblem::Text(what))
}

impl From<StartNumbers> for MachineStart {
    fn from(StartNumbers { q, qdot, phase }: StartNumbers) -> Self {
        Self { q, qdot, phase }
    }
}

impl From<&StartNumbers> for StartText {
    fn from(numbers: &StartNumbers) -> Self {
        let zero = |value: &f64| value.to_bits() == 0;
        let list = |values: &[f64]| {
            let list = values.iter().map(|value| NumberText::Value(*value)).collect();
            (!values.iter().all(zero)).then_some(VectorText::List(list))
        };
        Self {
            q: list(&numbers.q),
            qdot: list(&numbers.qdot),
            phase: (!zero(&numbers.phase)).then_some(NumberText::Value(numbers.phase)),
        }
    }
}
