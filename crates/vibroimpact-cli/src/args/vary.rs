//! VARY: the parameter that takes all values of a range, and the system without it.

use super::SystemArgs;
use crate::exit::Failure;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use vibroimpact_report::Asked;
use vibroimpact_study::Parameter;

/// A parameter by the name of its flag.
pub(crate) fn parameter() -> impl TypedValueParser<Value = Parameter> {
    let values = Parameter::ALL.map(|parameter| PossibleValue::new(flag(parameter)).help(meaning(parameter)));
    PossibleValuesParser::new(values).try_map(|name| {
        let named = Parameter::ALL.into_iter().find(|parameter| flag(*parameter) == name);
        named.ok_or_else(|| format!("`{name}` is no parameter"))
    })
}

/// Its flag, without the dashes.
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
    /// The system with `first` for the parameter that varies, which has no value of its own. A machine in physical units
    /// is given whole, because its units need all of it; its value is replaced.
    pub(crate) fn varied(&self, parameter: Parameter, first: f64) -> Result<Asked, Failure> {
        let frequency = [Parameter::Beta, Parameter::InverseBeta];
        let same =
            |other: &Parameter| *other == parameter || frequency.contains(other) && frequency.contains(&parameter);
        let mut args = *self;
        if let Some(given) = frequency.into_iter().chain([parameter]).filter(same).find(|p| args.slot(*p).is_some()) {
            return Err(Failure::bad(format!(
                "--{} cannot go together with --vary {}\nhint: leave it out, --over has its values",
                flag(given),
                flag(parameter)
            )));
        }
        if parameter == Parameter::Restitution && args.second_stop_follows() {
            return Err(Failure::bad(
                "the restitution varies and that of the second stop is not given\nhint: --second-restitution E2",
            ));
        }
        let restitution = [Parameter::Restitution, Parameter::SecondRestitution].contains(&parameter);
        if restitution || !args.is_machine() {
            *args.slot(parameter) = Some(first);
            return args.asked();
        }
        let asked = args.asked()?;
        Ok(Asked { system: asked.system.with(parameter, first / asked.units.of(parameter))?, ..asked })
    }
}
