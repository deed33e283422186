//! A machine with its start.

use super::{MachineSource, Named, NumberText, StartText, VectorText};
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
