//! The object of the answer to each plan, of any system, and its schema.

use crate::answer::{AnswerOf, Told};
use crate::json::branch::BranchAnswer;
use crate::json::{Document, JsonSchema};
use crate::{ContactAnswer, PROGRAM, task};
use schemars::generate::SchemaSettings;
use serde::ser::Error;
use serde::{Serialize, Serializer};
use serde_json::Value;
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
                document(of, task::simulate::SimulateAnswer::new(D::events(of, found), found, units)).serialize(to)
            }
            Results::Settle(found) => document(of, D::settled(of, found, brief)).serialize(to),
            Results::Attractors(found) => {
                let seed = if let Task::Attractors { seed, .. } = &plan.task { *seed } else { 0 };
                document(of, task::attractors::AttractorsAnswer::new(of, found, seed)).serialize(to)
            }
            Results::Orbit(found) => document(of, of.orbits(found)).serialize(to),
            Results::Basin(found) => document(of, task::basin::BasinAnswer::new(of, found)).serialize(to),
            Results::Map(found) => {
                // points that are no grid have one start each
                let sequence = if let Task::Map(task) = &plan.task { (task.starts, task.seed) } else { (1, 0) };
                document(of, task::map::MapAnswer::new(found, system, sequence, units)).serialize(to)
            }
            Results::Diagram(found) => document(of, task::diagram::DiagramAnswer::new(found, units)).serialize(to),
            Results::Lyapunov(found, _) => document(of, D::exponents_object(of, found)).serialize(to),
            Results::Branch(found) => document(of, of.branches(found).map_err(Error::custom)?).serialize(to),
            Results::Curve(found) => document(of, of.curve(found).map_err(Error::custom)?).serialize(to),
            Results::Region(found) => {
                let plan = of.region_plan().map_err(Error::custom)?;
                document(of, task::region::RegionAnswer::new(found, &plan, plan.neutral(&of.written), units))
                    .serialize(to)
            }
            Results::Response(found) => {
                let view = D::response(of, found).map_err(Error::custom)?;
                document(of, task::response::ResponseAnswer::new(&view)).serialize(to)
            }
            Results::Edge(found) => document(of, task::edge::EdgeAnswer::new(of, found)).serialize(to),
            Results::Margins(found) => document(of, task::margins::MarginsAnswer::new(of, found)).serialize(to),
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

/// Makes a schema.
type Maker = fn() -> Value;

/// The commands whose answers have a schema, with its maker.
const SCHEMAS: [(&str, Maker); 16] = [
    ("simulate", of::<task::simulate::SimulateAnswer<'static>>),
    ("settle", of::<task::settle::SettleAnswer<'static>>),
    ("attractors", of::<task::attractors::AttractorsAnswer<'static>>),
    ("orbit", of::<task::orbit::OrbitAnswer<'static>>),
    ("branch", of::<BranchAnswer<'static>>),
    ("curve", of::<task::curve::CurveAnswer<'static>>),
    ("region", of::<task::region::RegionAnswer>),
    ("response", of::<task::response::ResponseAnswer<'static>>),
    ("margins", of::<task::margins::MarginsAnswer<'static>>),
    ("edge", of::<task::edge::EdgeAnswer<'static>>),
    ("lyapunov", of::<task::lyapunov::LyapunovAnswer<'static>>),
    ("diagram", of::<task::diagram::DiagramAnswer>),
    ("map", of::<task::map::MapAnswer>),
    ("basin", of::<task::basin::BasinAnswer<'static>>),
    ("settle-many", of::<task::map::MapAnswer>),
    ("contact", root::<ContactAnswer>),
];

fn of<T: JsonSchema>() -> Value {
    root::<Document<'static, T, ()>>()
}

fn root<T: JsonSchema>() -> Value {
    // of what is written: fields that are left out where they say nothing are not required
    SchemaSettings::draft2020_12().for_serialize().into_generator().into_root_schema_for::<T>().to_value()
}

/// The names of these commands.
pub fn verbs() -> impl Iterator<Item = &'static str> {
    SCHEMAS.into_iter().map(|(verb, _)| verb)
}

/// The schema of the object that a command prints with `--json`; `None` for a command that is not one of [`verbs`].
#[must_use]
pub fn schema(verb: &str) -> Option<Value> {
    SCHEMAS.into_iter().find(|(known, _)| *known == verb).map(|(_, of)| of())
}
