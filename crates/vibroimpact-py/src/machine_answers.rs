//! Questions about machines besides `simulate`: the JSON object of the command, and the motions at the points of a map.

use crate::door::{self, Watch};
use crate::error::Trouble;
use crate::machine::{MachineFile, Start, start};
use pyo3::prelude::*;
use vibroimpact_study::{MachinePlan, MachineResults, MachineShare, MachineTask};

/// The labels and the shares at each point of a map.
type Cells = Vec<Vec<(String, f64)>>;

/// The checked plan of a task, which is JSON, for a machine.
fn planned(file: &MachineFile, from: Start, task: &str, tile: Option<u32>) -> Result<MachinePlan, Trouble> {
    let task: MachineTask = serde_json::from_str(task).map_err(|error| {
        // JSON is written by this package, so a position in it does not help the user
        let said = error.to_string();
        Trouble::question(said.rsplit_once(" at line ").map_or(said.as_str(), |(said, _)| said).to_owned())
    })?;
    // a start of the wrong size is refused by its path
    let plan = MachinePlan { tile, ..MachinePlan::new(file.0.clone(), task) }.starting(&start(from));
    plan.check()?;
    Ok(plan)
}

/// The plan of a task, which is JSON, for a machine, as JSON.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // arguments from Python
pub(crate) fn machine_plan(file: &MachineFile, from: Start, task: &str, tile: Option<u32>) -> Result<String, Trouble> {
    Ok(planned(file, from, task, tile)?.json())
}

/// Computes the result of a task, which is JSON, for a machine. Returns the JSON object that the command prints, and the
/// points of a map, which the object does not have.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // arguments from Python
pub(crate) fn machine_answer(
    py: Python<'_>,
    file: &MachineFile,
    from: Start,
    task: &str,
    total: u64,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> Result<(String, Option<Cells>), Trouble> {
    let plan = planned(file, from, task, None)?;
    let watch = Watch { what: "computing the answer of a machine", total, progress, threads };
    door::run(py, watch, move |control| {
        let answer = vibroimpact_report::machine_answer("", &plan, control)?;
        let json = answer.json();
        let MachineResults::Map(found) = answer.results else { return Ok((json, None)) };
        let row = |cell: Vec<MachineShare>| cell.into_iter().map(|motion| (motion.label(), motion.share)).collect();
        Ok((json, Some(found.cells.into_iter().map(row).collect())))
    })
}
