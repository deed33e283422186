//! A curve of folds, flips or grazing impacts in a plane of two parameters.

use crate::axis::stretch;
use crate::branch::Cycles;
use crate::columns::{column, pairs};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::oscillator::Oscillator;
use crate::simulate::text;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use vibroimpact_study::{CurvePlan, FollowedEvent, Plan, Results, Task};

/// The fields of a `Curve`.
#[derive(IntoPyObject)]
pub(crate) struct Fields<'py> {
    values: Bound<'py, PyArray2<f64>>,
    physical: Bound<'py, PyArray1<bool>>,
    cycles: Cycles<'py>,
    /// Kind of each event, and its index among the points.
    events: Vec<(&'static str, usize)>,
    /// Number of the chosen orbit, and number of orbits.
    orbit: (u32, u32),
    found_at: Vec<f64>,
    /// Number (from 1) of the event through which the curve passes, and its index among the points.
    through: (usize, usize),
    plan: String,
}

fn kind(name: &str) -> Result<FollowedEvent, Trouble> {
    let all = [FollowedEvent::Fold, FollowedEvent::Flip, FollowedEvent::Grazing];
    all.into_iter()
        .find(|kind| kind.name() == name)
        .ok_or_else(|| Trouble::question(format!("`{name}` is no kind of curve; there are fold, flip, grazing")))
}

/// Follows an orbit to an event, and then the event in the plane.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // keywords
pub(crate) fn curve<'py>(
    py: Python<'py>,
    osc: Oscillator,
    label: String,
    kind: &str,
    vary: (String, f64, f64),
    and_: (String, f64, f64),
    orbit: Option<u32>,
    event: Option<u32>,
    progress: Option<Py<PyAny>>,
) -> Result<Fields<'py>, Trouble> {
    let kind = self::kind(kind)?;
    let task = CurvePlan { label, kind, vary: stretch(vary)?, and: stretch(and_)?, orbit, event };
    let plan = Plan::new(osc.plan, Task::Curve(task));
    let watch = Watch::one("following a curve", 1, progress);
    let found = door::result(py, watch, &plan, |of| if let Results::Curve(found) = of { Some(found) } else { None })?;
    let points = || found.points.iter();
    Ok(Fields {
        values: pairs(py, points().map(|point| point.values.into()))?,
        physical: column(py, points().map(|point| point.physical)),
        cycles: Cycles::new(py, &points().map(|point| &point.cycle))?,
        events: points().enumerate().filter_map(|(k, point)| Some((point.event?.name(), k))).collect(),
        orbit: (found.chosen.number, found.chosen.count),
        found_at: found.events.iter().map(|event| event.value).collect(),
        through: (found.through + 1, found.begin),
        plan: text(&plan)?,
    })
}
