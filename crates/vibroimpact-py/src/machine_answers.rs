//! Questions about machines besides `simulate`: the JSON object of the command, and the motions at the points of a map.

use crate::columns::{column, grid};
use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::machine::{MachineFile, Start, start};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use vibroimpact_study::{MachineDiagram, MachineDiagramStep, MachinePlan, MachineResults, MachineSection, MachineTask};

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
    fn new(py: Python<'py>, found: &MachineSection, stop: Vec<String>, width: usize) -> PyResult<Self> {
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
    fn new(py: Python<'py>, found: &MachineDiagram) -> Self {
        let repeats =
            |step: &MachineDiagramStep| (step.points.len() as u64) < found.plan.keep || step.points.len() == 1;
        let points = || found.steps.iter().flat_map(|step| step.points.iter().map(move |point| (step, point)));
        Self {
            parameter: column(py, points().map(|(step, _)| found.plan.over.at(step.index as usize))),
            speed: column(py, points().map(|(_, point)| point.value)),
            repeats: column(py, points().map(|(step, _)| repeats(step))),
        }
    }
}

/// The JSON object that the command prints, and what the object does not have: the points of the sections of an attractor, or of
/// an orbit diagram.
#[derive(IntoPyObject)]
pub(crate) struct AnswerFields<'py> {
    json: String,
    section: Option<SectionFields<'py>>,
    diagram: Option<DiagramFields<'py>>,
}

/// The checked plan of a task, which is JSON, for a machine.
fn planned(file: &MachineFile, from: Start, task: &str, tile: Option<u32>) -> Result<MachinePlan, Trouble> {
    let task: MachineTask = serde_json::from_str(task).map_err(|error| {
        // JSON is written by this package, so a position in it does not help the user
        let said = error.to_string();
        Trouble::question(said.rsplit_once(" at line ").map_or(said.as_str(), |(said, _)| said).to_owned())
    })?;
    // a start of the wrong size is refused by its path
    let plan = MachinePlan { tile, ..MachinePlan::new(file.0.clone(), task) }.starting(&start(file, from)?);
    plan.check()?;
    Ok(plan)
}

/// The plan of a task, which is JSON, for a machine, as JSON.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // arguments from Python
pub(crate) fn machine_plan(file: &MachineFile, from: Start, task: &str, tile: Option<u32>) -> Result<String, Trouble> {
    Ok(planned(file, from, task, tile)?.json())
}

/// Computes the result of a task, which is JSON, for a machine.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // arguments from Python
pub(crate) fn machine_answer<'py>(
    py: Python<'py>,
    file: &MachineFile,
    from: Start,
    task: &str,
    total: u64,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<AnswerFields<'py>, Trouble> {
    let plan = planned(file, from, task, None)?;
    let watch = Watch { what: "computing the answer of a machine", total, progress, threads };
    let (json, machine, results) = door::run(py, watch, move |control| {
        let answer = vibroimpact_report::machine_answer("", &plan, control)?;
        Ok((answer.json(), answer.machine, answer.results))
    })?;
    let mut answer = AnswerFields { json, section: None, diagram: None };
    match results {
        MachineResults::Lyapunov(_, Some(points)) => {
            let stops = points.closings.iter().map(|at| machine.name_of(at.place).to_owned()).collect();
            answer.section = Some(SectionFields::new(py, &points, stops, machine.n())?);
        }
        MachineResults::Diagram(found) => answer.diagram = Some(DiagramFields::new(py, &found)),
        _ => {}
    }
    Ok(answer)
}
