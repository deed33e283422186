//! VARY: a parameter that varies over a range, and the system without it.

use super::SystemArgs;
use crate::failure::Failure;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use vibroimpact_report::Asked;
use vibroimpact_study::{Parameter, SystemPlan};

/// Parses a parameter from the name of its flag.
pub(crate) fn parameter() -> impl TypedValueParser<Value = Parameter> {
    let values = Parameter::ALL.map(|parameter| PossibleValue::new(flag(parameter)).help(meaning(parameter)));
    PossibleValuesParser::new(values).try_map(|name| {
        let named = Parameter::ALL.into_iter().find(|parameter| flag(*parameter) == name);
        named.ok_or_else(|| format!("`{name}` is no parameter"))
    })
}

/// The name of the flag of a parameter, without the dashes.
pub(crate) const fn flag(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::Beta => "beta",
        Parameter::InverseBeta => "inverse-beta",
        Parameter::Gap => "gap",
        Parameter::Restitution => "restitution",
        Parameter::Damping => "damping",
        Parameter::SecondGap => "second-gap",
        Parameter::SecondRestitution => "second-restitution",
    }
}

const fn meaning(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::Beta => "Frequency ratio omega/omega_n",
        Parameter::InverseBeta => "Its inverse omega_n/omega",
        Parameter::Gap => "Distance of the stop",
        Parameter::Restitution => "Restitution of the stop",
        Parameter::Damping => "Damping ratio zeta",
        Parameter::SecondGap => "Distance of the second stop",
        Parameter::SecondRestitution => "Restitution of the second stop",
    }
}

impl SystemArgs {
    /// The system in which the parameters that vary have their first values. They may not have other values. For each
    /// parameter the flags are given that make it vary and set its range. A system in physical units must be given
    /// completely, because its units depend on all quantities; its values are then replaced.
    pub(crate) fn varied(&self, varied: &[(Parameter, f64, [&str; 2])]) -> Result<Asked, Failure> {
        let mut args = *self;
        for (parameter, _, [varies, over]) in varied {
            let same = |other: &Parameter| other == parameter || other.is_frequency() && parameter.is_frequency();
            if let Some(given) = Parameter::ALL.into_iter().filter(same).find(|p| args.slot(*p).is_some()) {
                return Err(Failure::bad(format!(
                    "--{} cannot go together with --{varies} {}\nhint: leave it out, --{over} has its values",
                    flag(given),
                    flag(*parameter)
                )));
            }
            if *parameter == Parameter::Restitution && args.second_stop_follows() {
                return Err(Failure::bad(
                    "the restitution varies and that of the second stop is not given\nhint: --second-restitution E2",
                ));
            }
        }
        // in a system in physical units, the values are replaced in its units
        let machine = args.is_machine();
        let replaced = |parameter: Parameter| {
            machine && ![Parameter::Restitution, Parameter::SecondRestitution].contains(&parameter)
        };
        for (parameter, first, _) in varied.iter().filter(|(parameter, ..)| !replaced(*parameter)) {
            *args.slot(*parameter) = Some(*first);
        }
        let asked = args.asked()?;
        let set = |system: SystemPlan, (parameter, first, _): &(Parameter, f64, _)| {
            system.with(*parameter, first / asked.units.of(*parameter))
        };
        let mut own = varied.iter().filter(|(parameter, ..)| replaced(*parameter));
        Ok(Asked { system: own.try_fold(asked.system, set)?, ..asked })
    }
}
