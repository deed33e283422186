//! An orbit diagram: one row for each point, and with branches one for each impact or state of each of their points.

use super::Table;
use crate::figure::tracks::Shown;
use crate::json::branch::BranchObject;
use crate::json::event::Stops;
use crate::number::Number;
use crate::units::shown;
use crate::{ShownValue, Units, Varied};
use vibroimpact_study::PlanError;
use vibroimpact_study::diagram::{Diagram, DiagramPoint, DiagramStep, MotionKind, Sweep};

/// The table of `vibro diagram`: what varies, exactly as in the question, sweep, kind, and what is shown. A motion without points
/// has one row with empty cells.
///
/// # Errors
/// [`PlanError`] if a value of the parameter overflows in these units.
pub fn table<'a, V: Varied, S: ShownValue>(
    found: &'a Diagram<V, S>,
    system: &'a impl Stops,
    units: Units,
) -> Result<Table<'a>, PlanError> {
    let (plan, cut) = (&found.plan, found.plan.cut());
    let over = shown(&plan.over, plan.vary.unit(&units))?;
    let second = cut.also.map(|also| also.parameter.unit(&units));
    let none = ",".repeat(plan.show.columns(&units).len());
    let rows = found.steps.iter().flat_map(move |step| {
        let value = over.at(step.index as usize);
        // the value of the second number, without rounding by a conversion of the first
        let also = second.zip(plan.values(step.index).nth(1)).map(|(unit, value)| format!("{},", Number(value * unit)));
        let head = format!("{},{}{}", Number(value), also.unwrap_or_default(), sweep(step.sweep));
        let alone = step.points.is_empty().then(|| format!("{head},{}{none}", kind(step.kind)));
        let there = plan.vary.units_at(&units, value);
        let units = (there, plan.show.quantity_unit(&there));
        let points = step.points.iter().map(move |point| format!("{head},{}", row(step, point, system, &units)));
        alone.into_iter().chain(points)
    });
    Ok(Table::new(columns(found, &units).join(","), rows))
}

/// The columns of the table.
pub(crate) fn columns<V: Varied, S: ShownValue>(found: &Diagram<V, S>, units: &Units) -> Vec<String> {
    let cut = found.plan.cut();
    let varied = cut.names().map(|number| number.column(units).to_owned());
    varied.chain(["sweep", "kind"].map(str::to_owned)).chain(found.plan.show.columns(units)).collect()
}

/// Kind and numbers of a point, with the unit of a quantity.
fn row(step: &DiagramStep, point: &DiagramPoint, system: &impl Stops, (units, quantity): &(Units, f64)) -> String {
    let closing = |kind: &str, stop: usize, phase: f64, speed: f64| {
        format!("{kind},{},{},{}", system.name_of_stop(stop), Number(phase), Number(speed * units.velocity()))
    };
    match *point {
        DiagramPoint::Impact { stop, phase, speed } => closing("impact", stop, phase, speed),
        DiagramPoint::Chatter { stop, phase } => closing("chatter", stop, phase, 0.0),
        DiagramPoint::State { x, v } => {
            let v = v.map_or_else(String::new, |v| format!(",{}", Number(v * units.velocity())));
            format!("{},{}{v}", kind(step.kind), Number(x * units.length()))
        }
        DiagramPoint::Value(value) => {
            let value = value * quantity;
            // a quantity that is not defined in the frame of these units is an empty cell
            let cell = if value.is_finite() { Number(value).to_string() } else { String::new() };
            format!("{},{cell}", kind(step.kind))
        }
    }
}

fn sweep(sweep: Sweep) -> String {
    match sweep {
        Sweep::Up => "up".into(),
        Sweep::Down => "down".into(),
        Sweep::Start(k) => format!("start {}", k + 1),
    }
}

const fn kind(kind: MotionKind) -> &'static str {
    match kind {
        MotionKind::Impacts => "impact",
        MotionKind::NoImpact => "none",
        MotionKind::Stuck => "stuck",
        MotionKind::Undecided => "undecided",
    }
}

/// The table of `vibro diagram --branches`: the columns of the orbit diagram, and the label and the event of points of branches,
/// which are empty for points from simulation. Of branches, `sweep` has the number, and `kind` is `stable`, `neutral` or `unstable`.
/// There is one row for each closing or state of each point of a branch, or for the quantity that is shown. Solutions that are not
/// admissible are left out.
pub(crate) fn with_branches<V: Varied, S: ShownValue>(
    (behind, units): (&Diagram<V, S>, &Units),
    system: &impl Stops,
    branches: &[BranchObject<'_>],
    shown: Shown,
) -> Result<Table<'static>, PlanError> {
    let simulated = table(behind, system, *units)?;
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
