//! Conversion of the names of parameters.

use crate::error::Trouble;
use vibroimpact_study::{BodyNumber, Parameter};

/// The parameter with this name.
pub(crate) fn parameter(name: &str) -> Result<Parameter, Trouble> {
    Parameter::from_name(name).ok_or_else(|| {
        let body = BodyNumber::ALL.map(BodyNumber::name).join(", ");
        let known = Parameter::ALL.map(Parameter::name).join(", ");
        Trouble::question(format!("`{name}` is no parameter; there are {known}, and of a body {body}"))
    })
}
