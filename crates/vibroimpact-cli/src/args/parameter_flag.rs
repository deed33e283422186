//! A parameter as it is named on the command line.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use vibroimpact_study::Parameter;

/// A parameter that varies, named in nondimensional units or in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ParameterFlag {
    pub(crate) parameter: Parameter,
    /// Whether its values are in Hz or m, because it was given by such a name.
    pub(crate) si: bool,
}

impl ParameterFlag {
    /// All of them, those in SI units last.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        let plain = Parameter::ALL.map(|parameter| Self { parameter, si: false });
        let si = [Parameter::Beta, Parameter::Gap, Parameter::SecondGap];
        plain.into_iter().chain(si.map(|parameter| Self { parameter, si: true }))
    }

    /// Its name on the command line, without dashes before it.
    pub(crate) const fn flag(self) -> &'static str {
        match self.parameter {
            Parameter::Beta if self.si => "frequency-hz",
            Parameter::Gap if self.si => "gap-m",
            Parameter::SecondGap if self.si => "second-gap-m",
            parameter => flag(parameter),
        }
    }

    const fn meaning(self) -> &'static str {
        match self.parameter {
            Parameter::Beta if self.si => "Frequency of the force in Hz, of a system in physical units",
            Parameter::Gap if self.si => "Distance of the stop in m",
            Parameter::SecondGap if self.si => "Distance of the second stop in m",
            parameter => meaning(parameter),
        }
    }
}

/// Parses a parameter from the name of its flag.
pub(crate) fn parameter() -> impl TypedValueParser<Value = ParameterFlag> {
    let values: Vec<PossibleValue> =
        ParameterFlag::all().map(|named| PossibleValue::new(named.flag()).help(named.meaning())).collect();
    PossibleValuesParser::new(values).try_map(|name| {
        ParameterFlag::all().find(|named| named.flag() == name).ok_or_else(|| format!("`{name}` is no parameter"))
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
