//! The table `[start]` of a machine file: where the machine begins if nothing else is asked.

use super::error::{MachineFileError, MachineProblem};
use super::named::Named;
use super::number::NumberText;
use super::places::NUMBER_ALONE;
use super::shapes::VectorText;
use crate::plan_text::is_usual;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::events::{ContactStart, Start};
use vibroimpact::machine::MachineParts;
use vibroimpact::regime::ContactState;

/// What a stop or a friction joint does at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ContactWord {
    /// A stop that is open.
    #[default]
    Open,
    /// A compliant stop that is closed.
    Closed,
    /// A stop on which the structure rests.
    Resting,
    /// A stop that is closed without force.
    Touching,
    /// A joint that slides with positive relative velocity.
    Forward,
    /// A joint that slides with negative relative velocity.
    Backward,
    /// A joint that holds.
    Holding,
}

const WORDS: [(ContactWord, ContactState, &str); 7] = [
    (ContactWord::Open, ContactState::Open, "open"),
    (ContactWord::Closed, ContactState::Closed, "closed"),
    (ContactWord::Resting, ContactState::Resting, "resting"),
    (ContactWord::Touching, ContactState::Touching, "touching"),
    (ContactWord::Forward, ContactState::Forward, "forward"),
    (ContactWord::Backward, ContactState::Backward, "backward"),
    (ContactWord::Holding, ContactState::Holding, "holding"),
];

/// The word for what a stop or a joint does.
#[must_use]
pub fn contact_word(state: ContactState) -> &'static str {
    WORDS.iter().find(|(_, of, _)| *of == state).map_or("open", |(.., word)| word)
}

/// A stop or a friction joint at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ContactText {
    /// What it does; open if absent.
    pub state: ContactWord,
    /// How far the surface of a damped stop stands back that has opened by force; 0 if absent.
    #[serde(skip_serializing_if = "is_usual")]
    pub surface: f64,
}

impl ContactText {
    fn of(contact: &ContactStart) -> Self {
        let word = WORDS.iter().find(|(_, of, _)| *of == contact.state).map(|(word, ..)| *word);
        Self { state: word.unwrap_or_default(), surface: contact.surface }
    }

    fn contact(self, place: usize) -> ContactStart {
        let state = WORDS.iter().find(|(word, ..)| *word == self.state).map(|(_, state, _)| *state);
        ContactStart { place, state: state.unwrap_or(ContactState::Open), surface: self.surface }
    }
}

/// The table `[start]`: coordinates, velocities and phase of the forcing at time 0, each 0 when absent, and contacts.
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
    /// What stops and joints do, by name: `{ stop = { state = "open", surface = 0.01 } }`. What the others do follows from
    /// coordinates and velocities.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub contacts: Named<ContactText>,
    /// The digits that coordinates, velocities and contacts leave out, as a printed state has them. They count only together
    /// with the numbers with which they were printed, and for the same machine.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub exact: Named<Vec<f64>>,
}

fn names(parts: &MachineParts) -> impl Iterator<Item = &String> {
    parts.stops.iter().map(|stop| &stop.name).chain(parts.joints.iter().map(|joint| &joint.name))
}

impl StartText {
    /// The table of a state of a machine, with all coordinates and velocities.
    #[must_use]
    pub fn of(start: &Start, parts: &MachineParts) -> Self {
        let list =
            |values: &[f64]| Some(VectorText::List(values.iter().map(|value| NumberText::Value(*value)).collect()));
        Self { q: list(&start.q), qdot: list(&start.qdot), ..Self::of_numbers(start, parts) }
    }

    /// The table of these numbers.
    pub(super) fn of_numbers(numbers: &Start, parts: &MachineParts) -> Self {
        let zero = |value: &f64| value.to_bits() == 0;
        let list = |values: &[f64]| {
            let list = values.iter().map(|value| NumberText::Value(*value)).collect();
            (!values.iter().all(zero)).then_some(VectorText::List(list))
        };
        let all: Vec<&String> = names(parts).collect();
        let contact = |contact: &ContactStart| Some(((*all.get(contact.place)?).clone(), ContactText::of(contact)));
        Self {
            q: list(&numbers.q),
            qdot: list(&numbers.qdot),
            phase: (!zero(&numbers.phase)).then_some(NumberText::Value(numbers.phase)),
            contacts: numbers.contacts.iter().filter_map(contact).collect(),
            exact: Named(numbers.exact.clone()),
        }
    }

    /// The numbers, for a machine of these parts.
    pub(super) fn numbers(&self, parts: &MachineParts, parameters: &Named<f64>) -> Result<Start, MachineFileError> {
        let coordinates = parts.coordinates.as_slice();
        let value = |path: &str, number: &NumberText| {
            let value = number.value(parameters).map_err(|error| MachineFileError::new(path, error))?;
            let finite = value.is_finite().then_some(value);
            finite.ok_or_else(|| MachineFileError::text(path, format!("{value} is not a finite number")))
        };
        let vector = |path: &str, vector: Option<&VectorText>| {
            let mut values = vec![0.0; coordinates.len()];
            match vector {
                None => {}
                Some(VectorText::One(_)) => return Err(MachineFileError::text(path, NUMBER_ALONE)),
                Some(VectorText::List(list)) if list.len() != coordinates.len() => {
                    let given = format!("{} numbers", list.len());
                    let of = format!("the coordinates {}", coordinates.join(", "));
                    let problem = MachineProblem::Size { given, wanted: coordinates.len(), of };
                    return Err(MachineFileError::new(path, problem));
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
                            MachineFileError::new(&path, MachineProblem::Unknown { name: name.clone(), known })
                        })?;
                        values[place] = value(&path, number)?;
                    }
                }
            }
            Ok(values)
        };
        let contact = |(name, contact): &(String, ContactText)| {
            let place = names(parts).position(|known| known == name).ok_or_else(|| {
                let known = names(parts).map(String::as_str).collect::<Vec<_>>().join(", ");
                let problem = MachineProblem::Unknown { name: name.clone(), known };
                MachineFileError::new(format!("start.contacts.{name}"), problem)
            })?;
            Ok(contact.contact(place))
        };
        Ok(Start {
            q: vector("start.q", self.q.as_ref())?,
            qdot: vector("start.qdot", self.qdot.as_ref())?,
            phase: self.phase.as_ref().map_or(Ok(0.0), |number| value("start.phase", number))?,
            contacts: self.contacts.0.iter().map(contact).collect::<Result<_, MachineFileError>>()?,
            exact: self.exact.0.clone(),
        })
    }
}
