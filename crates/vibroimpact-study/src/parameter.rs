//! What can vary: the parameters of a system by name.

use crate::{PlanError, SecondStop, SystemPlan};
use serde::{Deserialize, Serialize};

/// A parameter of a [`SystemPlan`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// $`\beta`$.
    Beta,
    /// $`1/\beta`$.
    InverseBeta,
    /// $`\delta`$.
    Gap,
    /// $`\varepsilon`$ of the first stop.
    Restitution,
    /// $`\zeta`$.
    Damping,
    /// $`\delta_2`$, the gap of the second stop.
    SecondGap,
    /// $`\varepsilon_2`$, the restitution of the second stop.
    SecondRestitution,
}

impl Parameter {
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

    /// Whether its unit is that of a length.
    #[must_use]
    pub const fn is_length(self) -> bool {
        matches!(self, Self::Gap | Self::SecondGap)
    }

    /// `system` with another value of this parameter. Setting $`\beta`$ or $`1/\beta`$ replaces whichever was given.
    ///
    /// # Errors
    /// [`PlanError::NoSecondStop`] for a parameter of a second stop that is not there.
    pub fn set(self, system: &SystemPlan, value: f64) -> Result<SystemPlan, PlanError> {
        let second = || system.second_stop.ok_or(PlanError::NoSecondStop(self.name()));
        Ok(match self {
            Self::Beta => SystemPlan { beta: Some(value), inverse_beta: None, ..*system },
            Self::InverseBeta => SystemPlan { beta: None, inverse_beta: Some(value), ..*system },
            Self::Gap => SystemPlan { gap: value, ..*system },
            Self::Restitution => SystemPlan { restitution: value, ..*system },
            Self::Damping => SystemPlan { damping: value, ..*system },
            Self::SecondGap => SystemPlan { second_stop: Some(SecondStop { gap: value, ..second()? }), ..*system },
            Self::SecondRestitution => {
                SystemPlan { second_stop: Some(SecondStop { restitution: value, ..second()? }), ..*system }
            }
        })
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
        let with = |parameter: Parameter| parameter.set(&system, 0.25).unwrap();
        assert_eq!((with(Parameter::InverseBeta).beta, with(Parameter::InverseBeta).inverse_beta), (None, Some(0.25)));
        assert_eq!(with(Parameter::Beta), SystemPlan { beta: Some(0.25), ..system });
        assert_eq!(with(Parameter::Gap), SystemPlan { gap: 0.25, ..system });
        assert_eq!(with(Parameter::Restitution), SystemPlan { restitution: 0.25, ..system });
        assert_eq!(with(Parameter::Damping), SystemPlan { damping: 0.25, ..system });
        assert_eq!(with(Parameter::SecondGap).second_stop, Some(SecondStop { gap: 0.25, ..stop }));
        assert_eq!(with(Parameter::SecondRestitution).second_stop, Some(SecondStop { restitution: 0.25, ..stop }));
        let single = SystemPlan { second_stop: None, ..system };
        assert_eq!(Parameter::SecondGap.set(&single, 1.0), Err(PlanError::NoSecondStop("second_gap")));
    }

    #[test]
    fn names_are_those_of_the_plan() {
        for parameter in [Parameter::Beta, Parameter::InverseBeta, Parameter::SecondRestitution] {
            assert_eq!(serde_json::to_value(parameter).unwrap(), parameter.name());
        }
    }
}
