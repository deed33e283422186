//! The plan for the margins of a motion.

use super::scope::{ScaledParameter, Scope};
use crate::dynamics::{Dynamics, Setup};
use crate::machine::MachineSource;
use crate::name::{Name, renamed};
use crate::{BodyNumber, Parameter, PlanError, StartPlan, SystemPlan, limits};
use serde::{Deserialize, Serialize};
use vibroimpact::Label;

/// Default ratio of the ends of the range of a parameter to its value.
pub const DEFAULT_WITHIN: f64 = 2.0;
/// Default number of lines from the centre of the box to scattered points of its surface.
pub const DEFAULT_LINES: u32 = 200;
/// Largest allowed ratio.
const MOST_WITHIN: f64 = 100.0;
/// Largest allowed number of scattered points.
const MOST_LINES: u32 = 100_000;

/// The distances of a motion from its nearest events, and a box of parameters in which it was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, bound = "V: Name")]
#[schemars(rename = "MarginsPlan", bound = "V: Name")]
pub struct MarginsPlan<V = Parameter> {
    /// Where the motion of an oscillator starts, at rest when absent: it is the motion into which this start settles. A machine
    /// has a start of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartPlan>,
    /// m/n of the motion instead of a start: the stable orbit, else the fastest one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// The numbers that vary. All parameters of an oscillator when absent; of a machine the parameters of its file, and the
    /// numbers that are written as such and are not 0, without directions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vary: Vec<ScaledParameter<V>>,
    /// The range of a parameter goes from its value divided by this number to its value times this number; a
    /// restitution goes from 0 to 1.
    #[serde(default = "within")]
    #[schemars(range(min = 1, max = 100))]
    pub within: f64,
    /// Number of lines from the centre of the box to scattered points of its surface, besides those to the centres of
    /// its faces and to its corners; 200 when absent. Margins of a machine have no box.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 100_000))]
    pub lines: Option<u32>,
}

const fn within() -> f64 {
    DEFAULT_WITHIN
}

renamed!(MarginsPlan: names, parts vary, others start label within lines);

impl<V> MarginsPlan<V> {
    /// The number of lines to scattered points.
    #[must_use]
    pub fn lines(&self) -> u32 {
        self.lines.unwrap_or(DEFAULT_LINES)
    }
}

impl<V> Default for MarginsPlan<V> {
    /// Of the motion from rest, in all parameters.
    fn default() -> Self {
        Self { start: None, label: None, vary: Vec::new(), within: DEFAULT_WITHIN, lines: None }
    }
}

impl MarginsPlan {
    /// Where the motion starts.
    pub(crate) fn start(&self) -> StartPlan {
        self.start.unwrap_or_default()
    }

    /// The parameters of a system, the frequency in the form in which it is given. A body has its numbers in SI units,
    /// without those that are 0.
    #[must_use]
    pub fn parameters(system: &SystemPlan) -> Vec<Parameter> {
        if let Some(body) = &system.body {
            let coefficient = body.damping_ns_per_m.is_some();
            let kept = |of: &BodyNumber| match of {
                BodyNumber::DampingCoefficient => coefficient,
                BodyNumber::DampingRatio => !coefficient,
                BodyNumber::BaseDisplacement => body.base_displacement_m.is_some(),
                BodyNumber::BaseVelocity => body.base_velocity_m_per_s.is_some(),
                BodyNumber::BaseAcceleration => body.base_acceleration_m_per_s2.is_some(),
                // a stop on the base moves with it
                BodyNumber::StopDisplacement => body.stop_apart(),
                BodyNumber::Gaps | BodyNumber::Restitutions => false,
                _ => true,
            };
            let given = |of: &BodyNumber| {
                let always = matches!(of, BodyNumber::Gap | BodyNumber::SecondGap);
                of.get(body).is_some_and(|value| always || value != 0.0)
            };
            let own = BodyNumber::ALL.into_iter().filter(kept).filter(given).map(Parameter::Body);
            let restitutions = [Parameter::Restitution, Parameter::SecondRestitution];
            return own.chain(restitutions.into_iter().filter(|of| system.value(*of).is_ok())).collect();
        }
        let other = if system.inverse_beta.is_some() { Parameter::Beta } else { Parameter::InverseBeta };
        Parameter::ALL.into_iter().filter(|of| *of != other && system.value(*of).is_ok()).collect()
    }

    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        match &self.label {
            Some(_) if self.start() != StartPlan::default() => {
                let sentence = "the motion is given twice, by its label and by a start";
                return Err(PlanError::refused(format!("{sentence}\nhint: a label alone, or a start alone")));
            }
            Some(label) => label.parse::<Label>().map(|_| ())?,
            None => self.start().start(&system.oscillator()?).map(|_| ())?,
        }
        check_within(self.within)?;
        limits::check("lines", self.lines(), 0..=MOST_LINES)?;
        for (k, one) in self.vary.iter().enumerate() {
            let same = |other: &&ScaledParameter| other.parameter.same_number(one.parameter);
            if let Some(other) = self.vary[..k].iter().find(same) {
                let both = format!("{} and {} are both to vary", other.parameter.name(), one.parameter.name());
                let why = "each parameter varies once, and the frequency in one form";
                return Err(PlanError::refused(format!("{both}: {why}")));
            }
            if let Some(given) = one.scale.filter(|scale| !(*scale > 0.0 && scale.is_finite())) {
                let name = one.parameter.name();
                let hint = format!("it is the change of {name} that counts as 1 in the box");
                let needed = "a positive finite number is needed";
                return Err(PlanError::refused(format!("the scale of {name} is {given}: {needed}\nhint: {hint}")));
            }
        }
        self.scopes(system).map(|_| ())
    }
}

impl<V: Name> MarginsPlan<V> {
    /// The numbers that vary, with their ranges and scales.
    pub(crate) fn scopes<D: Dynamics<Name = V>>(&self, system: &D) -> Result<Vec<Scope<V>>, PlanError> {
        if !self.vary.is_empty() {
            return self.vary.iter().map(|one| system.scope(one, self.within)).collect();
        }
        let alone = |parameter| system.scope(&ScaledParameter { parameter, scale: None }, self.within);
        system.free_numbers()?.into_iter().map(alone).collect()
    }
}

impl MarginsPlan<String> {
    /// Checks everything that can be checked without running the plan.
    pub(crate) fn check(&self, of: &Setup<'_, MachineSource>) -> Result<(), PlanError> {
        check_within(self.within)?;
        of.check_orbit((self.label.as_deref(), None), false)?;
        if self.lines.is_some() || self.vary.iter().any(|one| one.scale.is_some()) {
            return Err(PlanError::refused("margins of a machine have no box, so no scales and no lines"));
        }
        self.vary.iter().try_for_each(|one| Ok(of.written.number(&one.parameter).map(drop)?))
    }
}

/// Checks the ratio of the ends of ranges to values.
fn check_within(given: f64) -> Result<(), PlanError> {
    if given > 1.0 && given <= MOST_WITHIN {
        return Ok(());
    }
    let range = format!("1 < within <= {MOST_WITHIN}");
    let hint = "\nhint: 2 is from half of each value to twice the value";
    Err(PlanError::OutOfRange { name: "within", given: given.to_string(), range, hint })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SecondStop;

    const SYSTEM: SystemPlan = SystemPlan::from_inverse_beta(1.11, 1.5, 0.5);

    #[test]
    fn the_parameters_are_those_of_the_system() {
        use Parameter::{Beta, Damping, Gap, InverseBeta, Restitution, SecondGap, SecondRestitution};
        assert_eq!(MarginsPlan::parameters(&SYSTEM), [InverseBeta, Gap, Restitution, Damping]);
        let second_stop = Some(SecondStop { gap: 2.0, restitution: 0.4 });
        let two = SystemPlan { beta: Some(0.9), inverse_beta: None, second_stop, ..SYSTEM };
        let all = [Beta, Gap, Restitution, Damping, SecondGap, SecondRestitution];
        assert_eq!(MarginsPlan::parameters(&two), all);
    }
}
