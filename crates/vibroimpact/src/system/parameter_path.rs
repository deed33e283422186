//! A straight line through one or two parameters of an oscillator or of a machine.

use super::physical::rates;
use super::{DrivenOscillator, Oscillator, Parameter, SystemError};

/// A parameter that varies, and optionally another one that varies in proportion to it: a straight line through the
/// parameters. The value of the first parameter gives the place on the line.
///
/// For parameters of an oscillator it is a direction: for each oscillator, the line is the one that passes through it.
/// For numbers of a machine it belongs to that machine.
///
/// ```
/// use vibroimpact::{Oscillator, Parameter, ParameterPath};
/// let osc = Oscillator::from_inverse_beta(1.0, 0.5, 0.8)?;
/// // the gap grows twice as fast as 1/beta
/// let line = ParameterPath::from(Parameter::InverseBeta).with(Parameter::Gap, 2.0)?;
/// let further = line.set(&osc, 1.25)?;
/// assert_eq!((further.beta(), further.gap()), (0.8, 1.0));
/// assert_eq!(line.set(&further, 1.0)?, osc);
/// assert!(line.with(Parameter::Beta, 1.0).is_err(), "the frequency varies already");
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterPath {
    parameter: Parameter,
    /// The other parameter, and its change for a change of the first by 1.
    also: Option<(Parameter, f64)>,
    /// The machine whose numbers vary.
    machine: Option<DrivenOscillator>,
}

impl From<Parameter> for ParameterPath {
    fn from(parameter: Parameter) -> Self {
        Self { parameter, also: None, machine: None }
    }
}

impl ParameterPath {
    /// The same with `other` changing by `rate` when the first parameter changes by 1; it replaces another one set
    /// before.
    ///
    /// # Errors
    /// [`SystemError::Together`] if `other` varies already, [`SystemError::Rate`] if the rate is not finite,
    /// [`SystemError::NotPhysical`] for a number of a machine if the line is none of machines.
    pub fn with(self, other: Parameter, rate: f64) -> Result<Self, SystemError> {
        if self.parameter.same_number(other) {
            return Err(SystemError::Together(self.parameter.name(), other.name()));
        }
        if let (Parameter::Physical(parameter), None) = (other, self.machine) {
            return Err(SystemError::NotPhysical(parameter.name()));
        }
        if !rate.is_finite() {
            return Err(SystemError::Rate { name: other.name(), rate });
        }
        Ok(Self { also: Some((other, rate)), ..self })
    }

    /// The line along which a number of a machine varies, and all its other numbers do not. The numbers of the oscillator
    /// change together: with the mass, the frequency ratio and, for a given damping coefficient, the damping ratio.
    #[must_use]
    pub const fn of_machine(machine: DrivenOscillator, parameter: Parameter) -> Self {
        Self { parameter, also: None, machine: Some(machine) }
    }

    /// The machine at a place of a line of machines.
    fn machine_at(&self, machine: &DrivenOscillator, value: f64) -> Result<DrivenOscillator, SystemError> {
        let changed = machine.with(self.parameter, value)?;
        let Some((other, rate)) = self.also else { return Ok(changed) };
        let missing = |parameter: Parameter| SystemError::NoSecondStop(parameter.name());
        let from = machine.value(self.parameter).ok_or_else(|| missing(self.parameter))?;
        let second = machine.value(other).ok_or_else(|| missing(other))? + rate * (value - from);
        changed.with(other, second)
    }

    /// The parameter whose value gives the place on the line.
    #[must_use]
    pub const fn parameter(self) -> Parameter {
        self.parameter
    }

    /// The parameters of the oscillator that vary, with their change when the first parameter of the line changes by 1,
    /// where that has the value `value`. They depend on this value for numbers of a machine only.
    ///
    /// # Errors
    /// [`SystemError`] for a value of a number of a machine that gives no valid system.
    pub fn rates(self, value: f64) -> Result<impl Iterator<Item = (Parameter, f64)>, SystemError> {
        let (line, machine) = match &self.machine {
            Some(machine) => {
                let along = |value| self.machine_at(machine, value)?.reduced().map(|reduced| reduced.oscillator);
                let rates = rates(along, value, machine.value(self.parameter).map_or(0.0, f64::abs))?;
                (None, named(rates))
            }
            None => (Some((self.parameter, 1.0)), Vec::new()),
        };
        let also = self.also.filter(|_| line.is_some());
        Ok(line.into_iter().chain(also).chain(machine))
    }

    /// The place of an oscillator on its line: the value of the first parameter. For a number of a machine it is that of
    /// the machine to which the line belongs, whose oscillator `osc` must be.
    ///
    /// # Errors
    /// [`SystemError::NoSecondStop`] for a parameter of a second stop if there is only one stop.
    pub fn get(self, osc: &Oscillator) -> Result<f64, SystemError> {
        if let Some(machine) = &self.machine {
            return machine.value(self.parameter).ok_or(SystemError::NoSecondStop(self.parameter.name()));
        }
        let value = |parameter: Parameter| parameter.get(osc).ok_or(SystemError::NoSecondStop(parameter.name()));
        self.also.map_or(Ok(0.0), |(other, _)| value(other))?;
        value(self.parameter)
    }

    /// The oscillator at a place of the line through `osc`.
    ///
    /// # Errors
    /// As [`Parameter::set`], for either parameter.
    pub fn set(self, osc: &Oscillator, value: f64) -> Result<Oscillator, SystemError> {
        if let Some(machine) = &self.machine {
            return self.machine_at(machine, value)?.reduced().map(|reduced| reduced.oscillator);
        }
        let Some((other, rate)) = self.also else { return self.parameter.set(osc, value) };
        let from = self.get(osc)?;
        let second = other.get(osc).ok_or(SystemError::NoSecondStop(other.name()))? + rate * (value - from);
        // after the first change the two stops may leave no room; then the other order is possible
        match self.parameter.set(osc, value) {
            Ok(halfway) => other.set(&halfway, second),
            Err(_) => self.parameter.set(&other.set(osc, second)?, value),
        }
    }
}

/// The parameters of an oscillator in the order of [`rates`].
const NUMBERS: [Parameter; 6] = [
    Parameter::Beta,
    Parameter::Gap,
    Parameter::Restitution,
    Parameter::Damping,
    Parameter::SecondGap,
    Parameter::SecondRestitution,
];

/// The parameters that change, with their [`rates`].
pub(super) fn named(rates: [f64; 6]) -> Vec<(Parameter, f64)> {
    NUMBERS.into_iter().zip(rates).filter(|(_, rate)| *rate != 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_parameters_in_proportion() {
        let osc = Oscillator::new(0.9, 0.5, 0.6).unwrap().with_second_stop(1.0, 0.7).unwrap();
        let line = ParameterPath::from(Parameter::Gap).with(Parameter::Restitution, -0.25).unwrap();
        let there = line.set(&osc, 1.5).unwrap();
        assert_eq!((there.gap(), there.restitution(), there.beta()), (1.5, 0.35, 0.9));
        assert_eq!(
            line.rates(1.5).unwrap().collect::<Vec<_>>(),
            [(Parameter::Gap, 1.0), (Parameter::Restitution, -0.25)]
        );
        assert_eq!(line.get(&there), Ok(1.5));
        assert!(matches!(line.set(&osc, 4.0), Err(SystemError::Restitution(_))));
        // both stops move in the same direction, so that one of them passes the former position of the other
        for way in [1.0, -1.0] {
            let aside = ParameterPath::from(Parameter::Gap).with(Parameter::SecondGap, -1.0).unwrap();
            let moved = aside.set(&osc, 0.5 + 3.0 * way).unwrap();
            assert_eq!((moved.gap(), Parameter::SecondGap.get(&moved)), (0.5 + 3.0 * way, Some(1.0 - 3.0 * way)));
        }
    }

    #[test]
    fn what_is_no_line_is_refused() {
        let gap = ParameterPath::from(Parameter::Gap);
        assert_eq!(gap.with(Parameter::Gap, 1.0), Err(SystemError::Together("gap", "gap")));
        assert!(matches!(gap.with(Parameter::Beta, f64::NAN), Err(SystemError::Rate { name: "beta", .. })));
        let frequency = ParameterPath::from(Parameter::Beta).with(Parameter::InverseBeta, 1.0);
        assert_eq!(frequency, Err(SystemError::Together("beta", "inverse_beta")));
        let osc = Oscillator::new(0.9, 0.5, 0.6).unwrap();
        let second = gap.with(Parameter::SecondGap, 1.0).unwrap();
        assert_eq!(second.get(&osc), Err(SystemError::NoSecondStop("second_gap")));
        assert_eq!(second.set(&osc, 1.0), Err(SystemError::NoSecondStop("second_gap")));
    }
}
