//! A branch of periodic orbits in one parameter or along a line through two, and the branches that begin on it.

use crate::axis::parameter;
use crate::columns::{Impacts, column, complex, named, pairs};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::motion::{Rest, rests};
use crate::oscillator::Oscillator;
use crate::simulate::text;
use numpy::{Complex64, PyArray1, PyArray2};
use pyo3::prelude::*;
use vibroimpact::continuation::{BranchEvent, SolutionPoint};
use vibroimpact::orbit::Cycle;
use vibroimpact_study::{BranchPlan, Cut, EventRecord, Followed, Plan, Results, Target, Task};

/// Several cycles in one set of columns, with the index at which each begins.
#[derive(IntoPyObject)]
pub(crate) struct Cycles<'py> {
    /// The index of the first impact of each cycle, and the total number of impacts at the end.
    offsets: Bound<'py, PyArray1<i64>>,
    impacts: Impacts<'py>,
    multipliers: Bound<'py, PyArray2<Complex64>>,
    /// The phases of sticking of each cycle; `None` if no cycle has any.
    rests: Option<Vec<Vec<Rest>>>,
}

impl<'py> Cycles<'py> {
    pub(crate) fn new<'a>(py: Python<'py>, cycles: &(impl Iterator<Item = &'a Cycle> + Clone)) -> PyResult<Self> {
        let mut end = 0;
        let ends = cycles.clone().map(|cycle| {
            end += i64::try_from(cycle.points.len()).unwrap_or(0);
            end
        });
        Ok(Self {
            offsets: column(py, core::iter::once(0).chain(ends)),
            multipliers: pairs(py, cycles.clone().map(|cycle| complex(cycle.multipliers)))?,
            rests: cycles.clone().any(|cycle| !cycle.rests.is_empty()).then(|| cycles.clone().map(rests).collect()),
            impacts: Impacts::new(py, cycles),
        })
    }
}

/// The fields of a `Branch`.
#[derive(IntoPyObject)]
pub(crate) struct Fields<'py> {
    parameter: Bound<'py, PyArray1<f64>>,
    /// Values of the second parameter of a line.
    second: Option<Bound<'py, PyArray1<f64>>>,
    label: Vec<String>,
    stable: Bound<'py, PyArray1<bool>>,
    stability: Vec<&'static str>,
    physical: Bound<'py, PyArray1<bool>>,
    cycles: Cycles<'py>,
    events: Vec<Event>,
    /// The kind and the value of the event at which it begins, and the number (from 1) of the branch of that event.
    origin: Option<(&'static str, f64, usize)>,
}

#[derive(IntoPyObject)]
struct Event {
    kind: &'static str,
    parameter: f64,
    /// Values of both parameters of a line.
    values: Option<(f64, f64)>,
    point: usize,
    ends: bool,
    label_before: String,
    label_after: Option<String>,
    change: Option<&'static str>,
    impact: Option<usize>,
    side: Option<&'static str>,
    phase: Option<f64>,
    turns: Option<bool>,
    /// Impact, side and phase of a second contact simultaneous with that of the event.
    also: Option<(Option<usize>, &'static str, f64)>,
}

impl Event {
    fn new(place: usize, point: &SolutionPoint, event: &BranchEvent, cut: &Cut) -> Self {
        let EventRecord { kind, ends, label_before, label_after, change, impact, side, phase, turns, also } =
            EventRecord::of(point, event);
        Self {
            kind,
            parameter: point.value,
            values: second(cut, point).map(|second| (point.value, second)),
            point: place,
            ends,
            label_after,
            label_before,
            change,
            impact,
            side: side.map(named),
            phase,
            turns,
            also: also.map(|(impact, side, phase)| (impact, named(side), phase)),
        }
    }
}

impl<'py> Fields<'py> {
    fn new(py: Python<'py>, branch: &Followed, cut: &Cut) -> PyResult<Self> {
        let points = || branch.points.iter();
        Ok(Self {
            parameter: column(py, points().map(|point| point.value)),
            second: cut.also.map(|_| column(py, points().filter_map(|point| second(cut, point)))),
            label: points().map(|point| point.cycle.label.to_string()).collect(),
            stable: column(py, points().map(SolutionPoint::stable)),
            stability: points().map(|point| point.stability().name()).collect(),
            physical: column(py, points().map(|point| point.physical)),
            cycles: Cycles::new(py, &points().map(|point| &point.cycle))?,
            events: points()
                .enumerate()
                .filter_map(|(k, point)| Some(Event::new(k, point, point.event.as_ref()?, cut)))
                .collect(),
            origin: branch.origin.as_ref().map(|origin| {
                let kind = origin.point.event.map_or("", |event| event.name());
                (kind, origin.point.value, origin.branch + 1)
            }),
        })
    }
}

/// The value of the second parameter of a line at a point.
fn second(cut: &Cut, point: &SolutionPoint) -> Option<f64> {
    cut.values(point.value).nth(1).map(|(_, value)| value)
}

/// The fields of all branches.
#[derive(IntoPyObject)]
pub(crate) struct Found<'py> {
    branches: Vec<Fields<'py>>,
    /// Number of the chosen orbit, and number of orbits.
    orbit: (u32, u32),
    from: f64,
    /// The second parameter of a line, and its values at the two ends.
    also: Option<(&'static str, f64, f64)>,
    label: String,
    plan: String,
}

/// Follows an orbit and the branches that begin on its branch.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // keywords
pub(crate) fn branch<'py>(
    py: Python<'py>,
    osc: Oscillator,
    label: String,
    vary: &str,
    to: f64,
    also: Option<(String, f64)>,
    orbit: Option<u32>,
    follow: u32,
    points: u32,
    progress: Option<Py<PyAny>>,
) -> Result<Found<'py>, Trouble> {
    let also = also.map(|(name, to)| Ok::<_, Trouble>(Target { parameter: parameter(&name)?, to })).transpose()?;
    let task = BranchPlan { label, vary: parameter(vary)?, to, also, orbit, follow, points };
    let plan = Plan::new(osc.plan, Task::Branch(task.clone()));
    let watch = Watch::one("following a branch", 1, progress);
    let found = door::result(py, watch, &plan, |of| if let Results::Branch(found) = of { Some(found) } else { None })?;
    let cut = task.cut(&osc.plan)?;
    Ok(Found {
        branches: found.followed.iter().map(|branch| Fields::new(py, branch, &cut)).collect::<PyResult<_>>()?,
        orbit: (found.chosen.number, found.chosen.count),
        from: cut.ends.0,
        also: cut.also.map(|also| (also.parameter.name(), also.from, also.to)),
        label: found.chosen.orbit.cycle.label.to_string(),
        plan: text(&plan)?,
    })
}
