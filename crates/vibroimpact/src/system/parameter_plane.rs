//! A plane of two parameters of an oscillator, or of oscillators that follow from two other numbers.

use super::parameter_path::value;
use super::{Oscillator, OscillatorFamily, Parameter, ParameterPath, SystemError};

/// Two parameters that vary; all other numbers have the values of the oscillator. Or the two numbers of an
/// [`OscillatorFamily`].
///
/// ```
/// use vibroimpact::{Oscillator, Parameter, ParameterPlane};
/// let osc = Oscillator::from_inverse_beta(1.0, 0.5, 0.8)?;
/// let plane = ParameterPlane::from((Parameter::InverseBeta, Parameter::Gap));
/// let there = plane.set(&osc, (1.25, 2.0))?;
/// assert_eq!((there.beta(), there.gap(), there.restitution()), (0.8, 2.0, 0.8));
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterPlane(Plane);

#[derive(Clone, Debug, PartialEq)]
enum Plane {
    Parameters(Parameter, Parameter),
    Family(OscillatorFamily<2>),
}

impl From<(Parameter, Parameter)> for ParameterPlane {
    fn from((first, second): (Parameter, Parameter)) -> Self {
        Self(Plane::Parameters(first, second))
    }
}

impl From<OscillatorFamily<2>> for ParameterPlane {
    fn from(family: OscillatorFamily<2>) -> Self {
        Self(Plane::Family(family))
    }
}

impl ParameterPlane {
    /// The two parameters; `None` in the plane of a family, whose numbers are those of no oscillator.
    #[must_use]
    pub const fn parameters(&self) -> Option<(Parameter, Parameter)> {
        match &self.0 {
            Plane::Parameters(first, second) => Some((*first, *second)),
            Plane::Family(_) => None,
        }
    }

    /// The oscillator at a point of the plane; `osc` has the numbers that do not vary, unless the plane is that of a family.
    ///
    /// # Errors
    /// [`SystemError`] for values that give no valid system.
    pub fn set(&self, osc: &Oscillator, (p, q): (f64, f64)) -> Result<Oscillator, SystemError> {
        match &self.0 {
            Plane::Parameters(first, second) => second.set(&first.set(osc, p)?, q),
            Plane::Family(family) => family.at([p, q]),
        }
    }

    /// The oscillator at a place of a line through `osc`, and the point of the plane there. In the plane of a family it is
    /// where that was given.
    ///
    /// # Errors
    /// [`SystemError`] for a value that gives no valid system, [`SystemError::NoSecondStop`] for a parameter of a second
    /// stop if there is only one stop.
    pub(crate) fn on_line(
        &self,
        osc: &Oscillator,
        line: &ParameterPath,
        place: f64,
    ) -> Result<(Oscillator, (f64, f64)), SystemError> {
        let osc = line.set(osc, place)?;
        let point = match &self.0 {
            Plane::Parameters(first, second) => (value(*first, &osc)?, value(*second, &osc)?),
            Plane::Family(family) => family.from().into(),
        };
        Ok((osc, point))
    }

    /// For each of the two numbers: the parameters of the oscillator that vary with it, with their change for a change
    /// of it by 1.
    ///
    /// # Errors
    /// [`SystemError`] for values that give no valid system.
    pub(crate) fn rates(&self, (p, q): (f64, f64)) -> Result<[Vec<(Parameter, f64)>; 2], SystemError> {
        match &self.0 {
            Plane::Parameters(first, second) => Ok([vec![(*first, 1.0)], vec![(*second, 1.0)]]),
            Plane::Family(family) => family.rates([p, q]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Damping, DrivenOscillator, Excitation, Frequency, PhysicalOscillator, PhysicalParameter};

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
        let plane = MACHINE.plane((mass, force)).unwrap();
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
        let plane = MACHINE.with(frequency, 22.0).unwrap().plane((frequency, Parameter::Restitution)).unwrap();
        let osc = MACHINE.reduced().unwrap().oscillator;
        let line = MACHINE.line(frequency, None).unwrap();
        let (there, point) = plane.on_line(&osc, &line, 22.0).unwrap();
        assert_eq!((point, there), ((22.0, 0.65), plane.set(&osc, (22.0, 0.65)).unwrap()));
        let second = ParameterPlane::from((Parameter::Gap, Parameter::SecondGap));
        let refused = second.on_line(&osc, &Parameter::Gap.into(), 1.0).unwrap_err();
        assert_eq!(refused, SystemError::NoSecondStop("second_gap"));
    }
}
