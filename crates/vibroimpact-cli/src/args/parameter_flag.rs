//! A parameter as it is named on the command line.

use crate::failure::Failure;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command};
use std::ffi::OsStr;
use std::sync::LazyLock;
use vibroimpact_study::{BodyNumber, Parameter};

/// A parameter that varies, as it was named: a parameter of the oscillator or a number of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ParameterFlag {
    pub(crate) parameter: Parameter,
}

impl ParameterFlag {
    /// A number of a body.
    pub(crate) const fn of_body(number: BodyNumber) -> Self {
        Self { parameter: Parameter::Body(number) }
    }

    /// All of them, those of a body last.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        let body = BodyNumber::ALL.into_iter().map(Self::of_body);
        Parameter::ALL.into_iter().map(|parameter| Self { parameter }).chain(body)
    }

    /// The number of a body, if it is one.
    pub(crate) const fn number(self) -> Option<BodyNumber> {
        self.parameter.of_body()
    }

    /// Its name on the command line, without dashes before it.
    pub(crate) fn flag(self) -> &'static str {
        flag(self.parameter)
    }

    fn meaning(self) -> String {
        match self.parameter {
            Parameter::Body(parameter) => {
                let unit = parameter.unit();
                let name = parameter.description();
                if unit.is_empty() { format!("of a body: {name}") } else { format!("of a body: {name} in {unit}") }
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
pub(crate) fn flag(parameter: Parameter) -> &'static str {
    static FLAGS: LazyLock<Vec<(Parameter, String)>> = LazyLock::new(|| {
        ParameterFlag::all().map(|of| (of.parameter, of.parameter.name().replace('_', "-"))).collect()
    });
    FLAGS.iter().find(|(known, _)| *known == parameter).map_or("", |(_, flag)| flag)
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
        Parameter::Body(parameter) => parameter.description(),
    }
}
