//! Conversion of the names of parameters and their ranges.

use crate::error::Trouble;
use vibroimpact::PhysicalParameter;
use vibroimpact_study::{Parameter, Stretch};

/// The parameter with this name.
pub(crate) fn parameter(name: &str) -> Result<Parameter, Trouble> {
    Parameter::from_name(name).ok_or_else(|| {
        let machine = PhysicalParameter::ALL.map(PhysicalParameter::name).join(", ");
        let known = Parameter::ALL.map(Parameter::name).join(", ");
        Trouble::question(format!("`{name}` is no parameter; there are {known}, and of a machine {machine}"))
    })
}

/// A parameter and its range.
pub(crate) fn stretch((name, from, to): (String, f64, f64)) -> Result<Stretch, Trouble> {
    Ok(Stretch { parameter: parameter(&name)?, from, to })
}
