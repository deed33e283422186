//! A line in the space of the numbers of a machine: one varies between two values, and a second one may vary in proportion.

use crate::machine::{MachineSource, VariedMachine};
use crate::{Cut, PlanError, Stretch};
use vibroimpact::continuation::machine::{Family, Plane};

impl Cut<String> {
    /// The machine as it is written, where the first number has the value `value`. It is not checked.
    ///
    /// # Errors
    /// [`PlanError::Machine`] if a path leads to no number.
    pub fn source(&self, source: &MachineSource, value: f64) -> Result<MachineSource, PlanError> {
        self.with(source, self.values(value))
    }

    /// The machine as it is written, with these values of the numbers that vary.
    pub(super) fn with(
        &self,
        source: &MachineSource,
        values: impl Iterator<Item = f64>,
    ) -> Result<MachineSource, PlanError> {
        Ok(source.with_all(self.names().map(String::as_str).zip(values))?)
    }

    /// The machines along the line.
    pub(super) fn family(&self, source: &MachineSource) -> Family {
        let samples = [self.ends.0, 0.5 * (self.ends.0 + self.ends.1), self.ends.1].map(|at| self.values(at).collect());
        let (cut, varied) = (self.clone(), VariedMachine::new(source, self.names().map(String::as_str), &samples));
        varied.family(move |[value]| cut.values(value).collect())
    }

    /// Checks that the second number is another one, that its values are finite, and both paths.
    pub(super) fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        source.number(&self.vary)?;
        let Some(Stretch { parameter: path, from, to }) = &self.also else { return Ok(()) };
        if *path == self.vary {
            return Err(PlanError::MachineTogether(path.clone()));
        }
        if !(from.is_finite() && to.is_finite()) {
            return Err(PlanError::Endless { name: path.clone().into(), from: *from, to: *to });
        }
        source.number(path)?;
        Ok(())
    }
}

/// Checks that two numbers and their ranges span a plane of machines.
pub(super) fn check_plane(
    source: &MachineSource,
    one: &Stretch<String>,
    other: &Stretch<String>,
) -> Result<(), PlanError> {
    for Stretch { parameter: path, from, to } in [one, other] {
        source.number(path)?;
        if !(from.is_finite() && to.is_finite() && from < to) {
            return Err(PlanError::Stretch { name: path.clone().into(), from: *from, to: *to });
        }
    }
    if one.parameter == other.parameter {
        return Err(PlanError::SameParameter(one.parameter.clone().into(), other.parameter.clone().into()));
    }
    for p in [one.from, one.to] {
        for q in [other.from, other.to] {
            source.with(&one.parameter, p)?.with(&other.parameter, q)?.machine()?;
        }
    }
    Ok(())
}

/// The plane of two numbers over their ranges.
pub(super) fn plane(source: &MachineSource, one: &Stretch<String>, other: &Stretch<String>) -> Plane {
    let corners: Vec<Vec<f64>> =
        [one.from, one.to].iter().flat_map(|p| [vec![*p, other.from], vec![*p, other.to]]).collect();
    let varied =
        VariedMachine::new(source, [one, other].into_iter().map(|stretch| stretch.parameter.as_str()), &corners);
    let family = varied.family(|values: [f64; 2]| values.to_vec());
    Plane::of(family, (one.from..=one.to, other.from..=other.to))
}
