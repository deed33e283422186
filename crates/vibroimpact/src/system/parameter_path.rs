//! A line through one or two parameters of an oscillator, or a line of oscillators that follow from another number.

use super::{Oscillator, OscillatorFamily, Parameter, SystemError};

/// A parameter that varies, and optionally another one that varies in proportion to it: a straight line through the
/// parameters. The value of the first parameter gives the place on the line. For each oscillator, the line is the one that
/// passes through it.
///
/// An [`OscillatorFamily`] is a line too: that of its own oscillators. The place is the value of its number.
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
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterPath(Line);

#[derive(Clone, Debug, PartialEq)]
enum Line {
    /// Of each oscillator.
    Parameters {
        first: Parameter,
        /// The other parameter, and its change for a change of the first by 1.
        also: Option<(Parameter, f64)>,
    },
    Family(OscillatorFamily<1>),
}

impl From<Parameter> for ParameterPath {
    fn from(first: Parameter) -> Self {
        Self(Line::Parameters { first, also: None })
    }
}

impl From<OscillatorFamily<1>> for ParameterPath {
    fn from(family: OscillatorFamily<1>) -> Self {
        Self(Line::Family(family))
    }
}

impl ParameterPath {
    /// The same with `other` changing by `rate` when the first parameter changes by 1; it replaces another one set
    /// before.
    ///
    /// # Errors
    /// [`SystemError::Together`] if `other` varies already, [`SystemError::Rate`] if the rate is not finite,
    /// [`SystemError::OwnLine`] for the line of a family.
    pub fn with(self, other: Parameter, rate: f64) -> Result<Self, SystemError> {
        let Line::Parameters { first, .. } = self.0 else { return Err(SystemError::OwnLine(other.name())) };
        if first.same_number(other) {
            return Err(SystemError::Together(first.name(), other.name()));
        }
        if !rate.is_finite() {
            return Err(SystemError::Rate { name: other.name(), rate });
        }
        Ok(Self(Line::Parameters { first, also: Some((other, rate)) }))
    }

    /// The parameters of the oscillator that vary, with their change when the value that gives the place changes by 1,
    /// where it is `value`. Only on the line of a family do they depend on the place.
    ///
    /// # Errors
    /// [`SystemError`] for a value of the number of a family that gives no valid system.
    pub fn rates(&self, value: f64) -> Result<Vec<(Parameter, f64)>, SystemError> {
        match &self.0 {
            Line::Parameters { first, also } => Ok(core::iter::once((*first, 1.0)).chain(*also).collect()),
            Line::Family(family) => family.rates([value]).map(|[rates]| rates),
        }
    }

    /// The place of an oscillator on its line: the value of the first parameter. On the line of a family it is where that
    /// was given, and `osc` must be its oscillator there.
    ///
    /// # Errors
    /// [`SystemError::NoSecondStop`] for a parameter of a second stop if there is only one stop.
    pub fn get(&self, osc: &Oscillator) -> Result<f64, SystemError> {
        match &self.0 {
            Line::Parameters { first, also } => {
                // only to refuse a parameter that this oscillator lacks
                also.map_or(Ok(0.0), |(other, _)| value(other, osc))?;
                value(*first, osc)
            }
            Line::Family(family) => Ok(family.from()[0]),
        }
    }

    /// The oscillator at a place of the line through `osc`.
    ///
    /// # Errors
    /// As [`Parameter::set`], for either parameter.
    pub fn set(&self, osc: &Oscillator, place: f64) -> Result<Oscillator, SystemError> {
        let (first, also) = match &self.0 {
            Line::Parameters { first, also } => (first, also),
            Line::Family(family) => return family.at([place]),
        };
        let Some((other, rate)) = *also else { return first.set(osc, place) };
        let second = value(other, osc)? + rate * (place - value(*first, osc)?);
        // after the first change the two stops may leave no room; then the other order is possible
        match first.set(osc, place) {
            Ok(halfway) => other.set(&halfway, second),
            Err(_) => first.set(&other.set(osc, second)?, place),
        }
    }
}

/// The value of a parameter.
pub(super) fn value(parameter: Parameter, osc: &Oscillator) -> Result<f64, SystemError> {
    parameter.get(osc).ok_or(SystemError::NoSecondStop(parameter.name()))
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
        assert_eq!(line.rates(1.5).unwrap(), [(Parameter::Gap, 1.0), (Parameter::Restitution, -0.25)]);
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
        assert_eq!(gap.clone().with(Parameter::Gap, 1.0), Err(SystemError::Together("gap", "gap")));
        assert!(matches!(gap.clone().with(Parameter::Beta, f64::NAN), Err(SystemError::Rate { name: "beta", .. })));
        let frequency = ParameterPath::from(Parameter::Beta).with(Parameter::InverseBeta, 1.0);
        assert_eq!(frequency, Err(SystemError::Together("beta", "inverse_beta")));
        let osc = Oscillator::new(0.9, 0.5, 0.6).unwrap();
        let second = gap.with(Parameter::SecondGap, 1.0).unwrap();
        assert_eq!(second.get(&osc), Err(SystemError::NoSecondStop("second_gap")));
        assert_eq!(second.set(&osc, 1.0), Err(SystemError::NoSecondStop("second_gap")));
    }
}
