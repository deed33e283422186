//! The answer to a question about any system: the JSON object of the command, its figure, and columns that the object does not
//! have.

use crate::columns::{column, grid};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::events::{EventFields, Events};
use crate::machine::{MachineFile, Start, start};
use crate::oscillator::{OscillatorFile, ScalesOf, scales};
use crate::plan::{PlanFields, fields, read, text};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use std::sync::Arc;
use vibroimpact_report::json::event::{self, EventObject, Stops};
use vibroimpact_report::json::motion::horizon;
use vibroimpact_report::{AnswerError, Asked, ContactQuestion, Shown, Units, figure};
use vibroimpact_study::{
    Dynamics, MarginsPlan, Name, Parameter, Plan, PlanError, Quantity, ResponseCurves, ResponseRow, Results,
    SectionPoints, Simulated, SystemPlan, Task,
};

/// A system about which a question is asked.
#[derive(FromPyObject)]
#[allow(clippy::large_enum_variant, reason = "there is one of them in a call")]
pub(crate) enum System<'py> {
    Oscillator(OscillatorFile),
    Machine(PyRef<'py, MachineFile>),
}

/// Columns that the JSON object of an answer does not have.
#[derive(IntoPyObject)]
pub(crate) enum Columns<'py> {
    Simulation(SimulationFields<'py>),
    Section(SectionFields<'py>),
    Response(ResponseFields<'py>),
}

/// The events of a motion, and the reason why the list ends.
#[derive(IntoPyObject)]
pub(crate) struct SimulationFields<'py> {
    events: EventFields<'py>,
    with_: Vec<Vec<String>>,
    tie: Bound<'py, PyArray1<bool>>,
    depth: Bound<'py, PyArray1<f64>>,
    chatter: Bound<'py, PyArray1<bool>>,
    error: Bound<'py, PyArray1<f64>>,
    end: &'static str,
    end_time: f64,
    /// The JSON object that says why there are no more impacts.
    horizon: Option<String>,
    shown_until: f64,
}

impl<'py> SimulationFields<'py> {
    fn new<'a, E: 'a>(
        py: Python<'py>,
        found: &'a Simulated<E>,
        n: usize,
        object: impl Fn(&'a E) -> EventObject<'a>,
    ) -> Self {
        let (mut events, mut with_, mut tie) = (Events::new(n, Vec::new()), Vec::new(), Vec::new());
        let (mut depth, mut chatter, mut error) = (Vec::new(), Vec::new(), Vec::new());
        for event in found.events.iter().map(object) {
            events.push(&event);
            with_.push(event.with.iter().map(|name| (*name).to_owned()).collect());
            tie.push(event.tie);
            depth.push(event.depth.unwrap_or(f64::NAN));
            chatter.push(event.chatter.unwrap_or(false));
            error.push(event.error.unwrap_or(f64::NAN));
        }
        Self {
            events: events.fields(py),
            with_,
            tie: column(py, tie.into_iter()),
            depth: column(py, depth.into_iter()),
            chatter: column(py, chatter.into_iter()),
            error: column(py, error.into_iter()),
            end: found.reason,
            end_time: found.time,
            horizon: found.horizon.as_ref().map(horizon),
            shown_until: found.shown_until,
        }
    }
}

/// The points of both sections of an attractor: at the closings of stops, and at phase 0.
#[derive(IntoPyObject)]
pub(crate) struct SectionFields<'py> {
    stop: Vec<String>,
    phase: Bound<'py, PyArray1<f64>>,
    speed: Bound<'py, PyArray1<f64>>,
    q: Bound<'py, PyArray2<f64>>,
    qdot: Bound<'py, PyArray2<f64>>,
    strobe_q: Bound<'py, PyArray2<f64>>,
    strobe_qdot: Bound<'py, PyArray2<f64>>,
}

impl<'py> SectionFields<'py> {
    /// Of a system with so many coordinates.
    fn new(py: Python<'py>, found: &SectionPoints, system: &impl Stops, width: usize) -> PyResult<Self> {
        let (closings, strobes) = (|| found.closings.iter(), || found.strobes.iter());
        Ok(Self {
            stop: closings().map(|at| system.name_of_stop(at.stop).to_owned()).collect(),
            phase: column(py, closings().map(|at| at.state.phase)),
            speed: column(py, closings().map(|at| at.speed)),
            q: grid(py, closings().map(|at| at.state.q.clone()), width)?,
            qdot: grid(py, closings().map(|at| at.state.qdot.clone()), width)?,
            strobe_q: grid(py, strobes().map(|at| at.q.clone()), width)?,
            strobe_qdot: grid(py, strobes().map(|at| at.qdot.clone()), width)?,
        })
    }
}

/// All quantities of the motions of a response: their names and units, and one row for each motion of both sweeps and of each
/// branch.
#[derive(IntoPyObject)]
pub(crate) struct ResponseFields<'py> {
    names: Vec<String>,
    units: Vec<&'static str>,
    curves: Vec<Bound<'py, PyArray2<f64>>>,
}

impl<'py> ResponseFields<'py> {
    /// Those of which `value` returns number `k` of a motion.
    fn new(
        py: Python<'py>,
        found: &ResponseCurves,
        units: Vec<&'static str>,
        value: impl Fn(&ResponseRow, usize) -> f64,
    ) -> PyResult<Self> {
        let width = found.quantities.len();
        let row = |row: &ResponseRow| (0..width).map(|k| value(row, k)).collect();
        let curves = [&found.up, &found.down].into_iter().chain(&found.branches);
        let curves = curves.map(|rows| grid(py, rows.iter().map(row), width)).collect::<PyResult<_>>()?;
        Ok(Self { names: found.quantities.clone(), units, curves })
    }

    /// Of an oscillator, over a number of a body in SI units in these units, because the nondimensional ones may change from value
    /// to value.
    fn of_oscillator(py: Python<'py>, found: &ResponseCurves, vary: Parameter, system: &SystemPlan) -> PyResult<Self> {
        let physical = matches!(vary, Parameter::Body(_));
        let units = Quantity::ALL.map(|of| if physical { of.kind().unit() } else { "" }).to_vec();
        Self::new(py, found, units, |row, k| {
            let there = if physical { system.with(vary, row.value).ok() } else { None };
            let scales = there.and_then(|system| system.scales());
            row.quantities[k] * scales.map_or(1.0, |scales| Quantity::ALL[k].kind().scale(&scales))
        })
    }
}

/// The plan of a task, which is JSON, for a system.
fn planned_task(system: vibroimpact_study::System, text: &str) -> Result<Plan, Trouble> {
    let task = Task::from_json(text, &system).map_err(|error| match error {
        // JSON is written by this package, so a position in it does not help the user
        PlanError::Text(error) => Trouble::question(error.without_place().to_string()),
        other => other.into(),
    })?;
    Ok(Plan::new(system, task))
}

/// The checked plan of a task, which is JSON, for a system. The start of a machine is given; that of an oscillator is in the task.
fn planned(system: &System<'_>, from: Option<Start>, text: &str, tile: Option<u32>) -> Result<Plan, Trouble> {
    let plan = match system {
        System::Oscillator(osc) => planned_task(osc.plan.into(), text)?,
        System::Machine(file) => {
            // a start of the wrong size is refused by its path
            let machine = match from {
                Some(from) => file.0.clone().starting(&start(file, from)?),
                None => file.0.clone(),
            };
            planned_task(machine.into(), text)?
        }
    };
    let plan = Plan { tile, ..plan };
    plan.check()?;
    Ok(plan)
}

/// The plan of a task, which is JSON, for a system.
#[pyfunction]
pub(crate) fn plan_of(
    system: System<'_>,
    from: Option<Start>,
    task: &str,
    tile: Option<u32>,
) -> Result<PlanFields, Trouble> {
    fields(&planned(&system, from, task, tile)?.canonical()?)
}

/// A plan with its result.
#[pyclass(frozen, module = "vibroimpact._core")]
pub(crate) struct Answer(Arc<vibroimpact_report::Answer>);

impl Answer {
    fn computed(py: Python<'_>, watch: Watch, plan: Plan) -> Result<Self, Trouble> {
        // results of this package are nondimensional
        let plan = Plan { units: None, ..plan };
        let found = door::run(py, watch, move |control| {
            Ok(vibroimpact_report::answer(&plan, Units::default(), control)?.named(""))
        })?;
        Ok(Self(Arc::new(found)))
    }
}

/// Keeps one of the branches only.
fn only(answer: &mut vibroimpact_report::Answer, number: usize) {
    fn keep<D: Dynamics>(results: &mut Results<D>, number: usize) {
        if let Results::Branch(found) = results {
            found.followed.truncate(number + 1);
            found.followed.drain(..number.min(found.followed.len()));
        }
    }
    match answer {
        vibroimpact_report::Answer::Oscillator(of) => keep(&mut of.results, number),
        vibroimpact_report::Answer::Machine(of) => keep(&mut of.results, number),
    }
}

/// The title of the figures of an oscillator, in the markup of labels.
#[pyfunction]
pub(crate) fn title_of(osc: OscillatorFile) -> String {
    figure::title(&Asked { system: osc.plan, units: Units::default() })
}

/// The contact that a JSON object asks for: the object of the command, and its figure as JSON.
#[pyfunction]
pub(crate) fn contact(question: &str) -> Result<(String, String), Trouble> {
    let question: ContactQuestion =
        serde_json::from_str(question).map_err(|error| Trouble::question(error.to_string()))?;
    let answer = question.answer().map_err(AnswerError::from)?;
    Ok((text(&answer)?, text(&answer.figure())?))
}

/// The figure of shares of starts by label, as JSON.
#[pyfunction]
pub(crate) fn shares_figure(osc: OscillatorFile, shares: Vec<(String, f64)>) -> Result<String, Trouble> {
    text(&figure::bars::shares(&shares, title_of(osc)))
}

/// Computes the answer to a task, which is JSON, for a system.
#[pyfunction]
pub(crate) fn answer(
    py: Python<'_>,
    system: System<'_>,
    from: Option<Start>,
    task: &str,
    total: u64,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<Answer, Trouble> {
    let plan = planned(&system, from, task, None)?;
    drop(system);
    Answer::computed(py, Watch { what: "computing an answer", total, progress, threads }, plan)
}

#[pymethods]
impl Answer {
    /// The answer to a plan, which is JSON.
    #[new]
    fn new(py: Python<'_>, plan: &str) -> Result<Self, Trouble> {
        Self::computed(py, Watch { what: "computing an answer", total: 1, progress: None, threads: 0 }, read(plan)?)
    }

    /// The plan, which is complete, as JSON.
    #[getter]
    fn plan(&self) -> Result<String, Trouble> {
        text(self.0.plan())
    }

    /// The object that the command prints with `--json`; [brief](vibroimpact_report::Answer::brief), if it is asked.
    fn json(&self, py: Python<'_>, brief: bool) -> Result<String, Trouble> {
        if brief {
            // nothing is computed
            return Ok(door::here(py, || self.0.brief()));
        }
        let answer = Arc::clone(&self.0);
        door::run(py, Watch::alone("writing an answer"), move |_| Ok(answer.json()))
    }

    /// The figure that the command draws, as JSON; nothing for an answer without one. `units` are those of an oscillator in metres and
    /// seconds. `of_branch`: whether the orbit diagram is behind a branch, whether inadmissible solutions are drawn, and the number
    /// of the only branch that is drawn. `quantity` is that of a response.
    fn figure(
        &self,
        py: Python<'_>,
        units: Option<ScalesOf>,
        of_branch: (bool, bool, Option<usize>),
        quantity: Option<String>,
    ) -> Result<Option<String>, Trouble> {
        let (diagram, inadmissible, branch) = of_branch;
        let mut answer = Arc::clone(&self.0);
        if units.is_some() || quantity.is_some() || branch.is_some() {
            let changed = Arc::make_mut(&mut answer);
            if let Some(number) = branch {
                only(changed, number);
            }
            if let (vibroimpact_report::Answer::Oscillator(of), Some(units)) = (&mut *changed, units) {
                let body = of.written.body;
                of.units = Units { scales: Some(scales(units)), si: true, body, ..Units::default() };
            }
            if let (Task::Response(task), Some(quantity)) = (&mut changed.plan_mut().task, quantity) {
                task.quantity = Some(quantity);
            }
        }
        let shown = Shown { diagram, inadmissible, ..Shown::default() };
        let watch = Watch { what: "drawing a figure", total: 1, progress: None, threads: 0 };
        let figure = door::run(py, watch, move |control| Ok(answer.figure(&shown, control)?))?;
        figure.map(|figure| text(&figure)).transpose()
    }

    /// Columns that the JSON object does not have.
    fn columns<'py>(&self, py: Python<'py>) -> Result<Option<Columns<'py>>, Trouble> {
        Ok(Some(match &*self.0 {
            vibroimpact_report::Answer::Oscillator(of) => match (&of.plan.task, &of.results) {
                (_, Results::Simulate(found)) => {
                    let object = |event| EventObject::of_oscillator(&of.system, event, &Units::default());
                    Columns::Simulation(SimulationFields::new(py, found, 1, object))
                }
                (_, Results::Lyapunov(_, Some(points))) => {
                    Columns::Section(SectionFields::new(py, points, &of.system, 1)?)
                }
                (Task::Response(task), Results::Response(found)) => {
                    let vary = Parameter::of(task.vary.text())?;
                    Columns::Response(ResponseFields::of_oscillator(py, found, vary, &of.written)?)
                }
                _ => return Ok(None),
            },
            vibroimpact_report::Answer::Machine(of) => match &of.results {
                Results::Simulate(found) => {
                    let object = |event| event::of_machine(&of.system, event);
                    Columns::Simulation(SimulationFields::new(py, found, of.system.n(), object))
                }
                Results::Lyapunov(_, Some(points)) => {
                    Columns::Section(SectionFields::new(py, points, &of.system, of.system.n())?)
                }
                Results::Response(found) => {
                    let units = vec![""; found.quantities.len()];
                    Columns::Response(ResponseFields::new(py, found, units, |row, k| row.quantities[k])?)
                }
                _ => return Ok(None),
            },
        }))
    }
}

/// The names of the parameters of an oscillator, the frequency in the form in which it was given.
#[pyfunction]
pub(crate) fn varied_parameters(osc: OscillatorFile) -> Vec<&'static str> {
    MarginsPlan::parameters(&osc.plan).into_iter().map(Parameter::name).collect()
}
