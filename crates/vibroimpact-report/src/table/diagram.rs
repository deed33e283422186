//! An orbit diagram: one row for each point.

use super::Table;
use crate::Units;
use crate::json::event::side;
use crate::number::Number;
use crate::units::shown;
use vibroimpact::machine::Machine;
use vibroimpact_study::diagram::{Diagram, DiagramPoint, DiagramStep, MotionKind, Show, Sweep};
use vibroimpact_study::{MachineDiagram, MachineDiagramPoint, PlanError, Values};

/// The table of `vibro diagram`.
///
/// # Errors
/// [`PlanError`] if a value of the parameter overflows in these units.
pub fn table(found: &Diagram, units: Units) -> Result<Table<'_>, PlanError> {
    let over = shown(&found.plan.over, units.of(found.plan.vary))?;
    Ok(Table::new(columns(found, &units).join(","), rows(found, over, units)))
}

/// The columns of the table.
#[must_use]
pub fn columns(found: &Diagram, units: &Units) -> Vec<String> {
    let quantity;
    let shown: &[&str] = match (found.plan.show, units.si) {
        (Show::Velocity, false) => &["sweep", "kind", "stop", "phase", "speed"],
        (Show::Velocity, true) => &["sweep", "kind", "stop", "phase", "speed_m_per_s"],
        (Show::Strobe, false) => &["sweep", "kind", "x", "v"],
        (Show::Strobe, true) => &["sweep", "kind", "x_m", "v_m_per_s"],
        (Show::Quantity(of), _) => {
            quantity = units.column(of.name(), of.kind());
            &["sweep", "kind", &quantity]
        }
    };
    let parameters = found.plan.cut().parameters().map(|parameter| units.column_of(parameter));
    parameters.chain(shown.iter().copied()).map(str::to_owned).collect()
}

/// One row for each point; a motion without points has one row with empty cells. Values of the parameter are exactly
/// the numbers of the question.
fn rows(found: &Diagram, over: Values, units: Units) -> impl Iterator<Item = String> + '_ {
    let none = match found.plan.show {
        Show::Velocity => ",,",
        Show::Strobe => ",",
        Show::Quantity(_) => "",
    };
    found.steps.iter().flat_map(move |step| {
        // the value of the second parameter, without rounding by a conversion of the first
        let also = found.plan.values(step.index).nth(1);
        let also = also.map_or_else(String::new, |(p, value)| format!(",{}", Number(value * units.of(p))));
        let head = format!("{}{also},{}", Number(over.at(step.index as usize)), sweep(step.sweep));
        let alone = step.points.is_empty().then(|| format!("{head},{},{none}", kind(step.kind)));
        let units = units.at(found.plan.vary, over.at(step.index as usize));
        let points = step.points.iter().map(move |point| format!("{head},{}", row(step, point, units)));
        alone.into_iter().chain(points)
    })
}

fn row(step: &DiagramStep, point: &DiagramPoint, units: Units) -> String {
    match point {
        DiagramPoint::Impact { phase, velocity, side: at } => {
            format!("impact,{},{},{}", side(*at), Number(*phase), Number(velocity * units.velocity()))
        }
        DiagramPoint::Chatter { phase, side: at } => format!("chatter,{},{},0", side(*at), Number(*phase)),
        DiagramPoint::State { x, v } => {
            format!("{},{},{}", kind(step.kind), Number(x * units.length()), Number(v * units.velocity()))
        }
        DiagramPoint::Value { quantity, value } => {
            let value = value * units.of_quantity(*quantity);
            // a quantity that is not defined in the frame of these units is an empty cell
            let cell = if value.is_finite() { Number(value).to_string() } else { String::new() };
            format!("{},{cell}", kind(step.kind))
        }
    }
}

/// The table of `vibro diagram --machine`: the numbers that vary, sweep, kind, and for closings stop, phase and speed, or else the value at
/// phase 0. A motion without points has one row with empty cells.
#[must_use]
pub fn of_machine<'a>(found: &'a MachineDiagram, machine: &'a Machine) -> Table<'a> {
    let plan = &found.plan;
    let closings = plan.shows_closings();
    let shown: &[&str] = if closings { &["stop", "phase", "speed"] } else { &[&plan.show] };
    let header = plan.cut().paths().chain(["sweep", "kind"]).chain(shown.iter().copied()).collect::<Vec<_>>().join(",");
    let rows = found.steps.iter().flat_map(move |step| {
        let values: String = plan.values(step.index).map(|value| format!("{},", Number(value))).collect();
        let head = format!("{values}{},{}", sweep(step.sweep), kind(step.kind));
        let alone = step.points.is_empty().then(|| format!("{head}{}", if closings { ",,," } else { "," }));
        let row = move |point: &MachineDiagramPoint| {
            let of_stop = point.stop.map(|stop| format!(",{},{}", machine.name_of(stop), Number(point.phase)));
            format!("{head}{},{}", of_stop.unwrap_or_default(), Number(point.value))
        };
        alone.into_iter().chain(step.points.iter().map(row))
    });
    Table::new(header, rows)
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
