//! The answer to a question about any system: the JSON object of the command, and the numbers that it does not have.

use crate::columns::{column, grid};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::machine::{MachineFile, Start, start};
use crate::oscillator::Oscillator;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use vibroimpact::chaos::Section;
use vibroimpact_report::json::event::side;
use vibroimpact_report::{Answer, Units};
use vibroimpact_study::diagram::DiagramPoint;
use vibroimpact_study::{
    Diagram, MarginsPlan, Name, Parameter, Plan, PlanError, Quantity, ResponseCurves, ResponseRow, Results,
    SectionPoints, SystemPlan, Task, machine,
};

/// A system about which a question is asked.
#[derive(FromPyObject)]
#[allow(clippy::large_enum_variant, reason = "there is one of them in a call")]
pub(crate) enum System<'py> {
    Oscillator(Oscillator),
    Machine(PyRef<'py, MachineFile>),
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
    fn of_oscillator(py: Python<'py>, osc: &vibroimpact::Oscillator, found: &Section) -> PyResult<Self> {
        let (impacts, strobes) = (|| found.impacts.iter(), || found.strobes.iter());
        let of = |at: vibroimpact::Side| osc.stop(at).map_or((0.0, 0.0), |stop| (stop.gap, stop.restitution));
        Ok(Self {
            stop: impacts().map(|at| side(at.side).to_owned()).collect(),
            phase: column(py, impacts().map(|at| at.phase)),
            speed: column(py, impacts().map(|at| at.velocity)),
            q: grid(py, impacts().map(|at| vec![at.side.sign() * of(at.side).0]), 1)?,
            // without a rebound 0, not -0
            qdot: grid(py, impacts().map(|at| vec![-at.side.sign() * of(at.side).1 * at.velocity + 0.0]), 1)?,
            strobe_q: grid(py, strobes().map(|at| vec![at.x]), 1)?,
            strobe_qdot: grid(py, strobes().map(|at| vec![at.v]), 1)?,
        })
    }

    fn of_machine(py: Python<'py>, found: &SectionPoints, stop: Vec<String>, width: usize) -> PyResult<Self> {
        let (closings, strobes) = (|| found.closings.iter(), || found.strobes.iter());
        Ok(Self {
            stop,
            phase: column(py, closings().map(|at| at.phase)),
            speed: column(py, closings().map(|at| at.speed)),
            q: grid(py, closings().map(|at| at.q.clone()), width)?,
            qdot: grid(py, closings().map(|at| at.qdot.clone()), width)?,
            strobe_q: grid(py, strobes().map(|at| at.q.clone()), width)?,
            strobe_qdot: grid(py, strobes().map(|at| at.qdot.clone()), width)?,
        })
    }
}

/// The points of an orbit diagram, and whether each is of a motion that repeats.
#[derive(IntoPyObject)]
pub(crate) struct DiagramFields<'py> {
    parameter: Bound<'py, PyArray1<f64>>,
    speed: Bound<'py, PyArray1<f64>>,
    repeats: Bound<'py, PyArray1<bool>>,
}

impl<'py> DiagramFields<'py> {
    fn new(py: Python<'py>, found: &Diagram<String, String>) -> Self {
        let points = || found.steps.iter().flat_map(|step| step.points.iter().map(move |point| (step, point)));
        Self {
            parameter: column(py, points().map(|(step, _)| found.plan.over.at(step.index as usize))),
            speed: column(
                py,
                points().map(|(_, point)| match *point {
                    DiagramPoint::Impact { speed, .. } => speed,
                    DiagramPoint::Chatter { .. } => 0.0,
                    DiagramPoint::State { x, .. } => x,
                    DiagramPoint::Value(value) => value,
                }),
            ),
            repeats: column(py, points().map(|(step, _)| step.repeats(found.plan.keep))),
        }
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
        let physical = matches!(vary, Parameter::Physical(_));
        let units = Quantity::ALL.map(|of| if physical { of.kind().unit() } else { "" }).to_vec();
        Self::new(py, found, units, |row, k| {
            let there = if physical { system.with(vary, row.value).ok() } else { None };
            let scales = there.and_then(|system| system.scales());
            row.quantities[k] * scales.map_or(1.0, |scales| Quantity::ALL[k].kind().in_si(&scales))
        })
    }
}

/// The JSON object that the command prints, [brief](vibroimpact_report::Answer::brief), and what it does not have: the points of the sections of an attractor and of an orbit
/// diagram, and all quantities of a response.
#[derive(Default, IntoPyObject)]
pub(crate) struct AnswerFields<'py> {
    json: String,
    section: Option<SectionFields<'py>>,
    diagram: Option<DiagramFields<'py>>,
    response: Option<ResponseFields<'py>>,
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

/// The plan of a task, which is JSON, for a system, as JSON.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // arguments from Python
pub(crate) fn plan_json(
    system: System<'_>,
    from: Option<Start>,
    task: &str,
    tile: Option<u32>,
) -> Result<String, Trouble> {
    crate::simulate::text(&planned(&system, from, task, tile)?)
}

/// Computes the answer to a task, which is JSON, for a system.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // arguments from Python
pub(crate) fn answer<'py>(
    py: Python<'py>,
    system: System<'py>,
    from: Option<Start>,
    task: &str,
    total: u64,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<AnswerFields<'py>, Trouble> {
    let plan = planned(&system, from, task, None)?;
    drop(system);
    let watch = Watch { what: "computing an answer", total, progress, threads };
    let (json, answer) = door::run(py, watch, move |control| {
        let answer = vibroimpact_report::answer(&plan, Units::default(), control)?.named("");
        Ok((answer.brief(), answer))
    })?;
    let mut fields = AnswerFields { json, ..AnswerFields::default() };
    match answer {
        Answer::Oscillator(of) => match (&of.plan.task, &of.results) {
            (_, Results::Lyapunov(_, _, Some(points))) => {
                fields.section = Some(SectionFields::of_oscillator(py, &of.osc, points)?);
            }
            (Task::Response(task), Results::Response(found)) => {
                let vary = Parameter::of(task.vary.text())?;
                fields.response = Some(ResponseFields::of_oscillator(py, found, vary, &of.asked.system)?);
            }
            _ => {}
        },
        Answer::Machine(of) => match &of.results {
            machine::Results::Lyapunov(_, Some(points)) => {
                let stops = points.closings.iter().map(|at| of.machine.name_of(at.place).to_owned()).collect();
                fields.section = Some(SectionFields::of_machine(py, points, stops, of.machine.n())?);
            }
            machine::Results::Diagram(found) => fields.diagram = Some(DiagramFields::new(py, found)),
            machine::Results::Response(found) => {
                let units = vec![""; found.quantities.len()];
                fields.response = Some(ResponseFields::new(py, found, units, |row, k| row.quantities[k])?);
            }
            _ => {}
        },
    }
    Ok(fields)
}

/// The names of the parameters of an oscillator, the frequency in the form in which it was given.
#[pyfunction]
pub(crate) fn varied_parameters(osc: Oscillator) -> Vec<&'static str> {
    MarginsPlan::parameters(&osc.plan).into_iter().map(Parameter::name).collect()
}
