//! The nearest events of a motion: one row for each parameter and direction.

use super::Table;
use crate::Units;
use crate::number::Number;
use vibroimpact_study::{EventRecord, MachineMargins, MarginEnd, MotionMargins, ParameterMargin};

const HEADER: &str = "parameter,value,direction,limit,at,distance,relative,event,before,after";

/// The table of `vibro margins --machine`.
#[must_use]
pub fn of_machine(found: &MachineMargins) -> Table<'_> {
    let rows = found.numbers.iter().flat_map(|number| {
        number.ends().map(|(way, limit, event)| {
            let begin = format!("{},{},{way},{}", number.path, Number(number.value), Number(limit));
            let Some((event, kind)) = event.and_then(|event| Some((event, event.point.event?))) else {
                return format!("{begin},,,,,,");
            };
            let (at, distance) = (event.point.value, event.point.value - number.value);
            let relative =
                if number.value == 0.0 { String::new() } else { Number(distance / number.value.abs()).to_string() };
            let (before, after) = (event.point.cycle.label, event.after.as_deref().unwrap_or_default());
            format!("{begin},{},{},{relative},{},{before},{after}", Number(at), Number(distance), kind.name())
        })
    });
    Table::new(HEADER.to_owned(), rows)
}

/// The table of `vibro margins`.
#[must_use]
pub fn table(found: &MotionMargins, units: Units) -> Table<'_> {
    let rows = found.parameters.iter().flat_map(move |margin| {
        [("down", &margin.down), ("up", &margin.up)].map(|(way, end)| row(margin, way, end, &units))
    });
    Table::new(HEADER.to_owned(), rows)
}

/// One row. Without an event up to the limit of the range, the last six cells are empty.
fn row(margin: &ParameterMargin, way: &str, end: &MarginEnd, units: &Units) -> String {
    let scope = &margin.scope;
    let (unit, name) = (units.of(scope.parameter), units.column_of(scope.parameter));
    let limit = if way == "down" { scope.low } else { scope.high };
    let begin = format!("{name},{},{way},{}", Number(scope.value * unit), Number(limit * unit));
    let Some((point, event)) = end.point.as_ref().and_then(|point| Some((point, point.event?))) else {
        return format!("{begin},,,,,,");
    };
    let record = EventRecord::of(point, &event);
    let relative = end.relative(scope).map_or_else(String::new, |relative| Number(relative).to_string());
    format!(
        "{begin},{},{},{relative},{},{},{}",
        Number(end.value * unit),
        Number(end.distance(scope) * unit),
        record.kind,
        record.label_before,
        record.label_after.unwrap_or_default()
    )
}
