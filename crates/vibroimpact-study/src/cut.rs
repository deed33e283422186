//! A line in the space of the numbers of a system: one varies between two values, and a second one may vary in proportion.

use crate::machine::{MachineSource, VariedMachine};
use crate::{Parameter, PlanError, Stretch, SystemPlan};
use vibroimpact::continuation::machine::Family;
use vibroimpact::{Oscillator, ParameterPath};

/// The line of an orbit diagram or a branch. A point on it is given by the value of the first parameter.
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
pub struct Cut<V = Parameter> {
    /// The parameter that varies.
    pub vary: V,
    /// Its values at the two ends of the line.
    pub ends: (f64, f64),
    /// The second parameter, if any, with its values at the same ends.
    pub also: Option<Stretch<V>>,
}

impl<V> Cut<V> {
    /// What varies, one or two numbers.
    pub fn names(&self) -> impl Iterator<Item = &V> {
        core::iter::once(&self.vary).chain(self.also.as_ref().map(|also| &also.parameter))
    }

    /// The values of the numbers that vary, where the first has the value `value`.
    pub fn values(&self, value: f64) -> impl Iterator<Item = f64> + use<V> {
        let second = self.also.as_ref().map(|also| in_proportion(value, self.ends, (also.from, also.to)));
        core::iter::once(value).chain(second)
    }
}

impl Cut {
    /// The system where the first parameter has the value `value`. Other parameters are those of `system`.
    ///
    /// # Errors
    /// [`PlanError::NoSecondStop`] for a parameter of a second stop if there is none.
    pub fn system(&self, system: &SystemPlan, value: f64) -> Result<SystemPlan, PlanError> {
        system.with_all(self.names().copied().zip(self.values(value)))
    }

    /// The checked oscillator where the first parameter has the value `value`.
    ///
    /// # Errors
    /// [`PlanError`] for a value that gives no valid system.
    pub fn oscillator(&self, system: &SystemPlan, value: f64) -> Result<Oscillator, PlanError> {
        self.system(system, value)?.oscillator()
    }

    /// The same line in the form used for branches that begin where the first parameter has the value `value`.
    pub(crate) fn varying(&self, system: &SystemPlan, value: f64) -> Result<ParameterPath, PlanError> {
        let (first, last) = self.ends;
        let of_body = self.names().find_map(|parameter| parameter.of_body());
        if self.also.is_some() && first == last {
            return Err(PlanError::Nowhere { name: self.vary.name().into(), value: first });
        }
        let also = self.also.map(|also| (also.parameter, (also.to - also.from) / (last - first)));
        if let Some(number) = of_body {
            let there = self.system(system, value)?.body.ok_or(PlanError::NoBody(number.name()))?;
            return Ok(there.line(self.vary, also)?);
        }
        let own = |parameter: Parameter| parameter.of_oscillator().ok_or(PlanError::NoBody(parameter.name()));
        let alone = ParameterPath::from(own(self.vary)?);
        Ok(match also {
            Some((other, rate)) => alone.with(own(other)?, rate)?,
            None => alone,
        })
    }

    /// Checks the systems at both ends and that the two parameters form a line. If both ends are valid, every system
    /// between them is.
    pub(crate) fn check(&self, system: &SystemPlan) -> Result<(), PlanError> {
        for end in [self.ends.0, self.ends.1] {
            self.oscillator(system, end)?;
        }
        self.varying(system, self.ends.0).map(|_| ())
    }
}

impl Cut<String> {
    /// The machine as it is written, where the first number has the value `value`. It is not checked.
    ///
    /// # Errors
    /// [`PlanError::Machine`] if a path leads to no number.
    pub fn source(&self, source: &MachineSource, value: f64) -> Result<MachineSource, PlanError> {
        self.with(source, self.values(value))
    }

    /// The machine as it is written, with these values of the numbers that vary.
    pub(crate) fn with(
        &self,
        source: &MachineSource,
        values: impl Iterator<Item = f64>,
    ) -> Result<MachineSource, PlanError> {
        Ok(source.with_all(self.names().map(String::as_str).zip(values))?)
    }

    /// The machines along the line.
    pub(crate) fn family(&self, source: &MachineSource) -> Family {
        let samples = [self.ends.0, 0.5 * (self.ends.0 + self.ends.1), self.ends.1].map(|at| self.values(at).collect());
        let (cut, varied) = (self.clone(), VariedMachine::new(source, self.names().map(String::as_str), &samples));
        varied.family(move |[value]| cut.values(value).collect())
    }

    /// Checks that the second number is another one, that all values are finite, the paths, and the machine at the end.
    pub(crate) fn check(&self, source: &MachineSource) -> Result<(), PlanError> {
        source.number(&self.vary)?;
        let endless = |path: &String, (from, to): (f64, f64)| {
            let finite = from.is_finite() && to.is_finite();
            let sentence = || format!("{path} is to go from {from} to {to}, but both values are finite");
            if finite { Ok(()) } else { Err(PlanError::refused(sentence())) }
        };
        endless(&self.vary, self.ends)?;
        if let Some(Stretch { parameter: path, from, to }) = &self.also {
            if *path == self.vary {
                let why = "a line goes through two different numbers";
                return Err(PlanError::refused(format!("{path} and {path} cannot vary together: {why}")));
            }
            endless(path, (*from, *to))?;
            source.number(path)?;
        }
        self.source(source, self.ends.1)?.machine()?;
        Ok(())
    }
}

/// The value of a number that goes from one value to another in proportion to a first number, where that has the value `value`
/// between these ends.
pub(crate) fn in_proportion(value: f64, (first, last): (f64, f64), (from, to): (f64, f64)) -> f64 {
    match value {
        // exact at the ends, and exactly constant if both ends are equal
        _ if value == first || from == to => from,
        _ if value == last => to,
        _ => ((last - value) * from + (value - first) * to) / (last - first),
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
        let followed = line.varying(&system, 0.3).unwrap().set(&from, 1.9).unwrap();
        assert!((followed.beta() - there.beta()).abs() < 1e-15 && followed.gap() == there.gap());
        // the frequency is set in the form that varies (beta or its inverse), whichever form the system has
        let other = SystemPlan { beta: Some(3.0), inverse_beta: None, ..system };
        assert_eq!(line.system(&other, 0.3).unwrap(), line.system(&system, 0.3).unwrap());
        let level = cut(Some((Parameter::Damping, 0.1, 0.1)));
        assert!(
            line.values(1.0).count() == 2
                && (0..50).all(|k| { level.system(&system, 0.3 + 0.05 * f64::from(k)).unwrap().damping == 0.1 })
        );
    }
}
