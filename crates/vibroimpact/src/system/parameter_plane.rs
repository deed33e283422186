//! A plane of two parameters of an oscillator or of a machine.

use super::physical::rates;
use super::{DrivenOscillator, Oscillator, Parameter, ParameterPath, SystemError};

/// Two parameters that vary. All other numbers have the values of the oscillator; in a plane of machines, those of the
/// machine to which the plane belongs.
///
/// ```
/// use vibroimpact::{Oscillator, Parameter, ParameterPlane};
/// let osc = Oscillator::from_inverse_beta(1.0, 0.5, 0.8)?;
/// let plane = ParameterPlane::from((Parameter::InverseBeta, Parameter::Gap));
/// let there = plane.set(&osc, (1.25, 2.0))?;
/// assert_eq!((there.beta(), there.gap(), there.restitution()), (0.8, 2.0, 0.8));
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterPlane {
    parameters: (Parameter, Parameter),
    /// The machine whose numbers vary.
    machine: Option<DrivenOscillator>,
}

impl From<(Parameter, Parameter)> for ParameterPlane {
    fn from(parameters: (Parameter, Parameter)) -> Self {
        Self { parameters, machine: None }
    }
}

impl ParameterPlane {
    /// The plane in which two numbers of a machine vary, and all its other numbers do not.
    #[must_use]
    pub const fn of_machine(machine: DrivenOscillator, parameters: (Parameter, Parameter)) -> Self {
        Self { parameters, machine: Some(machine) }
    }

    /// The two parameters.
    #[must_use]
    pub const fn parameters(&self) -> (Parameter, Parameter) {
        self.parameters
    }

    /// Whether its points are machines.
    #[must_use]
    pub const fn is_of_machines(&self) -> bool {
        self.machine.is_some()
    }

    /// Whether one of its parameters fulfils a condition.
    pub(crate) fn has(&self, condition: impl Fn(Parameter) -> bool) -> bool {
        condition(self.parameters.0) || condition(self.parameters.1)
    }

    /// The oscillator at a point of the plane; `osc` has the numbers that do not vary, if the plane is not one of machines.
    ///
    /// # Errors
    /// [`SystemError`] for values that give no valid system.
    pub fn set(&self, osc: &Oscillator, (p, q): (f64, f64)) -> Result<Oscillator, SystemError> {
        match &self.machine {
            Some(machine) => Ok(machine.with(self.parameters.0, p)?.with(self.parameters.1, q)?.reduced()?.oscillator),
            None => self.parameters.1.set(&self.parameters.0.set(osc, p)?, q),
        }
    }

    /// The oscillator at a place of a line, and the point of the plane there. The line is one of machines if the plane is,
    /// and then the point is that of the machine of the plane, changed in the parameter of the line.
    ///
    /// # Errors
    /// [`SystemError`] for a value that gives no valid system, [`SystemError::NoSecondStop`] for a parameter of a second
    /// stop if there is only one stop.
    pub(crate) fn on_line(
        &self,
        osc: &Oscillator,
        line: ParameterPath,
        value: f64,
    ) -> Result<(Oscillator, (f64, f64)), SystemError> {
        let (p, q) = self.parameters;
        let osc = line.set(osc, value)?;
        let changed = self.machine.map(|machine| machine.with(line.parameter(), value)).transpose()?;
        let of = |parameter: Parameter| {
            let value = match &changed {
                Some(machine) => machine.value(parameter),
                None => parameter.get(&osc),
            };
            value.ok_or(SystemError::NoSecondStop(parameter.name()))
        };
        Ok((osc, (of(p)?, of(q)?)))
    }

    /// For each of the two parameters: the parameters of the oscillator that vary with it, with their change for a change
    /// of it by 1.
    ///
    /// # Errors
    /// [`SystemError`] for values that give no valid system.
    pub(crate) fn rates(&self, (p, q): (f64, f64)) -> Result<[Vec<(Parameter, f64)>; 2], SystemError> {
        let Some(machine) = &self.machine else {
            return Ok([vec![(self.parameters.0, 1.0)], vec![(self.parameters.1, 1.0)]]);
        };
        // the numbers of the machine do not depend on the oscillator given
        let at = |p, q| -> Result<Oscillator, SystemError> {
            Ok(machine.with(self.parameters.0, p)?.with(self.parameters.1, q)?.reduced()?.oscillator)
        };
        let size = |parameter| machine.value(parameter).map_or(0.0, f64::abs);
        let along =
            [rates(|p| at(p, q), p, size(self.parameters.0))?, rates(|q| at(p, q), q, size(self.parameters.1))?];
        Ok(along.map(super::parameter_path::named))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Damping, Excitation, Frequency, PhysicalOscillator, PhysicalParameter};

    const MACHINE: DrivenOscillator = DrivenOscillator {
        machine: PhysicalOscillator {
            mass_kg: 0.8,
            damping: Damping::Ratio(0.02),
            stiffness_n_per_m: 12e3,
            force_n: 30.0,
            frequency: Frequency::Hz(20.0),
            gap_m: 1.5e-3,
            restitution: 0.65,
            second_stop: None,
        },
        excitation: Excitation {
            base: crate::system::Shaking { amplitude: crate::system::Amplitude::DisplacementM(0.0), phase: 0.0 },
            stop: crate::system::Shaking { amplitude: crate::system::Amplitude::DisplacementM(0.0), phase: 0.0 },
            unbalance_kg_m: 0.0,
            constant_force_n: 0.0,
            gravity_m_per_s2: 0.0,
        },
    };

    #[test]
    fn numbers_of_a_machine_change_the_oscillator_as_by_hand() {
        use Parameter::{Beta, Damping as Ratio, Gap, Physical};
        let (mass, force) = (Physical(PhysicalParameter::Mass), Physical(PhysicalParameter::Force));
        let plane = ParameterPlane::of_machine(MACHINE, (mass, force));
        let osc = plane.set(&MACHINE.reduced().unwrap().oscillator, (1.1, 40.0)).unwrap();
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-14 * b.abs();
        assert!(near(osc.beta(), core::f64::consts::TAU * 20.0 * (1.1_f64 / 12e3).sqrt()));
        assert!(near(osc.gap(), 1.5e-3 * 12e3 / 40.0));
        // beta grows with the square root of the mass; the damping ratio is given and stays; the gap falls with the force
        let [by_mass, by_force] = plane.rates((1.1, 40.0)).unwrap();
        let of = |rates: &[(Parameter, f64)], one| {
            rates.iter().find(|(parameter, _)| *parameter == one).map_or(0.0, |(_, rate)| *rate)
        };
        assert!((of(&by_mass, Beta) / (0.5 * osc.beta() / 1.1) - 1.0).abs() < 1e-8);
        assert!((of(&by_force, Gap) / (-osc.gap() / 40.0) - 1.0).abs() < 1e-8);
        assert_eq!((of(&by_mass, Ratio), of(&by_mass, Gap), of(&by_force, Beta)), (0.0, 0.0, 0.0));
    }

    #[test]
    fn a_place_of_a_line_is_a_point_of_the_plane() {
        let frequency = Parameter::Physical(PhysicalParameter::Frequency);
        let plane = ParameterPlane::of_machine(MACHINE, (frequency, Parameter::Restitution));
        let osc = MACHINE.reduced().unwrap().oscillator;
        let line = ParameterPath::of_machine(MACHINE, frequency);
        let (there, point) = plane.on_line(&osc, line, 22.0).unwrap();
        assert_eq!((point, there), ((22.0, 0.65), plane.set(&osc, (22.0, 0.65)).unwrap()));
        let second = ParameterPlane::from((Parameter::Gap, Parameter::SecondGap));
        let refused = second.on_line(&osc, Parameter::Gap.into(), 1.0).unwrap_err();
        assert_eq!(refused, SystemError::NoSecondStop("second_gap"));
    }
}
