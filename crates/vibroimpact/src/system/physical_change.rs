//! A machine with another value of a parameter, its own or one of its oscillator; lines and planes of such machines.

use super::{
    Damping, DrivenOscillator, Frequency, OscillatorFamily, Parameter, ParameterPath, ParameterPlane, PhysicalStop,
    Reduced, SystemError,
};

impl DrivenOscillator {
    /// The same machine with another value of a parameter, of its own or of its oscillator, and all its other numbers.
    ///
    /// # Errors
    /// [`SystemError::NoSecondStop`] for a parameter of a second stop if there is none; for a parameter of the oscillator
    /// that is measured in units of the machine, the errors of [`Self::reduced`].
    pub fn with(&self, parameter: Parameter, value: f64) -> Result<Self, SystemError> {
        let mut changed = *self;
        let machine = &mut changed.machine;
        let second = || self.machine.second_stop.ok_or(SystemError::NoSecondStop(parameter.name()));
        match parameter {
            Parameter::Physical(parameter) => return parameter.set(self, value),
            Parameter::Beta => machine.frequency = Frequency::RadPerS(value / self.reduced()?.scales.time_s),
            Parameter::InverseBeta => {
                machine.frequency = Frequency::RadPerS(1.0 / (value * self.reduced()?.scales.time_s));
            }
            Parameter::Damping => machine.damping = Damping::Ratio(value),
            Parameter::Gap => {
                let Reduced { scales, offset_m, .. } = self.reduced()?;
                // the gaps of the oscillator count from the equilibrium under the constant force
                machine.gap_m = value * scales.length_m + offset_m;
            }
            Parameter::Restitution => machine.restitution = value,
            Parameter::SecondGap => {
                let Reduced { scales, offset_m, .. } = self.reduced()?;
                machine.second_stop = Some(PhysicalStop { gap_m: value * scales.length_m - offset_m, ..second()? });
            }
            Parameter::SecondRestitution => {
                machine.second_stop = Some(PhysicalStop { restitution: value, ..second()? });
            }
        }
        Ok(changed)
    }

    /// The value of a parameter, of its own or of its oscillator; `None` if it does not have it.
    #[must_use]
    pub fn value(&self, parameter: Parameter) -> Option<f64> {
        match parameter {
            Parameter::Physical(parameter) => parameter.get(self),
            parameter => parameter.get(&self.reduced().ok()?.oscillator),
        }
    }

    fn known(&self, parameter: Parameter) -> Result<f64, SystemError> {
        self.value(parameter).ok_or(SystemError::NoSecondStop(parameter.name()))
    }

    /// The line along which a parameter varies, and all other numbers of the machine do not, but for one that changes by a
    /// rate when the parameter changes by 1. The numbers of the oscillator change together: with the mass, the frequency
    /// ratio and, for a given damping coefficient, the damping ratio.
    ///
    /// # Errors
    /// [`SystemError::NoSecondStop`] for a parameter that the machine does not have, [`SystemError::Together`] for two that
    /// are the same, [`SystemError::Rate`] for a rate that is not finite.
    pub fn line(self, parameter: Parameter, also: Option<(Parameter, f64)>) -> Result<ParameterPath, SystemError> {
        let from = self.known(parameter)?;
        let also = match also {
            Some((other, _)) if parameter.same_number(other) => {
                return Err(SystemError::Together(parameter.name(), other.name()));
            }
            Some((other, rate)) if !rate.is_finite() => return Err(SystemError::Rate { name: other.name(), rate }),
            Some((other, rate)) => Some((other, rate, self.known(other)?)),
            None => None,
        };
        let at = move |[value]: [f64; 1]| {
            let changed = self.with(parameter, value)?;
            let changed = match also {
                Some((other, rate, second)) => changed.with(other, second + rate * (value - from))?,
                None => changed,
            };
            changed.reduced().map(|reduced| reduced.oscillator)
        };
        Ok(OscillatorFamily::new(at, [from]).into())
    }

    /// The plane in which two parameters vary, and all other numbers of the machine do not.
    ///
    /// # Errors
    /// [`SystemError::NoSecondStop`] for a parameter that the machine does not have.
    pub fn plane(self, (first, second): (Parameter, Parameter)) -> Result<ParameterPlane, SystemError> {
        let at = move |[p, q]: [f64; 2]| Ok(self.with(first, p)?.with(second, q)?.reduced()?.oscillator);
        Ok(OscillatorFamily::new(at, [self.known(first)?, self.known(second)?]).into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Excitation, PhysicalOscillator, PhysicalParameter};

    #[test]
    fn parameters_of_the_oscillator_are_set_and_read() {
        let machine = PhysicalOscillator {
            mass_kg: 0.7,
            damping: Damping::NsPerM(2.1),
            stiffness_n_per_m: 900.0,
            force_n: 3.0,
            frequency: Frequency::Hz(5.0),
            gap_m: 0.004,
            restitution: 0.7,
            second_stop: Some(PhysicalStop { gap_m: 0.006, restitution: 0.6 }),
        };
        let driven =
            DrivenOscillator { machine, excitation: Excitation { constant_force_n: 0.5, ..Excitation::default() } };
        for parameter in Parameter::ALL {
            let changed = driven.with(parameter, 0.45).unwrap();
            assert!((changed.value(parameter).unwrap() - 0.45).abs() < 1e-15, "{}", parameter.name());
            for other in PhysicalParameter::ALL.map(Parameter::Physical) {
                let moved = changed.value(other) != driven.value(other);
                let expected = match parameter {
                    Parameter::Beta | Parameter::InverseBeta => "frequency_hz",
                    Parameter::Gap => "gap_m",
                    Parameter::SecondGap => "second_gap_m",
                    Parameter::Damping => "damping",
                    _ => "",
                };
                assert!(!moved || !expected.is_empty() && other.name().starts_with(expected), "{}", other.name());
            }
        }
        let alone = DrivenOscillator { machine: PhysicalOscillator { second_stop: None, ..machine }, ..driven };
        assert_eq!(alone.with(Parameter::SecondGap, 1.0), Err(SystemError::NoSecondStop("second_gap")));
    }
}
