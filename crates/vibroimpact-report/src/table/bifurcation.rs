//! A bifurcation diagram: the rows of its orbit diagram, then one row for each impact or state of each point of its branches.

use super::{Table, diagram};
use crate::figure::tracks::Shown;
use crate::json::event::Stops;
use crate::number::Number;
use crate::solutions::PointView;
use crate::{ShownValue, Units, Varied};
use vibroimpact_study::PlanError;
use vibroimpact_study::diagram::Diagram;

/// The table of `vibro diagram --branches`: the columns of the orbit diagram, and the label and the event of points of branches,
/// which are empty for points from simulation. Of branches, `sweep` has the number, and `kind` is `stable`, `neutral` or `unstable`.
/// There is one row for each closing or state of each point of a branch, or for the quantity that is shown. Solutions that are not
/// admissible are left out.
///
/// # Errors
/// [`PlanError`] if a value of the parameter overflows in these units.
pub(crate) fn table<V: Varied, S: ShownValue>(
    (behind, units): (&Diagram<V, S>, &Units),
    system: &impl Stops,
    branches: &[Vec<PointView<'_>>],
    shown: Shown<'_>,
) -> Result<Table<'static>, PlanError> {
    let simulated = diagram::table(behind, system, *units)?;
    let header = format!("{},label,event", simulated.header);
    let mut rows: Vec<String> = simulated.rows.map(|row| format!("{row},,")).collect();
    for (number, points) in branches.iter().enumerate() {
        for point in points.iter().filter(|point| point.admissible) {
            let values: String = point.values.iter().map(|value| format!("{},", Number(*value))).collect();
            let (label, stability) = (point.cycle.label(), point.cycle.stability());
            let row =
                |cells| format!("{values}branch {},{stability},{cells},{label},{}", number + 1, point.event_name());
            rows.extend(cells(point, shown).into_iter().map(row));
        }
    }
    Ok(Table::new(header, rows.into_iter()))
}

/// The cells of each closing, state or value that is shown of a point.
fn cells(point: &PointView<'_>, shown: Shown<'_>) -> Vec<String> {
    let cycle = &point.cycle;
    match shown {
        Shown::Quantity(quantity) => vec![Number(quantity.at(point)).to_string()],
        Shown::Strobes => cycle.strobes().into_iter().map(|(v, x)| format!("{},{}", Number(x), Number(v))).collect(),
        Shown::Speeds => {
            let closings = cycle.closings().into_iter();
            closings.map(|at| format!("{},{},{}", at.stop, Number(at.phase), Number(at.speed))).collect()
        }
    }
}
