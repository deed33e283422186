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
use vibroimpact::verdict::Stability;
use vibroimpact_study::{
    Parameter, Plan, Quantities, Quantity, ResponseBranch, ResponsePlan, Results, SweptMotion, Task, Values,
    unknown_quantity,
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
fn row(of: Option<Quantities>, scales: Option<Scales>) -> Vec<f64> {
    let unit = |quantity: Quantity| scales.map_or(1.0, |scales| quantity.kind().in_si(&scales));
    Quantity::ALL.into_iter().map(|quantity| of.map_or(f64::NAN, |of| of.get(quantity) * unit(quantity))).collect()
}

impl<'py> Fields<'py> {
    /// A sweep; each of its motions is stable and admissible.
    fn swept(py: Python<'py>, motions: &[SweptMotion], scales: impl Fn(f64) -> Option<Scales>) -> PyResult<Self> {
        Ok(Self {
            parameter: column(py, motions.iter().map(|motion| motion.value)),
            label: motions.iter().map(|motion| motion.label.clone()).collect(),
            stable: column(py, motions.iter().map(|_| true)),
            stability: motions.iter().map(|_| Stability::Stable.name()).collect(),
            physical: column(py, motions.iter().map(|_| true)),
            values: grid(
                py,
                motions.iter().map(|motion| row(motion.quantities, scales(motion.value))),
                Quantity::ALL.len(),
            )?,
        })
    }

    fn branch(py: Python<'py>, branch: &ResponseBranch, scales: impl Fn(f64) -> Option<Scales>) -> PyResult<Self> {
        let points = || branch.points.iter();
        Ok(Self {
            parameter: column(py, points().map(|point| point.solution.value)),
            label: points().map(|point| point.solution.cycle.label.to_string()).collect(),
            stable: column(py, points().map(|point| point.solution.stable())),
            stability: points().map(|point| point.solution.stability().name()).collect(),
            physical: column(py, points().map(|point| point.solution.physical)),
            values: grid(
                py,
                points().map(|point| row(point.quantities, scales(point.solution.value))),
                Quantity::ALL.len(),
            )?,
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
    let task = ResponsePlan { quantity, impacts, ..ResponsePlan::new(parameter(vary)?, over) };
    let plan = Plan::new(osc.plan, Task::Response(task));
    let total = plan.work().map_or(1, |(motions, _)| motions);
    let watch = Watch::one("computing a response", total, progress);
    let found =
        door::result(py, watch, &plan, |of| if let Results::Response(found) = of { Some(found) } else { None })?;
    // over a number of a machine the nondimensional units may change from value to value
    let vary = found.plan.vary;
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
        up: Fields::swept(py, &found.up, scales)?,
        down: Fields::swept(py, &found.down, scales)?,
        branches: found.branches.iter().map(|branch| Fields::branch(py, branch, scales)).collect::<PyResult<_>>()?,
        plan: text(&plan)?,
    })
}
