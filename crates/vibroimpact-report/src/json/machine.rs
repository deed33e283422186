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
use super::motion::MotionObject;
use super::orbit::OrbitAnswer;
use super::region::RegionAnswer;
use super::response::ResponseAnswer;
use super::settle::SettleAnswer;
use super::simulate::SimulateAnswer;
use super::system::SystemObject;
use crate::answer::machine::Answer;
use crate::response::ResponseView;
use crate::{PROGRAM, Units};
use serde::ser::Error;
use serde::{Serialize, Serializer};
use vibroimpact_study::{RegionPlan, Task, machine};

impl Serialize for Answer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { machine, results, plan, source, .. } = self;
        match (&plan.task, results) {
            (Task::Simulate { periods, .. }, machine::Results::Simulate(found)) => {
                self.document(SimulateAnswer::of_machine((machine, &self.start), *periods, found), to)
            }
            (_, machine::Results::Settle(found)) => self.document(SettleAnswer::of_machine(machine, found), to),
            (Task::Attractors { seed, .. }, machine::Results::Attractors(census)) => {
                self.document(AttractorsAnswer::of_machine(machine, *seed, census), to)
            }
            (_, machine::Results::Orbit(found)) => self.document(OrbitAnswer::of_machine(machine, found), to),
            (_, machine::Results::Lyapunov(found, _)) => self.document(LyapunovAnswer::of_machine(machine, found), to),
            (Task::Branch(task), machine::Results::Branch(found)) => {
                let cut = task.typed::<String>().and_then(|task| task.cut(source)).map_err(Error::custom)?;
                self.document(BranchAnswer::of_machine((machine, source), &cut, found), to)
            }
            (Task::Curve(task), machine::Results::Curve(found)) => {
                let task = task.typed().map_err(Error::custom)?;
                self.document(CurveAnswer::of_machine(machine, &task, found), to)
            }
            (_, machine::Results::Margins(found)) => {
                let motion = MotionObject::of_machine(machine, &found.motion);
                self.document(MarginsAnswer::new(found, machine, motion, &Units::default()), to)
            }
            (Task::Region(task), machine::Results::Region(found)) => {
                let task: RegionPlan<String> = task.typed().map_err(Error::custom)?;
                self.document(RegionAnswer::new(found, &task, task.neutral(source), &Units::default()), to)
            }
            (Task::Response(task), machine::Results::Response(found)) => {
                self.document(ResponseAnswer::new(&ResponseView::of_machine(found, task, machine)), to)
            }
            (_, machine::Results::Basin(found)) => {
                let motion = |verdict| MotionObject::of_machine(machine, verdict);
                self.document(BasinAnswer::new(found, &Units::default(), motion), to)
            }
            (_, machine::Results::Diagram(found)) => self.document(DiagramAnswer::new(found, &Units::default()), to),
            (Task::Map(task), machine::Results::Map(found)) => {
                self.document(MapAnswer::new(found, machine, (task.starts, task.seed), &Units::default()), to)
            }
            (Task::SettleMany(_), machine::Results::Map(found)) => {
                self.document(MapAnswer::new(found, machine, (1, 0), &Units::default()), to)
            }
            // `answer` combines each plan with its own results, so this does not occur
            _ => Err(Error::custom(OTHER)),
        }
    }
}

/// A plan with results of another one.
const OTHER: &str = "the results belong to another task than the plan's";

/// Whether a task has one start, or all of its starts agree in what varies on no axis.
const fn begins(task: &Task) -> bool {
    match task {
        Task::Simulate { .. } | Task::Settle { .. } | Task::Lyapunov(_) | Task::SettleMany(_) | Task::Basin(_) => true,
        Task::Branch(branch) => branch.label.is_none(),
        Task::Curve(curve) => curve.label.is_none(),
        Task::Margins(margins) => margins.label.is_none(),
        Task::Attractors { .. }
        | Task::Orbit { .. }
        | Task::Map(_)
        | Task::Diagram(_)
        | Task::Region(_)
        | Task::Response(_) => false,
    }
}

impl Answer {
    /// Writes the object with this answer.
    fn document<S: Serializer, T: Serialize>(&self, result: T, to: S) -> Result<S::Ok, S::Error> {
        let Self { name, plan, machine, start, .. } = self;
        let system = SystemObject::of_machine(name, machine);
        let start = begins(&plan.task).then(|| StateObject::of(machine, start));
        Document { system, start, units: None, result, plan, program: PROGRAM }.serialize(to)
    }
}
