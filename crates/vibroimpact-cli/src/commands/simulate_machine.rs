//! `vibro simulate --machine` and `vibro run` with a plan of a machine: the result of the plan.

use crate::commands::outputs::Outputs;
use crate::failure::Failure;
use crate::report::machine_events as text;
use crate::session::Session;
use vibroimpact_report::machine_answer;
use vibroimpact_study::{MachinePlan, MachineResults};

/// Computes the answer of a plan and reports it.
pub(super) fn run(
    name: &str,
    plan: &MachinePlan,
    (outputs, step): (Outputs, Option<f64>),
    session: &Session,
) -> Result<(), Failure> {
    let answer = session.watched(None, |control| machine_answer(name, plan, control))?;
    let (json, table) = (outputs.json(), outputs.table_on_stdout());
    outputs.write(session, || Ok(answer.table(step)?), || Ok(answer.figure()?))?;
    if json {
        return session.print_json(&answer);
    }
    if table {
        return Ok(());
    }
    match &answer.results {
        MachineResults::Simulate(found) => session.print(&text::events(&answer.machine, found)),
    }
}
