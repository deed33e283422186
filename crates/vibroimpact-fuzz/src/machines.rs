//! Degenerate machines: their motions keep all rules, and the answers about them have what programs need.

use crate::case::Property;
use crate::rules;
use proptest::prelude::*;
use serde_json::Value;
use vibroimpact_cases::{Budget, Case, FAMILIES, faults};
use vibroimpact_report::{Units, answer};
use vibroimpact_study::machine::{MachineSource, no_files};
use vibroimpact_study::{Control, Plan, SimulatePlan, Task};

/// The family of degenerate machines.
#[derive(Clone, Copy, Debug)]
pub struct Machines;

/// The budgets of the questions, in events.
const EVENTS: u64 = 200;
const SETTLED: u32 = 400;

impl Property for Machines {
    type Case = (usize, u64);

    fn strategy(&self) -> BoxedStrategy<(usize, u64)> {
        (0..FAMILIES.len(), 0..u64::from(u32::MAX)).boxed()
    }

    fn describe(&self, (family, seed): &(usize, u64)) -> String {
        let case = FAMILIES[*family].case(*seed);
        format!("machine {seed} of the family {}:\n{}", case.family, file(&case).to_toml())
    }

    fn check(&mut self, (family, seed): &(usize, u64)) -> Result<(), String> {
        let case = FAMILIES[*family].case(*seed);
        if let Some(fault) = faults(&case, Budget::default()).first() {
            return Err(fault.to_string());
        }
        let source =
            MachineSource::from_text(&file(&case).to_toml(), no_files).map_err(|why| format!("its file: {why}"))?;
        let read = source.machine().map_err(|why| format!("its file: {why}"))?;
        if read.parts() != case.machine.parts() {
            return Err("its file is another machine".to_owned());
        }
        let simulate =
            asked(&source, SimulatePlan { impacts: Some(EVENTS), ..SimulatePlan::default() }.into(), "simulate")?;
        ended(&case, simulate["end"]["reason"].as_str().unwrap_or_default())?;
        asked(&source, Task::Settle { start: None, impacts: Some(SETTLED) }, "settle")?;
        Ok(())
    }
}

/// The machine file of a case.
pub(crate) fn file(case: &Case) -> MachineSource {
    MachineSource::from(&case.machine).starting(&case.start)
}

/// The answer to a question about a machine, which has all that programs need.
fn asked(source: &MachineSource, task: Task, name: &str) -> Result<Value, String> {
    let plan = Plan::new(source.clone(), task);
    let answer = answer(&plan, Units::default(), &Control::default()).map_err(|why| format!("{name}: {why}"))?;
    let object = rules::object(answer.json().as_bytes())?;
    rules::answer(name, &object)?;
    Ok(object)
}

/// A motion does not end by the limit of the search, and without a rigid stop not by a collapse.
fn ended(case: &Case, end: &str) -> Result<(), String> {
    match end {
        "search_limit" | "inconsistent" => Err(format!("simulate ends with {end}")),
        "collapse" if !case.has_rigid_stop() => Err("simulate ends with a collapse without a rigid stop".to_owned()),
        _ => Ok(()),
    }
}
