//! The parameters of the core, as they are written in plans.

use crate::{PlanError, SecondStop, SystemPlan};
pub use vibroimpact::Parameter;
use vibroimpact::{PhysicalParameter, SystemError};

/// Whether a parameter is a length (with unit $`F/k`$).
#[must_use]
pub const fn is_length(parameter: Parameter) -> bool {
    matches!(parameter, Parameter::Gap | Parameter::SecondGap)
}

/// The names of all parameters, those of a machine last.
pub(crate) fn names() -> Vec<&'static str> {
    let machine = PhysicalParameter::ALL.map(PhysicalParameter::name);
    Parameter::ALL.map(Parameter::name).into_iter().chain(machine).collect()
}

impl SystemPlan {
    /// The same system with another value of one parameter. A value of $`\beta`$ or $`1/\beta`$ replaces whichever was
    /// given. For a machine all its other numbers are held.
    ///
    /// # Errors
    /// [`PlanError::NoSecondStop`] for a parameter of a second stop if there is none, [`SystemError::NotPhysical`] for a
    /// number of a machine if the system is none, and [`PlanError`] for a value of such a number that gives no system.
    pub fn with(&self, parameter: Parameter, value: f64) -> Result<Self, PlanError> {
        self.with_all([(parameter, value)])
    }

    /// The same system with other values of several parameters. A machine is converted once, with all of them: between two
    /// of them its stops may leave no room.
    ///
    /// # Errors
    /// As [`Self::with`].
    pub fn with_all(&self, values: impl IntoIterator<Item = (Parameter, f64)>) -> Result<Self, PlanError> {
        self.with_each(&mut values.into_iter())
    }

    /// The same, compiled once for all callers.
    fn with_each(&self, values: &mut dyn Iterator<Item = (Parameter, f64)>) -> Result<Self, PlanError> {
        let Some(mut machine) = self.machine else {
            let mut system = *self;
            for (parameter, value) in values {
                system = system.changed(parameter, value)?;
            }
            return Ok(system);
        };
        let mut exact = Vec::new();
        for (parameter, value) in values {
            machine = machine.with(parameter, value)?;
            // a nondimensional number is exactly the given one, although the machine rounds it
            if matches!(parameter, Parameter::Beta | Parameter::InverseBeta | Parameter::Gap | Parameter::SecondGap) {
                exact.push((parameter, value));
            }
        }
        exact
            .into_iter()
            .try_fold(Self::of_machine(machine)?, |system, (parameter, value)| system.changed(parameter, value))
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
            Parameter::Physical(parameter) => return Err(SystemError::NotPhysical(parameter.name()).into()),
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
        if let Parameter::Physical(parameter) = parameter {
            let machine = self.machine.ok_or(SystemError::NotPhysical(parameter.name()))?;
            return parameter.get(&machine).ok_or(PlanError::NoSecondStop(parameter.name()));
        }
        parameter.get(&self.oscillator()?).ok_or(PlanError::NoSecondStop(parameter.name()))
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
