//! The JSON schema of the answer to each command, the same for every system.

use super::branch::BranchAnswer;
use super::{Document, JsonSchema};
use crate::ContactAnswer;
use crate::task::attractors::AttractorsAnswer;
use crate::task::basin::BasinAnswer;
use crate::task::curve::CurveAnswer;
use crate::task::diagram::DiagramAnswer;
use crate::task::edge::EdgeAnswer;
use crate::task::lyapunov::LyapunovAnswer;
use crate::task::map::MapAnswer;
use crate::task::margins::MarginsAnswer;
use crate::task::orbit::OrbitAnswer;
use crate::task::region::RegionAnswer;
use crate::task::response::ResponseAnswer;
use crate::task::settle::SettleAnswer;
use crate::task::simulate::SimulateAnswer;
use schemars::generate::SchemaSettings;
use serde_json::Value;

/// Makes a schema.
type Maker = fn() -> Value;

/// The commands whose answers have a schema, with its maker.
const SCHEMAS: [(&str, Maker); 16] = [
    ("simulate", of::<SimulateAnswer<'static>>),
    ("settle", of::<SettleAnswer<'static>>),
    ("attractors", of::<AttractorsAnswer<'static>>),
    ("orbit", of::<OrbitAnswer<'static>>),
    ("branch", of::<BranchAnswer<'static>>),
    ("curve", of::<CurveAnswer<'static>>),
    ("region", of::<RegionAnswer>),
    ("response", of::<ResponseAnswer<'static>>),
    ("margins", of::<MarginsAnswer<'static>>),
    ("edge", of::<EdgeAnswer<'static>>),
    ("lyapunov", of::<LyapunovAnswer<'static>>),
    ("diagram", of::<DiagramAnswer>),
    ("map", of::<MapAnswer>),
    ("basin", of::<BasinAnswer<'static>>),
    ("settle-many", of::<MapAnswer>),
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
