//! VARY: the parameter that takes all values of a range, and the system without it.

use super::{Asked, SystemArgs};
use crate::exit::Failure;
use clap::ValueEnum;
use vibroimpact_study::Parameter;

/// A parameter by the name of its flag.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Vary {
    /// Frequency ratio omega/omega_n
    Beta,
    /// Its inverse omega_n/omega
    InverseBeta,
    /// Distance of the stop
    Gap,
    /// Restitution of the stop
    Restitution,
    /// Damping ratio zeta
    Damping,
    /// Distance of the second stop
    SecondGap,
    /// Restitution of the second stop
    SecondRestitution,
}

impl Vary {
    pub(crate) const fn parameter(self) -> Parameter {
        match self {
            Self::Beta => Parameter::Beta,
            Self::InverseBeta => Parameter::InverseBeta,
            Self::Gap => Parameter::Gap,
            Self::Restitution => Parameter::Restitution,
            Self::Damping => Parameter::Damping,
            Self::SecondGap => Parameter::SecondGap,
            Self::SecondRestitution => Parameter::SecondRestitution,
        }
    }
}

fn flag(parameter: Parameter) -> String {
    format!("--{}", parameter.name().replace('_', "-"))
}

impl SystemArgs {
    /// The system with `first` for the parameter that varies, which has no value of its own. A machine in physical units
    /// is given whole, because its units need all of it; its value is replaced.
    pub(crate) fn varied(&self, vary: Vary, first: f64) -> Result<Asked, Failure> {
        let parameter = vary.parameter();
        let frequency = [Parameter::Beta, Parameter::InverseBeta];
        let same =
            |other: &Parameter| *other == parameter || frequency.contains(other) && frequency.contains(&parameter);
        let mut args = *self;
        if let Some(given) = frequency.into_iter().chain([parameter]).filter(same).find(|p| args.slot(*p).is_some()) {
            return Err(Failure::bad(format!(
                "{} cannot go together with --vary {}\nhint: leave it out, --over has its values",
                flag(given),
                flag(parameter).trim_start_matches("--")
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
        let unit = if parameter.is_length() { asked.units.length() } else { 1.0 };
        Ok(Asked { system: parameter.set(&asked.system, first / unit)?, ..asked })
    }
}
