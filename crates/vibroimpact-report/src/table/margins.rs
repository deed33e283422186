//! The nearest events of a motion: one row for each parameter and direction.

use super::Table;
use crate::Units;
use crate::json::event::Stops;
use crate::json::margins::ParameterObject;
use crate::number::Number;
use crate::varied::Varied;
use vibroimpact::verdict::System;
use vibroimpact_study::{MotionMargins, Solution};

const HEADER: &str = "parameter,value,direction,limit,at,distance,relative,event,before,after";

/// The table of `vibro margins`.
pub(crate) fn table<'a, S: System + Stops, V: Varied, P: Solution<System = S>>(
    found: &'a MotionMargins<S, V, P>,
    system: &'a S,
    units: Units,
) -> Table<'a> {
    let rows = found.parameters.iter().flat_map(move |margin| {
        both(margin.scope.parameter.column(&units), &ParameterObject::new(margin, system, &units))
    });
    Table::new(HEADER.to_owned(), rows)
}

/// The rows of a parameter. Without an event up to the limit of the range, the last six cells are empty.
fn both(name: &str, of: &ParameterObject<'_>) -> [String; 2] {
    let cell = |value: Option<f64>| value.map_or_else(String::new, |value| Number(value).to_string());
    [("down", &of.down), ("up", &of.up)].map(|(way, end)| {
        let begin = format!("{name},{},{way},{}", Number(of.value), Number(end.limit));
        let Some(event) = &end.event else { return format!("{begin},,,,,,") };
        let (at, distance, relative) = (cell(end.at), cell(end.distance), cell(end.relative));
        let (before, after) = (&event.fields.before, event.fields.after.as_deref().unwrap_or_default());
        format!("{begin},{at},{distance},{relative},{},{before},{after}", event.kind)
    })
}
