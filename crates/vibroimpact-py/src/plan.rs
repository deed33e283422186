//! A plan as text, JSON or TOML, checked and in the form in which it is stored.

use crate::error::Trouble;
use crate::oscillator::Oscillator;
use pyo3::prelude::*;
use vibroimpact_study::{Axis, Plan, Task};

/// The plan of a text.
pub(crate) fn read(text: &str) -> Result<Plan, Trouble> {
    let plan = if text.trim_start().starts_with('{') {
        serde_json::from_str::<Plan>(text).map_err(|error| {
            // where in a text that nobody wrote by hand helps nobody
            let sentence = error.to_string();
            Trouble::question(sentence.rsplit_once(" at line ").map_or(sentence.as_str(), |(before, _)| before))
        })?
    } else {
        Plan::from_text(text)?
    };
    let plan = plan.canonical()?;
    plan.check()?;
    Ok(plan)
}

/// Points of the grid that a plan fills; 0 for one that fills none.
pub(crate) fn points(plan: &Plan) -> u64 {
    let grid = |axes: &[Axis]| axes.iter().map(|axis| axis.over.count() as u64).product();
    match &plan.task {
        Task::Map(map) => grid(&map.axes),
        Task::Basin(basin) => grid(&basin.axes),
        Task::Lyapunov(lyapunov) => grid(&lyapunov.axes),
        Task::Attractors { starts, .. } => *starts,
        Task::Diagram(diagram) => u64::from(diagram.over.count()) * diagram.runs(),
        _ => 0,
    }
}

/// The plan as it is stored, its hash, what it asks in words, and the points it fills.
#[pyfunction]
pub(crate) fn checked_plan(text: &str) -> Result<(String, String, String, u64), Trouble> {
    let plan = read(text)?;
    Ok((crate::simulate::text(&plan)?, plan.hash(), plan.title(), points(&plan)))
}

/// The fields of an oscillator's system in a plan as JSON, the frequency as it was given.
#[pyfunction]
pub(crate) fn system_fields(osc: Oscillator) -> Result<String, Trouble> {
    serde_json::to_string(&osc.plan).map_err(|_| Trouble::Defect("writing the system"))
}
