//! Motions from points of parameters and starts, given as columns.

use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::grid::{Variable, arrays};
use crate::oscillator::OscillatorFile;
use crate::plan::parsed;
use crate::simulate::{StartArgument, start_plan};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use vibroimpact_study::study::in_memory;
use vibroimpact_study::{
    BasinPlan, Coordinate, DrawnPoints, ListedColumn, Plan, PointsPlan, Quantity, Study, unknown_quantity,
};

/// The column with this name.
fn column(name: &str, values: Vec<f64>) -> Result<ListedColumn, Trouble> {
    let vary = Coordinate::named(name).ok_or_else(|| {
        let parameters = vibroimpact_study::parameter_names().join(", ");
        Trouble::question(format!(
            "`{name}` is no parameter and no coordinate of a start; there are {parameters}, x, v and phase"
        ))
    })?;
    Ok(ListedColumn { vary, values })
}

/// The columns that vary, and the numbers of all other parameters and coordinates of starts.
pub(crate) type Over<'py> = Vec<(String, PyReadonlyArray1<'py, f64>)>;

/// The points of columns.
pub(crate) fn listed(over: &Over<'_>) -> Result<PointsPlan, Trouble> {
    let columns = over.iter().map(|(name, values)| column(name, values.as_array().to_vec()));
    Ok(PointsPlan::Listed(columns.collect::<Result<_, _>>()?))
}

/// Settles the motion at each point. `over` are the columns that vary; other numbers are those of `osc` and `start`.
#[pyfunction]
#[allow(clippy::too_many_arguments, clippy::needless_pass_by_value)] // called from Python
pub(crate) fn settle_points<'py>(
    py: Python<'py>,
    osc: OscillatorFile,
    over: Over<'py>,
    start: StartArgument,
    options: (Option<u32>, Vec<String>, bool),
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<Vec<Variable<'py>>, Trouble> {
    let (impacts, fields, transient) = options;
    let points = listed(&over)?;
    let quantity = |name: &String| Quantity::from_name(name).ok_or_else(|| Trouble::question(unknown_quantity(name)));
    let fields = fields.iter().map(quantity).collect::<Result<_, _>>()?;
    let total = points.count();
    let task = BasinPlan { impacts, fields, transient, ..BasinPlan::of_points(points, start_plan(start)) };
    let plan = Plan::new(osc.plan, task);
    let watch = Watch { what: "settling motions", total, progress, threads };
    let sheet = door::run(py, watch, move |control| Ok(in_memory(Study::new(&plan)?, control)?))?;
    Ok(arrays(py, sheet)?)
}

/// The columns of points that are drawn from a box, which are written as in a plan.
#[pyfunction]
pub(crate) fn drawn_points<'py>(py: Python<'py>, drawn: &str) -> Result<Vec<Bound<'py, PyArray1<f64>>>, Trouble> {
    let drawn: DrawnPoints<String> = parsed(drawn)?;
    drawn.check()?;
    let points = PointsPlan::Drawn(drawn);
    let count = usize::try_from(points.count()).unwrap_or(usize::MAX);
    Ok((0..points.width())
        .map(|column| (0..count).map(|k| points.at(column, k)).collect::<Vec<_>>().into_pyarray(py))
        .collect())
}
