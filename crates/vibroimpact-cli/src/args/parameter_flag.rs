//! A parameter as it is named on the command line.

use crate::failure::Failure;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command};
use std::ffi::OsStr;
use vibroimpact::PhysicalParameter;
use vibroimpact_study::Parameter;

/// A parameter that varies, as it was named: a parameter of the oscillator or a number of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ParameterFlag {
    pub(crate) parameter: Parameter,
}

impl ParameterFlag {
    /// A number of a machine.
    pub(crate) const fn of_machine(parameter: PhysicalParameter) -> Self {
        Self { parameter: Parameter::Physical(parameter) }
    }

    /// All of them, those of a machine last.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        let machine = PhysicalParameter::ALL.into_iter().map(Self::of_machine);
        Parameter::ALL.into_iter().map(|parameter| Self { parameter }).chain(machine)
    }

    /// The number of a machine, if it is one.
    pub(crate) const fn machine(self) -> Option<PhysicalParameter> {
        if let Parameter::Physical(parameter) = self.parameter { Some(parameter) } else { None }
    }

    /// Its name on the command line, without dashes before it.
    pub(crate) const fn flag(self) -> &'static str {
        flag(self.parameter)
    }

    fn meaning(self) -> String {
        match self.parameter {
            Parameter::Physical(parameter) => {
                let unit = parameter.unit();
                let name = parameter.description();
                if unit.is_empty() {
                    format!("of a machine: {name}")
                } else {
                    format!("of a machine: {name} in {unit}")
                }
            }
            parameter => meaning(parameter).to_owned(),
        }
    }
}

/// Parses a parameter from the name of its flag.
pub(super) fn parameter() -> impl TypedValueParser<Value = ParameterFlag> {
    let values: Vec<PossibleValue> =
        ParameterFlag::all().map(|named| PossibleValue::new(named.flag()).help(named.meaning())).collect();
    PossibleValuesParser::new(values).try_map(|name| {
        ParameterFlag::all().find(|named| named.flag() == name).ok_or_else(|| format!("`{name}` is no parameter"))
    })
}

/// What a branch varies: a parameter, or the path of a number of a machine.
#[derive(Clone, Debug)]
pub(crate) enum Varied {
    Parameter(ParameterFlag),
    Path(String),
    /// A parameter of a machine file, or else this message.
    Name(String, String),
}

impl Varied {
    /// The parameter of the oscillator.
    pub(crate) fn parameter(&self) -> Result<ParameterFlag, Failure> {
        match self {
            Self::Parameter(parameter) => Ok(*parameter),
            Self::Path(path) => Err(Failure::bad(format!(
                "`{path}` is the path of a number of a machine, and no machine is given\nhint: --machine NAME|FILE"
            ))),
            Self::Name(_, said) => Err(Failure::bad(said.clone())),
        }
    }

    /// The path in a machine.
    pub(crate) fn path(&self) -> String {
        match self {
            Self::Parameter(parameter) => parameter.flag().to_owned(),
            Self::Path(path) | Self::Name(path, _) => path.clone(),
        }
    }
}

/// Parses what a branch varies. A name with a dot, and `frequency`, are paths in a machine.
pub(crate) fn varied() -> impl TypedValueParser<Value = Varied> {
    VariedParser
}

#[derive(Clone)]
struct VariedParser;

impl TypedValueParser for VariedParser {
    type Value = Varied;

    fn parse_ref(&self, cmd: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<Varied, clap::Error> {
        match value.to_str() {
            Some(path) if path.contains('.') || path == "frequency" => Ok(Varied::Path(path.to_owned())),
            name => match (parameter().parse_ref(cmd, arg, value), name) {
                (Ok(parameter), _) => Ok(Varied::Parameter(parameter)),
                // whether a machine has this parameter is not known here
                (Err(error), Some(name)) => {
                    let said = error.render().to_string();
                    let said = said.trim_start_matches("error: ").trim_end();
                    Ok(Varied::Name(name.to_owned(), said.to_owned()))
                }
                (Err(error), None) => Err(error),
            },
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let values: Vec<PossibleValue> =
            ParameterFlag::all().map(|named| PossibleValue::new(named.flag()).help(named.meaning())).collect();
        Some(Box::new(values.into_iter()))
    }
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
        Parameter::Physical(parameter) => machine_flag(parameter),
    }
}

const fn machine_flag(parameter: PhysicalParameter) -> &'static str {
    match parameter {
        PhysicalParameter::Mass => "mass-kg",
        PhysicalParameter::Stiffness => "stiffness-n-per-m",
        PhysicalParameter::DampingCoefficient => "damping-ns-per-m",
        PhysicalParameter::DampingRatio => "damping-ratio",
        PhysicalParameter::Force => "force-n",
        PhysicalParameter::Frequency => "frequency-hz",
        PhysicalParameter::Gap => "gap-m",
        PhysicalParameter::SecondGap => "second-gap-m",
        PhysicalParameter::Gaps => "gaps-m",
        PhysicalParameter::Restitutions => "restitutions",
        PhysicalParameter::BaseDisplacement => "base-displacement-m",
        PhysicalParameter::BaseVelocity => "base-velocity-m-per-s",
        PhysicalParameter::BaseAcceleration => "base-acceleration-m-per-s2",
        PhysicalParameter::StopDisplacement => "stop-displacement-m",
        PhysicalParameter::Unbalance => "unbalance-kg-m",
        PhysicalParameter::ConstantForce => "constant-force-n",
        PhysicalParameter::Gravity => "gravity-m-per-s2",
        other => other.name(),
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
        Parameter::Physical(parameter) => parameter.description(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_of_a_machine_are_its_names_with_hyphens() {
        for parameter in PhysicalParameter::ALL {
            assert_eq!(machine_flag(parameter), parameter.name().replace('_', "-"));
        }
    }
}
