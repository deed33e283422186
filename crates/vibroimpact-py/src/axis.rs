//! Conversion of the names of parameters.

use crate::error::Trouble;
use vibroimpact::PhysicalParameter;
use vibroimpact_study::Parameter;

/// The parameter with this name.
pub(crate) fn parameter(name: &str) -> Result<Parameter, Trouble> {
    Parameter::from_name(name).ok_or_else(|| {
        let machine = PhysicalParameter::ALL.map(PhysicalParameter::name).join(", ");
        let known = Parameter::ALL.map(Parameter::name).join(", ");
        Trouble::question(format!("`{name}` is no parameter; there are {known}, and of a machine {machine}"))
    })
}
