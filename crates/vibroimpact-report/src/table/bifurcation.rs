//! A bifurcation diagram: the rows of its orbit diagram, then one row for each impact or state of each point of its branches.

use super::{Table, diagram};
use crate::figure::tracks::Shown;
use crate::json::branch::BranchObject;
use crate::json::event::Stops;
use crate::number::Number;
use crate::{ShownValue, Units, Varied};
use vibroimpact_study::PlanError;
use vibroimpact_study::diagram::Diagram;

/// The table of `vibro diagram --branches`: the columns of the orbit diagram, and the label and the event of points of branches,
/// which are empty for points from simulation. Of branches, `sweep` has the number, and `kind` is `stable`, `neutral` or `unstable`.
/// There is one row for each closing or state of each point of a branch, or for the quantity that is shown. Solutions that are not
/// admissible are left out.
pub(crate) fn table<V: Varied, S: ShownValue>(
    (behind, units): (&Diagram<V, S>, &Units),
    system: &impl Stops,
    branches: &[BranchObject<'_>],
    shown: Shown,
) -> Result<Table<'static>, PlanError> {
    let simulated = diagram::table(behind, system, *units)?;
    let header = format!("{},label,event", simulated.header);
    let mut rows: Vec<String> = simulated.rows.map(|row| format!("{row},,")).collect();
    for (number, branch) in branches.iter().enumerate() {
        for (k, point) in branch.points.iter().enumerate().filter(|(_, point)| point.admissible) {
            let values: String = point.values().iter().map(|value| format!("{},", Number(*value))).collect();
            let event = branch.event_at(k).map_or("", |event| event.kind);
            let head = format!("{values}branch {},{}", number + 1, point.stability);
            rows.extend(shown.cells(point).into_iter().map(|cells| format!("{head},{cells},{},{event}", point.label)));
        }
    }
    Ok(Table::new(header, rows.into_iter()))
}
