//! The nearest events of a motion in each parameter, and the box of parameters in which it was found.

use crate::axis::parameter;
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::motion::Fields as Motion;
use crate::oscillator::Oscillator;
use crate::simulate::{StartArgument, start_plan};
use pyo3::prelude::*;
use vibroimpact_report::Units;
use vibroimpact_study::{MarginsPlan, Plan, Results, ScaledParameter, Task};

/// The fields of the motion, and the JSON object that the command prints.
#[derive(IntoPyObject)]
pub(crate) struct Fields<'py> {
    motion: Motion<'py>,
    json: String,
}

/// Finds the nearest events of a motion. `vary` has the names of the parameters, each with its scale if it has one;
/// empty for all parameters.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // keywords
pub(crate) fn margins(
    py: Python<'_>,
    osc: Oscillator,
    start: StartArgument,
    label: Option<String>,
    vary: Vec<(String, Option<f64>)>,
    within: f64,
    lines: u32,
    progress: Option<Py<PyAny>>,
) -> Result<Fields<'_>, Trouble> {
    let scaled = |(name, scale): (String, Option<f64>)| {
        Ok::<_, Trouble>(ScaledParameter { parameter: parameter(&name)?, scale })
    };
    let vary = vary.into_iter().map(scaled).collect::<Result<_, _>>()?;
    let task = MarginsPlan { start: start_plan(start), label, vary, within, lines };
    let plan = Plan::new(osc.plan, Task::Margins(task));
    plan.check()?;
    let watch = Watch::one("looking for margins", 1, progress);
    let (json, results) = door::run(py, watch, move |control| {
        let answer = vibroimpact_report::answer(&plan, Units::default(), control)?;
        Ok((answer.json(), answer.results))
    })?;
    let Results::Margins(found) = results else { return Err(Trouble::Defect("looking for margins")) };
    Ok(Fields { motion: Motion::new(py, &found.motion, &osc.osc), json })
}

/// The names of the parameters of a system, the frequency in the form in which it was given.
#[pyfunction]
pub(crate) fn varied_parameters(osc: Oscillator) -> Vec<&'static str> {
    MarginsPlan::parameters(&osc.plan).into_iter().map(vibroimpact_study::Parameter::name).collect()
}
