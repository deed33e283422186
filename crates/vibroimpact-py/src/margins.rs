//! The nearest events of a motion in each parameter, and the box of parameters in which it was found.

use crate::axis::parameter;
use crate::columns::named;
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::motion::Fields as Motion;
use crate::oscillator::Oscillator;
use crate::simulate::{StartArgument, start_plan, text};
use pyo3::prelude::*;
use vibroimpact_study::{
    EventRecord, MarginEnd, MarginsPlan, MotionBox, ParameterMargin, Plan, Results, ScaledParameter, Task,
};

/// The fields of `Margins`.
#[derive(IntoPyObject)]
pub(crate) struct Fields<'py> {
    motion: Motion<'py>,
    parameters: Vec<Parameter>,
    /// The parameter, the direction, and the change in units of its scale.
    nearest: Option<(&'static str, &'static str, f64)>,
    found: Option<Found>,
    plan: String,
}

#[derive(IntoPyObject)]
struct Parameter {
    parameter: &'static str,
    value: f64,
    scale: f64,
    down: End,
    up: End,
}

#[derive(IntoPyObject)]
struct End {
    limit: f64,
    at: Option<f64>,
    distance: Option<f64>,
    relative: Option<f64>,
    event: Option<Event>,
}

#[derive(IntoPyObject)]
struct Event {
    kind: &'static str,
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

#[derive(IntoPyObject)]
struct Found {
    size: f64,
    largest: f64,
    ranges: Vec<(&'static str, f64, f64)>,
    points: u64,
    lines: u64,
    /// Why the motion was not found next to the box, and the values of the parameters there.
    edge: Option<(&'static str, Vec<(&'static str, f64)>)>,
}

impl Event {
    fn new(record: EventRecord) -> Self {
        let EventRecord { kind, ends, label_before, label_after, change, impact, side, phase, turns, also } = record;
        let also = also.map(|(impact, side, phase)| (impact, named(side), phase));
        Self { kind, ends, label_before, label_after, change, impact, side: side.map(named), phase, turns, also }
    }
}

impl Parameter {
    fn new(margin: &ParameterMargin) -> Self {
        let scope = &margin.scope;
        let end = |end: &MarginEnd, limit: f64| {
            let at = end.point.as_ref().and_then(|point| Some((point, point.event?)));
            End {
                limit,
                at: at.map(|_| end.value),
                distance: at.map(|_| end.distance(scope)),
                relative: at.and_then(|_| end.relative(scope)),
                event: at.map(|(point, event)| Event::new(EventRecord::of(point, &event))),
            }
        };
        Self {
            parameter: scope.parameter.name(),
            value: scope.value,
            scale: scope.scale,
            down: end(&margin.down, scope.low),
            up: end(&margin.up, scope.high),
        }
    }
}

impl Found {
    fn new(found: &MotionBox, parameters: &[ParameterMargin]) -> Self {
        let scopes = || parameters.iter().map(|margin| &margin.scope);
        let names = || scopes().map(|scope| scope.parameter.name());
        Self {
            size: found.size,
            largest: found.largest,
            ranges: scopes()
                .map(|scope| (scope.parameter.name(), scope.at(-found.size), scope.at(found.size)))
                .collect(),
            points: found.points,
            lines: found.lines,
            edge: found.edge.as_ref().map(|edge| {
                let values = names().zip(edge.values.iter().copied()).collect();
                (edge.loss.name(), values)
            }),
        }
    }
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
    let watch = Watch::one("looking for margins", 1, progress);
    let found = door::result(py, watch, &plan, |of| if let Results::Margins(found) = of { Some(found) } else { None })?;
    Ok(Fields {
        motion: Motion::new(py, &found.motion, &osc.osc),
        parameters: found.parameters.iter().map(Parameter::new).collect(),
        nearest: found.nearest().map(|(margin, end)| {
            let distance = end.distance(&margin.scope);
            let way = if distance < 0.0 { "down" } else { "up" };
            (margin.scope.parameter.name(), way, distance.abs() / margin.scope.scale)
        }),
        found: found.motion_box.as_ref().map(|found_box| Found::new(found_box, &found.parameters)),
        plan: text(&plan)?,
    })
}

/// The names of the parameters of a system, the frequency in the form in which it was given.
#[pyfunction]
pub(crate) fn varied_parameters(osc: Oscillator) -> Vec<&'static str> {
    MarginsPlan::parameters(&osc.plan).into_iter().map(vibroimpact_study::Parameter::name).collect()
}
