//! A line through the parameters: one that varies between two values, and where asked a second one with it, in proportion.

use crate::{Parameter, PlanError, Stretch, SystemPlan};
use serde::{Deserialize, Serialize};
use vibroimpact::{Oscillator, ParameterPath};

/// The line of an orbit diagram or branch. The value of the first parameter gives the place on it.
///
/// ```
/// use vibroimpact_study::{Cut, Parameter, Stretch, SystemPlan};
/// let gap = Stretch { parameter: Parameter::Gap, from: 0.5, to: 1.5 };
/// let cut = Cut { vary: Parameter::InverseBeta, ends: (1.0, 2.0), also: Some(gap) };
/// let system = SystemPlan { restitution: 0.5, ..SystemPlan::default() };
/// let halfway = cut.system(&system, 1.5)?;
/// assert_eq!((halfway.inverse_beta, halfway.gap), (Some(1.5), 1.0));
/// # Ok::<(), vibroimpact_study::PlanError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The parameter that varies.
    pub vary: Parameter,
    /// Its first and last value.
    pub ends: (f64, f64),
    /// The one that varies with it, with its values at these ends.
    pub also: Option<Stretch>,
}

/// A parameter that varies from its value in the system to another one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// The parameter.
    #[serde(with = "crate::parameter")]
    #[schemars(with = "crate::parameter::Name")]
    pub parameter: Parameter,
    /// Where it goes.
    pub to: f64,
}

impl Cut {
    /// What varies, one or two parameters.
    pub fn parameters(&self) -> impl Iterator<Item = Parameter> + use<> {
        core::iter::once(self.vary).chain(self.also.map(|also| also.parameter))
    }

    /// The values of what varies, at a value of the first.
    pub fn values(&self, value: f64) -> impl Iterator<Item = (Parameter, f64)> + use<> {
        let (first, last) = self.ends;
        let second = move |also: Stretch| {
            let at = match value {
                // exactly the ends, and what is level stays so
                _ if value == first || also.from == also.to => also.from,
                _ if value == last => also.to,
                _ => ((last - value) * also.from + (value - first) * also.to) / (last - first),
            };
            (also.parameter, at)
        };
        core::iter::once((self.vary, value)).chain(self.also.map(second))
    }

    /// The system at a value of the first parameter; what does not vary is as in `system`.
    ///
    /// # Errors
    /// [`PlanError::NoSecondStop`] for a parameter of a second stop that is not there.
    pub fn system(&self, system: &SystemPlan, value: f64) -> Result<SystemPlan, PlanError> {
        self.values(value).try_fold(*system, |system, (parameter, value)| system.with(parameter, value))
    }

    /// The checked oscillator there.
    ///
    /// # Errors
    /// [`PlanError`] for a value that gives no legal system.
    pub fn oscillator(&self, system: &SystemPlan, value: f64) -> Result<Oscillator, PlanError> {
        self.system(system, value)?.oscillator()
    }

    /// What varies, as branches are followed in it.
    ///
    /// # Errors
    /// [`PlanError`] for two parameters that are one, and two ends that are one.
    pub fn varying(&self) -> Result<ParameterPath, PlanError> {
        let (first, last) = self.ends;
        let alone = ParameterPath::from(self.vary);
        let Some(also) = self.also else { return Ok(alone) };
        if first == last {
            return Err(PlanError::Nowhere { name: self.vary.name(), value: first });
        }
        Ok(alone.with(also.parameter, (also.to - also.from) / (last - first))?)
    }

    /// Checks both ends, between which all is legal where they are, and that two parameters make a line.
    ///
    /// # Errors
    /// [`PlanError`] names the first value that makes no sense.
    pub(crate) fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        for end in [self.ends.0, self.ends.1] {
            self.oscillator(system, end)?;
        }
        self.varying().map(|_| ())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(also: Option<(Parameter, f64, f64)>) -> Cut {
        let also = also.map(|(parameter, from, to)| Stretch { parameter, from, to });
        Cut { vary: Parameter::Gap, ends: (0.3, 2.7), also }
    }

    #[test]
    fn both_ends_are_exact_and_branches_take_the_same_way() {
        let system = SystemPlan { inverse_beta: Some(1.3), restitution: 0.5, ..SystemPlan::default() };
        let line = cut(Some((Parameter::InverseBeta, 0.7, 1.1)));
        let ends = [0.3, 2.7].map(|end| line.system(&system, end).unwrap().inverse_beta);
        assert_eq!(ends, [Some(0.7), Some(1.1)]);
        let (from, there) = (line.oscillator(&system, 0.3).unwrap(), line.oscillator(&system, 1.9).unwrap());
        let followed = line.varying().unwrap().set(&from, 1.9).unwrap();
        assert!((followed.beta() - there.beta()).abs() < 1e-15 && followed.gap() == there.gap());
        // the frequency is given in the form that varies, whatever form the system has
        let other = SystemPlan { beta: Some(3.0), inverse_beta: None, ..system };
        assert_eq!(line.system(&other, 0.3).unwrap(), line.system(&system, 0.3).unwrap());
        let level = cut(Some((Parameter::Damping, 0.1, 0.1)));
        assert!(
            line.values(1.0).count() == 2
                && (0..50).all(|k| { level.system(&system, 0.3 + 0.05 * f64::from(k)).unwrap().damping == 0.1 })
        );
    }

    #[test]
    fn lines_that_make_no_sense() {
        let system = SystemPlan { inverse_beta: Some(1.3), restitution: 0.5, ..SystemPlan::default() };
        assert_eq!(cut(None).check(&system), Ok(()));
        let point = Cut { ends: (0.3, 0.3), ..cut(Some((Parameter::Damping, 0.1, 0.2))) };
        for (cut, sentence) in [
            (cut(Some((Parameter::Gap, 0.0, 1.0))), "gap and gap cannot vary together"),
            (cut(Some((Parameter::Restitution, 0.5, 1.5))), "restitution eps = 1.5 lies outside"),
            (cut(Some((Parameter::SecondGap, 0.5, 1.5))), "second_gap is to vary, but there is no second stop"),
            (cut(Some((Parameter::Damping, 0.5, f64::NAN))), "damping ratio zeta = NaN"),
            (point, "gap is to go from 0.3 to 0.3"),
        ] {
            let message = cut.check(&system).unwrap_err().to_string();
            assert!(message.starts_with(sentence), "{message}");
        }
    }
}
