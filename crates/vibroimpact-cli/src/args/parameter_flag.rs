//! A parameter as it is named on the command line.

use crate::failure::Failure;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command};
use std::ffi::OsStr;
use std::sync::LazyLock;
use vibroimpact_study::{BodyNumber, Parameter};

/// All parameters of an oscillator, those of a body last.
fn parameters() -> impl Iterator<Item = Parameter> {
    Parameter::ALL.into_iter().chain(BodyNumber::ALL.into_iter().map(Parameter::Body))
}

/// The names of their flags, without dashes before them.
pub(crate) fn flags() -> impl Iterator<Item = &'static str> {
    parameters().map(flag)
}

/// The parameter with a flag of this name.
pub(super) fn of_flag(name: &str) -> Option<Parameter> {
    parameters().find(|parameter| flag(*parameter) == name)
}

fn possible() -> Vec<PossibleValue> {
    parameters().map(|parameter| PossibleValue::new(flag(parameter)).help(meaning(parameter))).collect()
}

/// Parses a parameter from the name of its flag.
pub(super) fn parameter() -> impl TypedValueParser<Value = Parameter> {
    PossibleValuesParser::new(possible())
        .try_map(|name| of_flag(&name).ok_or_else(|| format!("`{name}` is no parameter")))
}

/// What a branch varies: a parameter, or the path of a number of a machine.
#[derive(Clone, Debug)]
pub(crate) enum Varied {
    Parameter(Parameter),
    Path(String),
    /// A parameter of a machine file, or else this message.
    Name(String, String),
}

impl Varied {
    /// The parameter of the oscillator.
    pub(crate) fn parameter(&self) -> Result<Parameter, Failure> {
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
            Self::Parameter(parameter) => flag(*parameter).to_owned(),
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
        Some(Box::new(possible().into_iter()))
    }
}

/// The name of the flag of a parameter, without the dashes.
pub(crate) fn flag(parameter: Parameter) -> &'static str {
    static FLAGS: LazyLock<Vec<(Parameter, String)>> =
        LazyLock::new(|| parameters().map(|of| (of, of.name().replace('_', "-"))).collect());
    FLAGS.iter().find(|(known, _)| *known == parameter).map_or("", |(_, flag)| flag)
}

fn meaning(parameter: Parameter) -> String {
    let words = match parameter {
        Parameter::Beta => "Frequency ratio omega/omega_n",
        Parameter::InverseBeta => "Its inverse omega_n/omega",
        Parameter::Gap => "Distance of the stop",
        Parameter::Restitution => "Restitution of the stop",
        Parameter::Damping => "Damping ratio zeta",
        Parameter::SecondGap => "Distance of the second stop",
        Parameter::SecondRestitution => "Restitution of the second stop",
        Parameter::Body(number) => {
            let (name, unit) = (number.description(), number.unit());
            return if unit.is_empty() { format!("of a body: {name}") } else { format!("of a body: {name} in {unit}") };
        }
    };
    words.to_owned()
}
