//! A map: one row for each motion at each point.

use super::Table;
use super::orbits::finite;
use super::remarks::Remarks;
use crate::json::event::Stops;
use crate::number::Number;
use crate::units::shown;
use crate::{FieldName, Units, Varied};
use vibroimpact_study::{PlanError, RegionMap, Share};

/// The table of `vibro map`: what varies, in the units and with exactly the numbers of the question, the label, its share of the
/// starts, and the quantities that the plan asks for; with `remarked` also what stops and events say more of the label. Of points
/// that are no grid their number comes first, and there is no share.
pub(crate) fn table<'a, V: Varied, F: FieldName>(
    found: &'a RegionMap<V, F>,
    system: &'a impl Stops,
    (units, remarked): (Units, bool),
) -> Result<Table<'a>, PlanError> {
    let motions = found.motions().filter(|_| remarked);
    let remarks = Remarks::of(motions.map(|motion| (motion.stops.clone(), motion.seen_events)));
    let grid = found.columns.is_empty();
    let axes = &found.axes;
    let values = axes.iter().map(|axis| Ok(shown(&axis.over, axis.vary.unit(&units))?.all()));
    let values = values.collect::<Result<Vec<Vec<f64>>, PlanError>>()?;
    let rows = found.points.iter().enumerate().flat_map(move |(k, motions)| {
        let mut place = if grid { String::new() } else { format!("{},", k + 1) };
        let mut rest = k;
        for values in &values {
            place.push_str(&format!("{},", Number(values[rest % values.len()])));
            rest /= values.len();
        }
        for column in &found.columns {
            place.push_str(&format!("{},", Number(column.values[k] * column.vary.unit(&units))));
        }
        let there = units.at_point(axes, k);
        let row = |motion: &Share| {
            let share = if grid { format!(",{}", Number(motion.share)) } else { String::new() };
            let remarks = remarks.cells(system, &(motion.stops.clone(), motion.seen_events));
            let value =
                |(k, field): (usize, &F)| motion.quantities.get(k).map_or(f64::NAN, |value| value * field.unit(&there));
            let quantities: Vec<f64> = found.fields.iter().enumerate().map(value).collect();
            format!("{place}{}{share}{remarks}{}", motion.label, finite(&quantities))
        };
        let mut rows: Vec<String> = motions.iter().map(row).collect();
        if rows.is_empty() && !grid {
            // numbers that are not allowed, or a start beyond a stop
            let empty = ",".repeat(remarks.heads().count() + found.fields.len());
            rows.push(format!("{place}refused{empty}"));
        }
        rows
    });
    let mut header: Vec<String> = if grid { Vec::new() } else { vec!["sample".to_owned()] };
    header.extend(found.varied().map(|vary| vary.column(&units).to_owned()));
    let own = ["label", "share"].into_iter().take(if grid { 2 } else { 1 });
    header.extend(own.chain(remarks.heads()).map(str::to_owned));
    header.extend(found.fields.iter().map(|field| field.column(&units)));
    Ok(Table::new(header.join(","), rows))
}
