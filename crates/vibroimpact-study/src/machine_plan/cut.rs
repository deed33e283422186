//! A line in the space of the numbers of a machine: one varies between two values, and a second one may vary in proportion.

use crate::PlanError;
use crate::cut::in_proportion;
use crate::machine::{MachineSource, VariedMachine};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vibroimpact::continuation::{MachineFamily, MachinePlane};

/// A number of a machine, and its values at two ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineStretch {
    /// The path of the number.
    pub path: String,
    /// Its first value; of a curve the smallest one.
    pub from: f64,
    /// Its last value; of a curve the largest one.
    pub to: f64,
}

/// A number of a machine that varies from its value there to another one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineTarget {
    /// The path of the number.
    pub path: String,
    /// Where it goes.
    pub to: f64,
}

/// The line of an orbit diagram or a branch of a machine. A point on it is given by the value of the first number.
///
/// ```
/// use vibroimpact_study::{MachineCut, MachineStretch, machine::CATALOGUE};
/// let source = CATALOGUE.iter().find(|entry| entry.name == "two-mass-hammer").unwrap().source()?;
/// let also = Some(MachineStretch { path: "stop.anvil.gap".into(), from: 0.5, to: 1.5 });
/// let halfway = MachineCut { vary: "frequency".into(), ends: (1.0, 2.0), also }.source(&source, 1.5)?;
/// assert_eq!((halfway.number("frequency")?, halfway.number("stop.anvil.gap")?), (1.5, 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MachineCut {
    /// The path of the number that varies.
    pub vary: String,
    /// Its values at the two ends of the line.
    pub ends: (f64, f64),
    /// The second number, if any, with its values at the same ends.
    pub also: Option<MachineStretch>,
}

impl MachineCut {
    /// The paths of the numbers that vary, one or two.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        core::iter::once(self.vary.as_str()).chain(self.also.as_ref().map(|also| also.path.as_str()))
    }

    /// The values of the numbers that vary, where the first has the value `value`.
    pub fn values(&self, value: f64) -> impl Iterator<Item = f64> {
        let second = self.also.as_ref().map(|also| in_proportion(value, self.ends, (also.from, also.to)));
        core::iter::once(value).chain(second)
    }

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
        Ok(source.with_all(self.paths().zip(values))?)
    }

    /// The machines along the line.
    pub(super) fn family(&self, source: &MachineSource) -> MachineFamily {
        let samples = [self.ends.0, 0.5 * (self.ends.0 + self.ends.1), self.ends.1].map(|at| self.values(at).collect());
        let (cut, varied) = (self.clone(), VariedMachine::new(source, self.paths(), &samples));
        varied.family(move |[value]| cut.values(value).collect())
    }

    /// Checks that the second number is another one, that its values are finite, and both paths.
    pub(super) fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        source.number(&self.vary)?;
        let Some(MachineStretch { path, from, to }) = &self.also else { return Ok(()) };
        if *path == self.vary {
            return Err(PlanError::MachineTogether(path.clone()));
        }
        if !(from.is_finite() && to.is_finite()) {
            return Err(PlanError::MachineAlso { path: path.clone(), from: *from, to: *to });
        }
        source.number(path)?;
        Ok(())
    }
}

/// Checks that two numbers and their ranges span a plane of machines.
pub(super) fn check_plane(
    source: &MachineSource,
    one: &MachineStretch,
    other: &MachineStretch,
) -> Result<(), PlanError> {
    for MachineStretch { path, from, to } in [one, other] {
        source.number(path)?;
        if !(from.is_finite() && to.is_finite() && from < to) {
            return Err(PlanError::MachineStretch { path: path.clone(), from: *from, to: *to });
        }
    }
    if one.path == other.path {
        return Err(PlanError::MachineAxisTwice(one.path.clone()));
    }
    for p in [one.from, one.to] {
        for q in [other.from, other.to] {
            source.with(&one.path, p)?.with(&other.path, q)?.machine()?;
        }
    }
    Ok(())
}

/// The plane of two numbers over their ranges.
pub(super) fn plane(source: &MachineSource, one: &MachineStretch, other: &MachineStretch) -> MachinePlane {
    let corners: Vec<Vec<f64>> =
        [one.from, one.to].iter().flat_map(|p| [vec![*p, other.from], vec![*p, other.to]]).collect();
    let varied = VariedMachine::new(source, [one, other].into_iter().map(|stretch| stretch.path.as_str()), &corners);
    let family = varied.family(|values: [f64; 2]| values.to_vec());
    MachinePlane::of(family, (one.from..=one.to, other.from..=other.to))
}
