//! The object of the answer to each plan, of any system.

use super::Document;
use crate::PROGRAM;
use crate::answer::{AnswerOf, Told};
use crate::task::attractors::AttractorsAnswer;
use crate::task::basin::BasinAnswer;
use crate::task::diagram::DiagramAnswer;
use crate::task::edge::EdgeAnswer;
use crate::task::map::MapAnswer;
use crate::task::margins::MarginsAnswer;
use crate::task::region::RegionAnswer;
use crate::task::response::ResponseAnswer;
use crate::task::simulate::SimulateAnswer;
use serde::ser::Error;
use serde::{Serialize, Serializer};
use vibroimpact_study::{Results, Task};

impl<D: Told> Serialize for AnswerOf<D> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        Written(self, false).serialize(to)
    }
}

impl<D: Told> AnswerOf<D> {
    /// The JSON object without what takes longest to compute: the harmonics and the transient of a settled motion.
    pub(crate) fn brief(&self) -> String {
        // texts and numbers can always be written as JSON
        serde_json::to_string(&Written(self, true)).unwrap_or_default()
    }
}

/// An answer, and whether it is brief.
struct Written<'a, D: Told>(&'a AnswerOf<D>, bool);

impl<D: Told> Serialize for Written<'_, D> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self(of, brief) = *self;
        let AnswerOf { plan, system, units, results, .. } = of;
        match results {
            Results::Simulate(found) => {
                document(of, SimulateAnswer::new(D::events(of, found), found, units)).serialize(to)
            }
            Results::Settle(found) => document(of, D::settled(of, found, brief)).serialize(to),
            Results::Attractors(found) => {
                let seed = if let Task::Attractors { seed, .. } = &plan.task { *seed } else { 0 };
                document(of, AttractorsAnswer::new(of, found, seed)).serialize(to)
            }
            Results::Orbit(found) => document(of, of.orbits(found)).serialize(to),
            Results::Basin(found) => document(of, BasinAnswer::new(of, found)).serialize(to),
            Results::Map(found) => {
                // points that are no grid have one start each
                let sequence = if let Task::Map(task) = &plan.task { (task.starts, task.seed) } else { (1, 0) };
                document(of, MapAnswer::new(found, system, sequence, units)).serialize(to)
            }
            Results::Diagram(found) => document(of, DiagramAnswer::new(found, units)).serialize(to),
            Results::Lyapunov(found, _) => document(of, D::exponents_object(of, found)).serialize(to),
            Results::Branch(found) => document(of, of.branches(found).map_err(Error::custom)?).serialize(to),
            Results::Curve(found) => document(of, of.curve(found).map_err(Error::custom)?).serialize(to),
            Results::Region(found) => {
                let plan = of.region_plan().map_err(Error::custom)?;
                document(of, RegionAnswer::new(found, &plan, plan.neutral(&of.written), units)).serialize(to)
            }
            Results::Response(found) => {
                let view = D::response(of, found).map_err(Error::custom)?;
                document(of, ResponseAnswer::new(&view)).serialize(to)
            }
            Results::Edge(found) => document(of, EdgeAnswer::new(of, found)).serialize(to),
            Results::Margins(found) => document(of, MarginsAnswer::new(of, found)).serialize(to),
        }
    }
}

/// The object with this answer.
fn document<D: Told, T: Serialize>(of: &AnswerOf<D>, result: T) -> Document<'_, T, vibroimpact_study::Plan> {
    let start = begins(&of.plan.task).then(|| D::state(of));
    let units = D::machine(of).is_none().then(|| of.units.name());
    Document { system: D::system(of), start, units, result, plan: &of.plan, program: PROGRAM }
}

/// Whether a task has one start, or all of its starts agree in what varies on no axis.
const fn begins(task: &Task) -> bool {
    match task {
        Task::Simulate(_) | Task::Settle { .. } | Task::Lyapunov(_) | Task::SettleMany(_) | Task::Basin(_) => true,
        Task::Edge(_) => true,
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
