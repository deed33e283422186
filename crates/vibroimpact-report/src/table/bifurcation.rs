//! A bifurcation diagram: the rows of its orbit diagram, then one row for each impact or state of each point of its branches.

use super::{Table, diagram};
use crate::Asked;
use crate::branch_quantity::BranchQuantity;
use crate::figure::tracks::Followed as What;
use crate::json::event::side;
use crate::number::Number;
use vibroimpact::continuation::MachinePoint;
use vibroimpact::machine::Machine;
use vibroimpact_study::diagram::{Diagram, Show};
use vibroimpact_study::{Followed, MachineDiagram, PlanError};

/// The table of `vibro diagram --branches`: the columns of the orbit diagram, and the label and the event of points of branches,
/// which are empty for points from simulation. Of branches, `sweep` has the number, and `kind` is `stable`, `neutral` or `unstable`.
/// Solutions that are not admissible are left out.
///
/// # Errors
/// [`PlanError`] if a value of the parameter overflows in these units.
pub fn table(behind: &Diagram, followed: &[Followed], asked: &Asked) -> Result<Table<'static>, PlanError> {
    let simulated = diagram::table(behind, asked.units)?;
    let header = format!("{},label,event", simulated.header);
    let mut rows: Vec<String> = simulated.rows.map(|row| format!("{row},,")).collect();
    let cut = behind.plan.cut();
    let oscillator = |value: f64| cut.oscillator(&asked.system, value).ok();
    for (number, branch) in followed.iter().enumerate() {
        for point in branch.points.iter().filter(|point| point.physical) {
            let units = asked.units.at(cut.vary, point.value);
            let values = cut.values(point.value).map(|(parameter, value)| Number(value * asked.units.of(parameter)));
            let values = values.map(|value| value.to_string()).collect::<Vec<_>>().join(",");
            let kind = point.cycle.stability();
            let head = format!("{values},branch {},{kind}", number + 1);
            let tail = format!("{},{}", point.cycle.label, point.event.map_or("", |event| event.name()));
            match behind.plan.show {
                Show::Strobe => {
                    for (v, x) in What::Position(&oscillator).list(point) {
                        let (x, v) = (Number(x * units.length()), Number(v * units.velocity()));
                        rows.push(format!("{head},{x},{v},{tail}"));
                    }
                }
                Show::Velocity | Show::Quantity(_) => {
                    for impact in &point.cycle.points {
                        let (at, phase) = (side(impact.state.side), Number(impact.state.phase));
                        let velocity = Number(impact.state.velocity * units.velocity());
                        rows.push(format!("{head},{at},{phase},{velocity},{tail}"));
                    }
                }
            }
        }
    }
    Ok(Table::new(header, rows.into_iter()))
}

/// The table of `vibro diagram --machine --branches`, in the same way: one row for each closing of each point of a branch, or for
/// the quantity that is shown.
#[must_use]
pub fn of_machine(
    behind: &MachineDiagram,
    branches: &[Vec<MachinePoint>],
    machine: &Machine,
    quantity: Option<&BranchQuantity<'_>>,
) -> Table<'static> {
    let simulated = diagram::of_machine(behind, machine);
    let header = format!("{},label,event", simulated.header);
    let mut rows: Vec<String> = simulated.rows.map(|row| format!("{row},,")).collect();
    let cut = behind.plan.cut();
    for (number, points) in branches.iter().enumerate() {
        for point in points {
            let values: String = cut.values(point.value).map(|value| format!("{},", Number(value))).collect();
            let kind = point.cycle.stability();
            let head = format!("{values}branch {},{kind}", number + 1);
            let tail = format!("{},{}", point.cycle.label, point.event.map_or("", |event| event.name()));
            match quantity {
                Some(quantity) => rows.push(format!("{head},{},{tail}", Number(quantity.at(point)))),
                None => {
                    for event in point.cycle.events.iter().filter(|event| event.closes()) {
                        let (stop, phase) = (machine.name_of(event.place), Number(event.phase));
                        rows.push(format!("{head},{stop},{phase},{},{tail}", Number(event.speed)));
                    }
                }
            }
        }
    }
    Table::new(header, rows.into_iter())
}
