//! The parameters of an oscillator by name.

use super::{Oscillator, Side, SystemError};

/// A parameter of an [`Oscillator`].
///
/// ```
/// use vibroimpact::{Oscillator, Parameter};
/// let osc = Oscillator::from_inverse_beta(1.11, 2.0, 0.5)?;
/// let other = Parameter::Gap.set(&osc, 3.0)?;
/// assert_eq!((other.gap(), other.beta()), (3.0, osc.beta()));
/// assert!(Parameter::SecondGap.set(&osc, 1.0).is_err());
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// Frequency ratio $`\beta`$, positive.
    Beta,
    /// Its inverse $`1/\beta`$, positive.
    InverseBeta,
    /// Gap $`\delta`$ of the first stop.
    Gap,
    /// Restitution $`\varepsilon`$ of the first stop, in [0, 1].
    Restitution,
    /// Damping ratio $`\zeta`$, not negative.
    Damping,
    /// Gap $`\delta_2`$ of the second stop.
    SecondGap,
    /// Restitution $`\varepsilon_2`$ of the second stop, in [0, 1].
    SecondRestitution,
}

impl Parameter {
    /// All parameters of an oscillator.
    pub const ALL: [Self; 7] = [
        Self::Beta,
        Self::InverseBeta,
        Self::Gap,
        Self::Restitution,
        Self::Damping,
        Self::SecondGap,
        Self::SecondRestitution,
    ];

    /// Its name in plans and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Beta => "beta",
            Self::InverseBeta => "inverse_beta",
            Self::Gap => "gap",
            Self::Restitution => "restitution",
            Self::Damping => "damping",
            Self::SecondGap => "second_gap",
            Self::SecondRestitution => "second_restitution",
        }
    }

    /// The parameter with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|parameter| parameter.name() == name)
    }

    /// Whether two parameters determine the same number, so that only one of them can vary.
    #[must_use]
    pub fn same_number(self, other: Self) -> bool {
        self == other || self.is_frequency() && other.is_frequency()
    }

    /// Whether it is a frequency ratio of an oscillator.
    #[must_use]
    pub const fn is_frequency(self) -> bool {
        matches!(self, Self::Beta | Self::InverseBeta)
    }

    /// Its value; `None` for a parameter of a second stop if there is only one stop.
    #[must_use]
    pub fn get(self, osc: &Oscillator) -> Option<f64> {
        let second = osc.stop(Side::Lower);
        match self {
            Self::Beta => Some(osc.beta()),
            Self::InverseBeta => Some(1.0 / osc.beta()),
            Self::Gap => Some(osc.gap()),
            Self::Restitution => Some(osc.restitution()),
            Self::Damping => Some(osc.damping()),
            Self::SecondGap => second.map(|stop| stop.gap),
            Self::SecondRestitution => second.map(|stop| stop.restitution),
        }
    }

    /// `osc` with another value of this parameter and the same values of all others.
    ///
    /// # Errors
    /// [`SystemError`] for a value outside the range of the parameter, [`SystemError::NoSecondStop`] for a parameter of
    /// a second stop if there is only one stop.
    pub fn set(self, osc: &Oscillator, value: f64) -> Result<Oscillator, SystemError> {
        let (mut beta, mut gap, mut restitution, mut damping) =
            (osc.beta(), osc.gap(), osc.restitution(), osc.damping());
        let mut second = osc.stop(Side::Lower);
        match (self, &mut second) {
            (Self::Beta, _) => beta = value,
            (Self::InverseBeta, _) => beta = Oscillator::from_inverse_beta(value, gap, restitution)?.beta(),
            (Self::Gap, _) => gap = value,
            (Self::Restitution, _) => restitution = value,
            (Self::Damping, _) => damping = value,
            (Self::SecondGap, Some(stop)) => stop.gap = value,
            (Self::SecondRestitution, Some(stop)) => stop.restitution = value,
            (Self::SecondGap | Self::SecondRestitution, None) => return Err(SystemError::NoSecondStop(self.name())),
        }
        let changed = Oscillator::new(beta, gap, restitution)?.with_damping(damping)?;
        match second {
            Some(stop) => changed.with_second_stop(stop.gap, stop.restitution),
            None => Ok(changed),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_set_and_nothing_else() {
        let osc =
            Oscillator::new(0.9, 0.5, 0.6).unwrap().with_damping(0.1).unwrap().with_second_stop(1.0, 0.7).unwrap();
        for parameter in Parameter::ALL {
            let changed = parameter.set(&osc, 0.25).unwrap();
            assert_eq!(parameter.get(&changed), Some(0.25));
            for other in Parameter::ALL {
                if other != parameter && !(other.is_frequency() && parameter.is_frequency()) {
                    assert_eq!(other.get(&changed), other.get(&osc), "{} moved {}", parameter.name(), other.name());
                }
            }
            // the first value restored to the last bit (an inverse is rounded twice)
            if parameter != Parameter::InverseBeta {
                assert_eq!(parameter.set(&changed, parameter.get(&osc).unwrap()).unwrap(), osc);
            }
        }
    }

    #[test]
    fn impossible_values_are_named() {
        let osc = Oscillator::new(0.9, 0.5, 0.6).unwrap();
        assert_eq!(Parameter::SecondGap.set(&osc, 1.0), Err(SystemError::NoSecondStop("second_gap")));
        assert_eq!(Parameter::SecondRestitution.get(&osc), None);
        assert_eq!(Parameter::InverseBeta.set(&osc, 0.0), Err(SystemError::InverseBeta(0.0)));
        assert_eq!(Parameter::Damping.set(&osc, -1.0), Err(SystemError::Damping(-1.0)));
        let both = osc.with_second_stop(1.0, 0.5).unwrap();
        assert!(matches!(Parameter::Gap.set(&both, -1.0), Err(SystemError::NoRoom { .. })));
    }
}
