//! The parameters of an oscillator and of a body, as they are written in plans.

use crate::{BodyNumber, PlanError, SecondStop, SystemPlan};
use vibroimpact::Parameter as OfOscillator;

/// A number of an oscillator, or of a body in SI units.
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
    /// A number of a body.
    Body(BodyNumber),
}

impl From<OfOscillator> for Parameter {
    fn from(parameter: OfOscillator) -> Self {
        match parameter {
            OfOscillator::Beta => Self::Beta,
            OfOscillator::InverseBeta => Self::InverseBeta,
            OfOscillator::Gap => Self::Gap,
            OfOscillator::Restitution => Self::Restitution,
            OfOscillator::Damping => Self::Damping,
            OfOscillator::SecondGap => Self::SecondGap,
            OfOscillator::SecondRestitution => Self::SecondRestitution,
        }
    }
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

    /// The parameter of the oscillator; `None` for a number of a body.
    pub(crate) const fn of_oscillator(self) -> Option<OfOscillator> {
        Some(match self {
            Self::Beta => OfOscillator::Beta,
            Self::InverseBeta => OfOscillator::InverseBeta,
            Self::Gap => OfOscillator::Gap,
            Self::Restitution => OfOscillator::Restitution,
            Self::Damping => OfOscillator::Damping,
            Self::SecondGap => OfOscillator::SecondGap,
            Self::SecondRestitution => OfOscillator::SecondRestitution,
            Self::Body(_) => return None,
        })
    }

    /// The number of a body; `None` for a parameter of the oscillator.
    #[must_use]
    pub const fn of_body(self) -> Option<BodyNumber> {
        if let Self::Body(number) = self { Some(number) } else { None }
    }

    /// Its name in plans and tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Body(number) => number.name(),
            Self::Beta => OfOscillator::Beta.name(),
            Self::InverseBeta => OfOscillator::InverseBeta.name(),
            Self::Gap => OfOscillator::Gap.name(),
            Self::Restitution => OfOscillator::Restitution.name(),
            Self::Damping => OfOscillator::Damping.name(),
            Self::SecondGap => OfOscillator::SecondGap.name(),
            Self::SecondRestitution => OfOscillator::SecondRestitution.name(),
        }
    }

    /// The parameter with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let own = OfOscillator::from_name(name).map(Self::from);
        own.or_else(|| BodyNumber::from_name(name).map(Self::Body))
    }

    /// Whether two parameters determine the same number, so that only one of them can vary.
    #[must_use]
    pub fn same_number(self, other: Self) -> bool {
        match (self, other) {
            (Self::Body(a), Self::Body(b)) => a.same_number(b),
            (Self::Body(BodyNumber::Restitutions), Self::Restitution | Self::SecondRestitution)
            | (Self::Restitution | Self::SecondRestitution, Self::Body(BodyNumber::Restitutions)) => true,
            (a, b) => a == b || a.is_frequency() && b.is_frequency(),
        }
    }

    /// Whether it is a frequency ratio of an oscillator.
    #[must_use]
    pub const fn is_frequency(self) -> bool {
        matches!(self, Self::Beta | Self::InverseBeta)
    }
}

/// Whether a parameter is a length (with unit $`F/k`$).
#[must_use]
pub const fn is_length(parameter: Parameter) -> bool {
    matches!(parameter, Parameter::Gap | Parameter::SecondGap)
}

/// The names of all parameters, those of a body last.
#[must_use]
pub fn parameter_names() -> Vec<&'static str> {
    let own = Parameter::ALL.map(Parameter::name).into_iter();
    own.chain(BodyNumber::ALL.map(BodyNumber::name)).collect()
}

impl SystemPlan {
    /// The same system with another value of one parameter. A value of $`\beta`$ or $`1/\beta`$ replaces whichever was
    /// given. For a body all its other numbers are held.
    ///
    /// # Errors
    /// [`PlanError::NoSecondStop`] for a parameter of a second stop if there is none, [`PlanError::NoBody`] for a
    /// number of a body if the system is none, and [`PlanError`] for a value of such a number that gives no system.
    pub fn with(&self, parameter: Parameter, value: f64) -> Result<Self, PlanError> {
        self.with_all([(parameter, value)])
    }

    /// The same system with other values of several parameters. A body is converted once, with all of them: between two
    /// of them its stops may leave no room.
    ///
    /// # Errors
    /// As [`Self::with`].
    pub fn with_all(&self, values: impl IntoIterator<Item = (Parameter, f64)>) -> Result<Self, PlanError> {
        self.with_each(&mut values.into_iter())
    }

    /// The same, compiled once for all callers.
    fn with_each(&self, values: &mut dyn Iterator<Item = (Parameter, f64)>) -> Result<Self, PlanError> {
        let Some(mut body) = self.body else {
            let mut system = *self;
            for (parameter, value) in values {
                system = system.changed(parameter, value)?;
            }
            return Ok(system);
        };
        let mut exact = Vec::new();
        for (parameter, value) in values {
            body = body.with(parameter, value)?;
            // a nondimensional number is exactly the given one, although the body rounds it
            if matches!(parameter, Parameter::Beta | Parameter::InverseBeta | Parameter::Gap | Parameter::SecondGap) {
                exact.push((parameter, value));
            }
        }
        exact
            .into_iter()
            .try_fold(Self::of_stored(body.stored())?, |system, (parameter, value)| system.changed(parameter, value))
    }

    /// The same nondimensional numbers but for one.
    fn changed(&self, parameter: Parameter, value: f64) -> Result<Self, PlanError> {
        let second = || self.second_stop.ok_or(PlanError::NoSecondStop(parameter.name()));
        Ok(match parameter {
            Parameter::Beta => Self { beta: Some(value), inverse_beta: None, ..*self },
            Parameter::InverseBeta => Self { beta: None, inverse_beta: Some(value), ..*self },
            Parameter::Gap => Self { gap: value, ..*self },
            Parameter::Restitution => Self { restitution: value, ..*self },
            Parameter::Damping => Self { damping: value, ..*self },
            Parameter::SecondGap => Self { second_stop: Some(SecondStop { gap: value, ..second()? }), ..*self },
            Parameter::SecondRestitution => {
                Self { second_stop: Some(SecondStop { restitution: value, ..second()? }), ..*self }
            }
            Parameter::Body(number) => return Err(PlanError::NoBody(number.name())),
        })
    }

    /// The value of a parameter, exactly as given where it was given.
    ///
    /// # Errors
    /// [`PlanError`] for an invalid system, or for a parameter of a second stop if there is none.
    pub fn value(&self, parameter: Parameter) -> Result<f64, PlanError> {
        if let (Parameter::InverseBeta, Some(inverse)) = (parameter, self.inverse_beta) {
            return Ok(inverse);
        }
        let value = match parameter.of_oscillator() {
            Some(parameter) => parameter.get(&self.oscillator()?),
            None => self.body.ok_or(PlanError::NoBody(parameter.name()))?.value(parameter),
        };
        value.ok_or(PlanError::NoSecondStop(parameter.name()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_set_and_nothing_else() {
        let stop = SecondStop { gap: 1.0, restitution: 0.7 };
        let system = SystemPlan {
            beta: Some(0.9),
            gap: 0.5,
            restitution: 0.6,
            second_stop: Some(stop),
            ..SystemPlan::default()
        };
        let with = |parameter: Parameter| system.with(parameter, 0.25).unwrap();
        assert_eq!((with(Parameter::InverseBeta).beta, with(Parameter::InverseBeta).inverse_beta), (None, Some(0.25)));
        assert_eq!(with(Parameter::Beta), SystemPlan { beta: Some(0.25), ..system });
        assert_eq!(with(Parameter::Gap), SystemPlan { gap: 0.25, ..system });
        assert_eq!(with(Parameter::Restitution), SystemPlan { restitution: 0.25, ..system });
        assert_eq!(with(Parameter::Damping), SystemPlan { damping: 0.25, ..system });
        assert_eq!(with(Parameter::SecondGap).second_stop, Some(SecondStop { gap: 0.25, ..stop }));
        assert_eq!(with(Parameter::SecondRestitution).second_stop, Some(SecondStop { restitution: 0.25, ..stop }));
        let single = SystemPlan { second_stop: None, ..system };
        assert_eq!(single.with(Parameter::SecondGap, 1.0), Err(PlanError::NoSecondStop("second_gap")));
        assert_eq!(single.value(Parameter::SecondGap), Err(PlanError::NoSecondStop("second_gap")));
        for parameter in Parameter::ALL {
            assert_eq!(with(parameter).value(parameter), Ok(0.25));
        }
    }

    #[test]
    fn names_are_those_of_the_core() {
        use serde::{Deserialize, Serialize};
        #[derive(Serialize, Deserialize)]
        struct Named(#[serde(with = "crate::name")] Parameter);
        for parameter in Parameter::ALL {
            let text = serde_json::to_value(Named(parameter)).unwrap();
            assert_eq!(text, parameter.name());
            assert_eq!(serde_json::from_value::<Named>(text).unwrap().0, parameter);
        }
        let error = serde_json::from_str::<Named>("\"mass\"").err().unwrap().to_string();
        assert!(error.contains("`mass` is no parameter; there are beta, inverse_beta"), "{error}");
    }
}
