//! The nearest events of a motion: one row for each number and direction.

use super::Table;
use crate::json::margins::{EndObject, ParameterObject};
use crate::number::Number;

/// The table of `vibro margins`. Without an event up to the limit of the range, the last six cells are empty.
#[must_use]
pub fn table(margins: Vec<ParameterObject<'_>>) -> Table<'_> {
    let rows = margins.into_iter().flat_map(|of| of.ends().map(|(direction, end)| row(&of, direction, end)));
    Table::new("parameter,value,direction,limit,at,distance,relative,event,before,after".to_owned(), rows)
}

fn row(of: &ParameterObject<'_>, direction: &str, end: &EndObject<'_>) -> String {
    let cell = |value: Option<f64>| value.map_or_else(String::new, |value| Number(value).to_string());
    let begin = format!("{},{},{direction},{}", of.column, Number(of.value), Number(end.limit));
    let Some(event) = &end.event else { return format!("{begin},,,,,,") };
    let (at, distance, relative) = (cell(end.at), cell(end.distance), cell(end.relative));
    let (before, after) = (&event.fields.before, event.fields.after.as_deref().unwrap_or_default());
    format!("{begin},{at},{distance},{relative},{},{before},{after}", event.kind)
}
