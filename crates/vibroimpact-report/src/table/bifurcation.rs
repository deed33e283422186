//! A bifurcation diagram: the rows of its orbit diagram, then one row for each impact or state of each point of its branches.

use super::{Table, diagram};
use crate::branch_quantity::BranchQuantity;
use crate::figure::tracks::Followed as What;
use crate::json::event::{Stops, side};
use crate::number::Number;
use crate::{Asked, ShownValue, Units, Varied};
use vibroimpact::continuation::SolutionPoint;
use vibroimpact::continuation::machine;
use vibroimpact::events::Event;
use vibroimpact::machine::Machine;
use vibroimpact::orbit::CyclePoint;
use vibroimpact::verdict::Stability;
use vibroimpact_study::diagram::{Diagram, Show};
use vibroimpact_study::{Followed, PlanError};

/// A point of a branch of any system.
struct Row {
    value: f64,
    stability: Stability,
    label: String,
    event: &'static str,
    /// The cells of each impact, state or value of the orbit that is shown.
    shown: Vec<String>,
}

/// The rows of the orbit diagram, then those of branches.
fn written<V: Varied, S: ShownValue>(
    behind: &Diagram<V, S>,
    system: &impl Stops,
    units: &Units,
    branches: impl Iterator<Item = Vec<Row>>,
) -> Result<Table<'static>, PlanError> {
    let simulated = diagram::table(behind, system, *units)?;
    let header = format!("{},label,event", simulated.header);
    let mut rows: Vec<String> = simulated.rows.map(|row| format!("{row},,")).collect();
    let cut = behind.plan.cut();
    for (number, points) in branches.enumerate() {
        for Row { value, stability, label, event, shown } in points {
            let values = cut.names().zip(cut.values(value));
            let values: String = values.map(|(name, value)| format!("{},", Number(value * name.unit(units)))).collect();
            let row = |cells| format!("{values}branch {},{stability},{cells},{label},{event}", number + 1);
            rows.extend(shown.iter().map(row));
        }
    }
    Ok(Table::new(header, rows.into_iter()))
}

/// The table of `vibro diagram --branches`: the columns of the orbit diagram, and the label and the event of points of branches,
/// which are empty for points from simulation. Of branches, `sweep` has the number, and `kind` is `stable`, `neutral` or `unstable`.
/// Solutions that are not admissible are left out.
///
/// # Errors
/// [`PlanError`] if a value of the parameter overflows in these units.
pub fn table(behind: &Diagram, followed: &[Followed], asked: &Asked) -> Result<Table<'static>, PlanError> {
    let cut = behind.plan.cut();
    let oscillator = |value: f64| cut.oscillator(&asked.system, value).ok();
    let branches = followed.iter().map(|branch| {
        let points = branch.points.iter().filter(|point| point.physical);
        let row = |point: &SolutionPoint| {
            let units = asked.units.at(cut.vary, point.value);
            let state = |(v, x): (f64, f64)| format!("{},{}", Number(x * units.length()), Number(v * units.velocity()));
            let impact = |of: &CyclePoint| {
                let (at, phase) = (side(of.state.side), Number(of.state.phase));
                format!("{at},{phase},{}", Number(of.state.velocity * units.velocity()))
            };
            Row {
                value: point.value,
                stability: point.cycle.stability(),
                label: point.cycle.label.to_string(),
                event: point.event.map_or("", |event| event.name()),
                shown: match behind.plan.show {
                    Show::Strobe => What::Position(&oscillator).list(point).into_iter().map(state).collect(),
                    Show::Velocity | Show::Quantity(_) => point.cycle.points.iter().map(impact).collect(),
                },
            }
        };
        points.map(row).collect()
    });
    written(behind, &asked.system, &asked.units, branches)
}

/// The table of `vibro diagram --machine --branches`, in the same way: one row for each closing of each point of a branch, or for
/// the quantity that is shown.
///
/// # Errors
/// As [`table`].
pub fn of_machine(
    behind: &Diagram<String, String>,
    branches: &[Vec<machine::SolutionPoint>],
    machine: &Machine,
    quantity: Option<&BranchQuantity<'_>>,
) -> Result<Table<'static>, PlanError> {
    let row = |point: &machine::SolutionPoint| {
        let closing =
            |event: &Event| format!("{},{},{}", machine.name_of(event.place), Number(event.phase), Number(event.speed));
        let events = point.cycle.events.iter().filter(|event| event.closes());
        Row {
            value: point.value,
            stability: point.cycle.stability(),
            label: point.cycle.label.to_string(),
            event: point.event.map_or("", |event| event.name()),
            shown: match quantity {
                Some(quantity) => vec![Number(quantity.at(point)).to_string()],
                None => events.map(closing).collect(),
            },
        }
    };
    let branches = branches.iter().map(|points| points.iter().map(row).collect());
    written(behind, machine, &Units::default(), branches)
}
