//! What names a parameter or a range of it: `"A:B:N"` or three numbers, `"gap"`.

use crate::error::Trouble;
use pyo3::prelude::*;
use vibroimpact_study::{Parameter, PlanError, Span, Stretch};

/// Evenly spaced values: `"A:B:N"`, or first, last and number.
#[derive(FromPyObject)]
pub(crate) enum SpanArgument {
    Text(String),
    Numbers(f64, f64, u32),
}

impl SpanArgument {
    pub(crate) fn span(self) -> Result<Span, PlanError> {
        match self {
            Self::Text(text) => text.parse(),
            Self::Numbers(first, last, count) => Span::new(first, last, count),
        }
    }
}

/// A parameter by its name.
pub(crate) fn parameter(name: &str) -> Result<Parameter, Trouble> {
    Parameter::ALL.into_iter().find(|parameter| parameter.name() == name).ok_or_else(|| {
        let known = Parameter::ALL.map(Parameter::name).join(", ");
        Trouble::question(format!("`{name}` is no parameter; there are {known}"))
    })
}

/// A parameter and its range.
pub(crate) fn stretch((name, from, to): (String, f64, f64)) -> Result<Stretch, Trouble> {
    Ok(Stretch { parameter: parameter(&name)?, from, to })
}

/// The values of a span, the very numbers that are computed with.
#[pyfunction]
pub(crate) fn span_values(py: Python<'_>, over: SpanArgument) -> Result<Bound<'_, numpy::PyArray1<f64>>, Trouble> {
    let span = over.span()?;
    Ok(crate::columns::column(py, span.values()))
}
