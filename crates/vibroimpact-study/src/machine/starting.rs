//! A machine with its start.

use super::{MachineSource, Named, NumberText, StartAxis, StartText, VectorText};
use crate::PlanError;
use vibroimpact::events::{Limits, Motion, Start};
use vibroimpact::machine::Machine;

impl MachineSource {
    /// The same machine with another start. Vectors that are empty are 0.
    #[must_use]
    pub fn starting(mut self, start: &Start) -> Self {
        let vector = |values: &[f64]| {
            let list = values.iter().map(|value| NumberText::Value(*value)).collect();
            (!values.is_empty()).then_some(VectorText::List(list))
        };
        let phase = (start.phase != 0.0).then_some(NumberText::Value(start.phase));
        // contacts have names in a machine only; another file is refused later
        let contacts = if start.contacts.is_empty() { None } else { self.parts().ok() };
        let contacts = contacts.map(|parts| StartText::of(start, &parts).contacts).unwrap_or_default();
        let exact = Named(start.exact.clone());
        let text = StartText { q: vector(&start.q), qdot: vector(&start.qdot), phase, contacts, exact };
        self.start = (text != StartText::default()).then_some(text);
        self
    }

    /// The machine, checked, and the start, which may lie beyond a rigid stop. The tasks that vary a number have their own
    /// starts at each value.
    ///
    /// # Errors
    /// [`PlanError::Machine`] with the path of the first number that is not allowed.
    pub fn described(&self) -> Result<(Machine, Start), PlanError> {
        Ok((self.machine()?, self.start()?))
    }

    /// The same with these values of numbers and of what has a place in the start; the start may depend on the numbers.
    pub(crate) fn described_at(
        &self,
        values: &[(&str, Option<&StartAxis>, f64)],
    ) -> Result<(Machine, Start), PlanError> {
        let numbers = values.iter().filter(|(_, place, _)| place.is_none()).map(|(path, _, value)| (*path, *value));
        let (machine, mut start) = self.with_all(numbers)?.described()?;
        for (_, place, value) in values {
            place.iter().for_each(|place| place.set(&mut start, *value));
        }
        Ok((machine, start))
    }

    /// The machine and the start, both checked.
    ///
    /// # Errors
    /// [`PlanError::Machine`] with the path of the first number that is not allowed.
    pub fn problem(&self) -> Result<(Machine, Start), PlanError> {
        let (machine, start) = self.described()?;
        let limits = Limits::default();
        Motion::new(&machine, &start, limits).map_err(|error| PlanError::Machine(error.into()))?;
        Ok((machine, start))
    }
}
