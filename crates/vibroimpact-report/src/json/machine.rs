//! The objects of machines: those of oscillators, from the results of machines.

use super::Document;
use super::attractors::AttractorsAnswer;
use super::basin::BasinAnswer;
use super::branch::BranchAnswer;
use super::curve::CurveAnswer;
use super::diagram::DiagramAnswer;
use super::event::StateObject;
use super::lyapunov::LyapunovAnswer;
use super::map::MapAnswer;
use super::margins::MarginsAnswer;
use super::orbit::OrbitAnswer;
use super::region::RegionAnswer;
use super::response::ResponseAnswer;
use super::settle::SettleAnswer;
use super::simulate::SimulateAnswer;
use super::system::SystemObject;
use crate::response::ResponseView;
use crate::{MachineAnswer, PROGRAM};
use serde::ser::Error;
use serde::{Serialize, Serializer};
use vibroimpact_study::{MachineResults, MachineTask};

impl Serialize for MachineAnswer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { machine, results, plan, .. } = self;
        match (&plan.task, results) {
            (MachineTask::Simulate { periods, .. }, MachineResults::Simulate(found)) => {
                self.document(SimulateAnswer::of_machine((machine, &self.start), *periods, found), to)
            }
            (_, MachineResults::Settle(found)) => self.document(SettleAnswer::of_machine(machine, found), to),
            (MachineTask::Attractors { seed, .. }, MachineResults::Attractors(census)) => {
                self.document(AttractorsAnswer::of_machine(machine, *seed, census), to)
            }
            (_, MachineResults::Orbit(found)) => self.document(OrbitAnswer::of_machine(machine, found), to),
            (_, MachineResults::Lyapunov(found, _)) => self.document(LyapunovAnswer::of_machine(machine, found), to),
            (MachineTask::Branch(task), MachineResults::Branch(found)) => {
                let cut = task.cut(&plan.machine).map_err(Error::custom)?;
                self.document(BranchAnswer::of_machine((machine, &plan.machine), task, &cut, found), to)
            }
            (MachineTask::Curve(task), MachineResults::Curve(found)) => {
                self.document(CurveAnswer::of_machine(machine, task, found), to)
            }
            (_, MachineResults::Margins(found)) => self.document(MarginsAnswer::of_machine(machine, found), to),
            (MachineTask::Region(task), MachineResults::Region(found)) => {
                self.document(RegionAnswer::of_machine(found, task, &plan.machine), to)
            }
            (MachineTask::Response(task), MachineResults::Response(found)) => {
                self.document(ResponseAnswer::new(&ResponseView::of_machine(found, task, machine)), to)
            }
            (_, MachineResults::Basin(found)) => self.document(BasinAnswer::of_machine(machine, found), to),
            (_, MachineResults::Diagram(found)) => self.document(DiagramAnswer::of_machine(machine, found), to),
            (MachineTask::Map(task), MachineResults::Map(found)) => {
                self.document(MapAnswer::of_machine(machine, (task.starts, task.seed), found), to)
            }
            (MachineTask::SettleMany(_), MachineResults::Map(found)) => {
                self.document(MapAnswer::of_machine(machine, (1, 0), found), to)
            }
            // `machine_answer` combines each plan with its own results, so this does not occur
            _ => Err(Error::custom("the results belong to another task than the plan's")),
        }
    }
}

/// Whether a task has one start, or all of its starts agree in what varies on no axis.
const fn begins(task: &MachineTask) -> bool {
    match task {
        MachineTask::Simulate { .. }
        | MachineTask::Settle { .. }
        | MachineTask::Lyapunov(_)
        | MachineTask::SettleMany(_)
        | MachineTask::Basin(_) => true,
        MachineTask::Branch(branch) => branch.label.is_none(),
        MachineTask::Curve(curve) => curve.label.is_none(),
        MachineTask::Margins(margins) => margins.label.is_none(),
        MachineTask::Attractors { .. }
        | MachineTask::Orbit { .. }
        | MachineTask::Map(_)
        | MachineTask::Diagram(_)
        | MachineTask::Region(_)
        | MachineTask::Response(_) => false,
    }
}

impl MachineAnswer {
    /// Writes the object with this answer.
    fn document<S: Serializer, T: Serialize>(&self, result: T, to: S) -> Result<S::Ok, S::Error> {
        let Self { name, plan, machine, start, .. } = self;
        let system = SystemObject::of_machine(name, machine);
        let start = begins(&plan.task).then(|| StateObject::of(machine, start));
        Document { system, start, units: None, result, plan, program: PROGRAM }.serialize(to)
    }
}
