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

    #[test]
    fn a_place_of_a_line_is_a_point_of_the_plane() {
        let osc = Oscillator::new(0.9, 0.5, 0.6).unwrap();
        let plane = ParameterPlane::from((Parameter::Beta, Parameter::Restitution));
        let (there, point) = plane.on_line(&osc, &Parameter::Beta.into(), 1.1).unwrap();
        assert_eq!((point, there), ((1.1, 0.6), plane.set(&osc, (1.1, 0.6)).unwrap()));
        let second = ParameterPlane::from((Parameter::Gap, Parameter::SecondGap));
        let refused = second.on_line(&osc, &Parameter::Gap.into(), 1.0).unwrap_err();
        assert_eq!(refused, SystemError::NoSecondStop("second_gap"));
    }
}
