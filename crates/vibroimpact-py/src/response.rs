//! A quantity of all motions over a parameter.

use crate::axis::parameter;
use crate::columns::{column, grid};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::oscillator::Oscillator;
use crate::simulate::text;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use vibroimpact::Scales;
use vibroimpact_study::{
    Parameter, Plan, Quantity, ResponsePlan, ResponseRow, Results, Task, Values, unknown_quantity,
};

/// The fields of a `ResponseCurve`.
#[derive(IntoPyObject)]
pub(crate) struct Fields<'py> {
    parameter: Bound<'py, PyArray1<f64>>,
    label: Vec<String>,
    stable: Bound<'py, PyArray1<bool>>,
    stability: Vec<&'static str>,
    physical: Bound<'py, PyArray1<bool>>,
    /// One row for each point, one column for each quantity.
    values: Bound<'py, PyArray2<f64>>,
}

/// The names of the quantities and their units; the sweeps up and down; the branches.
#[derive(IntoPyObject)]
pub(crate) struct Found<'py> {
    names: Vec<&'static str>,
    /// Their units.
    units: Vec<&'static str>,
    up: Fields<'py>,
    down: Fields<'py>,
    branches: Vec<Fields<'py>>,
    plan: String,
}

/// The quantities of a motion, in SI units where there are scales.
fn row(of: &ResponseRow, scales: Option<Scales>) -> Vec<f64> {
    let unit = |quantity: Quantity| scales.map_or(1.0, |scales| quantity.kind().in_si(&scales));
    of.quantities.iter().zip(Quantity::ALL).map(|(value, quantity)| value * unit(quantity)).collect()
}

impl<'py> Fields<'py> {
    fn new(py: Python<'py>, rows: &[ResponseRow], scales: impl Fn(f64) -> Option<Scales>) -> PyResult<Self> {
        let all = || rows.iter();
        Ok(Self {
            parameter: column(py, all().map(|row| row.value)),
            label: all().map(|row| row.label.clone()).collect(),
            stable: column(py, all().map(ResponseRow::stable)),
            stability: all().map(|row| row.stability.map_or("", |stability| stability.name())).collect(),
            physical: column(py, all().map(|row| row.admissible)),
            values: grid(py, all().map(|of| row(of, scales(of.value))), Quantity::ALL.len())?,
        })
    }
}

/// The values of a parameter: a range as text, or a list.
#[derive(FromPyObject)]
pub(crate) enum Over {
    Range(String),
    List(Vec<f64>),
}

/// Computes both sweeps and the branches.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // arguments from Python
pub(crate) fn response<'py>(
    py: Python<'py>,
    osc: Oscillator,
    vary: &str,
    over: Over,
    quantity: &str,
    impacts: Option<u32>,
    progress: Option<Py<PyAny>>,
) -> Result<Found<'py>, Trouble> {
    let quantity = Quantity::from_name(quantity).ok_or_else(|| Trouble::question(unknown_quantity(quantity)))?;
    let over = match over {
        Over::Range(text) => Values::Span(text.parse()?),
        Over::List(list) => Values::Listed(list),
    };
    let vary = parameter(vary)?;
    let task = ResponsePlan { quantity, impacts, ..ResponsePlan::new(vary, over) };
    let plan = Plan::new(osc.plan, Task::Response(task));
    let total = plan.work().map_or(1, |(motions, _)| motions);
    let watch = Watch::one("computing a response", total, progress);
    let found =
        door::result(py, watch, &plan, |of| if let Results::Response(found) = of { Some(found) } else { None })?;
    // over a number of a machine the nondimensional units may change from value to value
    let scales = |value: f64| match vary {
        Parameter::Physical(_) => osc.plan.with(vary, value).ok().and_then(|system| system.scales()),
        _ => None,
    };
    Ok(Found {
        names: Quantity::ALL.map(Quantity::name).to_vec(),
        units: Quantity::ALL
            .map(|quantity| match vary {
                Parameter::Physical(_) => quantity.kind().unit(),
                _ => quantity.kind().nondimensional(),
            })
            .to_vec(),
        up: Fields::new(py, &found.up, scales)?,
        down: Fields::new(py, &found.down, scales)?,
        branches: found.branches.iter().map(|branch| Fields::new(py, branch, scales)).collect::<PyResult<_>>()?,
        plan: text(&plan)?,
    })
}
