//! The object of the answer to each plan, of any system.

use super::Document;
use super::attractors::AttractorsAnswer;
use super::basin::BasinAnswer;
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
use crate::answer::{machine::Answer, oscillator};
use crate::response::ResponseView;
use crate::{PROGRAM, Units};
use serde::ser::Error;
use serde::{Serialize, Serializer};
use vibroimpact::Start;
use vibroimpact_study::{Coordinate, Name as _, Parameter, RegionPlan, Results, StartPlan, Task, machine};

impl Serialize for oscillator::Answer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { plan, asked, osc, results, paper_rule } = self;
        let units = &asked.units;
        match (&plan.task, results) {
            (_, Results::Simulate(start, found)) => {
                self.begin(start, SimulateAnswer::of_oscillator(osc, found, units), to)
            }
            (_, Results::Settle(start, found)) => {
                self.begin(start, SettleAnswer::of_oscillator(found, (osc, start), *paper_rule, units), to)
            }
            (Task::Attractors { seed, .. }, Results::Attractors(found)) => {
                self.document(&[], AttractorsAnswer::of_oscillator(osc, *seed, found, units), to)
            }
            (_, Results::Orbit(found)) => self.document(&[], OrbitAnswer::of_oscillator(found, osc, units), to),
            (_, Results::Basin(found)) => {
                let StartPlan { x, v, phase } = found.plan.start();
                let start = Start { x: x.unwrap_or_else(|| Start::at_rest(osc).x), v, phase };
                self.begin(&start, BasinAnswer::of_oscillator(found, osc, units), to)
            }
            (Task::Map(task), Results::Map(found)) => {
                let answer = MapAnswer::new(found, &asked.system, (task.starts, task.seed), units);
                self.document(&found.varied().filter_map(parameter).collect::<Vec<_>>(), answer, to)
            }
            (_, Results::Diagram(found)) => self.document(&[], DiagramAnswer::new(found, units), to),
            (_, Results::Lyapunov(start, found, _)) => {
                self.begin(start, LyapunovAnswer::of_oscillator(found, osc, units), to)
            }
            (_, Results::Branch(found)) => self.document(&[], self.branches(found).map_err(Error::custom)?, to),
            (_, Results::Curve(found)) => self.document(&[], self.curve(found).map_err(Error::custom)?, to),
            (Task::Region(task), Results::Region(found)) => {
                let task: RegionPlan = task.typed().map_err(Error::custom)?;
                let answer = RegionAnswer::new(found, &task, task.neutral(&asked.system), units);
                self.document(&[task.across.parameter, task.up.parameter], answer, to)
            }
            (Task::Response(task), Results::Response(found)) => {
                let view = ResponseView::of_oscillator(found, task, units).map_err(Error::custom)?;
                let vary = Parameter::of(task.vary.text()).map_err(Error::custom)?;
                self.document(&[vary], ResponseAnswer::new(&view), to)
            }
            (_, Results::Margins(start, found)) => {
                let motion = MotionObject::of_oscillator(&found.motion, osc, units);
                let answer = MarginsAnswer::new(found, osc, motion, units);
                match start {
                    Some(start) => self.begin(start, answer, to),
                    None => self.document(&[], answer, to),
                }
            }
            // `answer` combines each plan with its own results, so this does not occur
            _ => Err(Error::custom(OTHER)),
        }
    }
}

const fn parameter(vary: &Coordinate) -> Option<Parameter> {
    if let Coordinate::Parameter(parameter) = vary { Some(*parameter) } else { None }
}

impl oscillator::Answer {
    /// Writes the object with this answer, over parameters that vary.
    fn document<S: Serializer, T: Serialize>(&self, varied: &[Parameter], result: T, to: S) -> Result<S::Ok, S::Error> {
        Document::over(&self.asked, &self.osc, varied, &self.plan, result).serialize(to)
    }

    /// The same of a motion from a start.
    fn begin<S: Serializer, T: Serialize>(&self, start: &Start, result: T, to: S) -> Result<S::Ok, S::Error> {
        let document = Document::over(&self.asked, &self.osc, &[], &self.plan, result);
        document.start(start, &self.asked.units).serialize(to)
    }

    /// The object of a settled motion without what takes longest to compute.
    pub(crate) fn brief_document(&self) -> Option<impl Serialize> {
        let Results::Settle(start, found) = &self.results else { return None };
        let answer = SettleAnswer::brief(found, &self.osc, &self.asked.units);
        Some(Document::over(&self.asked, &self.osc, &[], &self.plan, answer).start(start, &self.asked.units))
    }
}

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
            (_, machine::Results::Branch(found)) => self.document(self.branches(found).map_err(Error::custom)?, to),
            (_, machine::Results::Curve(found)) => self.document(self.curve(found).map_err(Error::custom)?, to),
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
