//! The nearest events of a motion: one row for each number and direction.

use super::Table;
use crate::json::branch::EventFields;
use crate::number::Number;
use crate::solutions::{MarginEndView, MarginView};

/// The table of `vibro margins`. Without an event up to the limit of the range, the last six cells are empty.
#[must_use]
pub fn table<'a>(margins: Vec<MarginView<'a>>) -> Table<'a> {
    let rows = margins.into_iter().flat_map(|of| of.ends.each_ref().map(|end| row(&of, end)));
    Table::new("parameter,value,direction,limit,at,distance,relative,event,before,after".to_owned(), rows)
}

fn row(of: &MarginView<'_>, end: &MarginEndView<'_>) -> String {
    let begin = format!("{},{},{},{}", of.column, Number(of.value), end.direction, Number(end.limit));
    let Some(nearest) = &end.nearest else { return format!("{begin},,,,,,") };
    let relative = nearest.relative.map_or_else(String::new, |value| Number(value).to_string());
    let EventFields { before, after, .. } = EventFields::new(&nearest.event);
    let (at, distance) = (Number(nearest.at), Number(nearest.distance));
    let (event, after) = (nearest.event.name(), after.unwrap_or_default());
    format!("{begin},{at},{distance},{relative},{event},{before},{after}")
}
