//! The table of branches, and the columns of a cycle of any system: its multipliers, its drift and its closings.

use super::Table;
use crate::json::branch::{BranchAnswer, PointObject};
use crate::json::event::{EventObject, closings, fastest};
use crate::number::Number;
use crate::{Units, Varied};
use serde_json::{Map, Value};
use vibroimpact::QuantityKind;
use vibroimpact::machine::Machine;
use vibroimpact_study::Cut;

/// The table of `vibro branch`; of a machine that can be translated with the drift, and without forcing with the period.
pub(crate) fn branches<'a, V: Varied>(
    answer: BranchAnswer<'a>,
    machine: Option<&Machine>,
    (cut, units): (&Cut<V>, &Units),
) -> Table<'a> {
    let mut points = answer.branches.iter().flat_map(|branch| &branch.points);
    let columns = Columns::new(machine, units, points.any(|point| point.drift.is_some()));
    let varied: Vec<&str> = cut.names().map(|name| name.column(units)).collect();
    let (varied, speed) = (varied.join(","), units.column("fastest", QuantityKind::Velocity));
    let header = format!("branch,{varied},label,admissible,stable,stability,event,stop,{speed},{}", columns.names());
    let rows = answer.branches.into_iter().enumerate().flat_map(move |(number, branch)| {
        let points = branch.points.iter().enumerate();
        let rows =
            points.map(|(k, point)| format!("{},{}", number + 1, row_of_branch(point, branch.mark_at(k), &columns)));
        rows.collect::<Vec<_>>()
    });
    Table::new(header, rows)
}

fn row_of_branch(point: &PointObject<'_>, (kind, stop): (&str, &str), columns: &Columns) -> String {
    let values: String = point.values().iter().map(|value| format!("{},", Number(*value))).collect();
    let PointObject { label, admissible, stable, stability, .. } = point;
    let cells = columns.cells((&point.cycle, point.period), &point.multipliers, point.drift.as_ref());
    let fastest = Number(fastest(&point.cycle));
    format!("{values}{label},{admissible},{stable},{stability},{kind},{stop},{fastest}{cells}")
}

/// Numbers, each after a comma; empty where they are not defined or infinite.
pub(crate) fn finite(values: &[f64]) -> String {
    let cell = |value: &f64| if value.is_finite() { format!(",{}", Number(*value)) } else { ",".to_owned() };
    values.iter().map(cell).collect()
}

/// Which columns a table has.
pub(crate) struct Columns {
    multipliers: usize,
    speeds: String,
    /// The coordinates of a machine that can be translated.
    drift: Vec<String>,
    /// Whether there is no forcing: with it the label says the period.
    period: bool,
}

/// The names of the columns of so many multipliers.
pub(crate) fn numbered(multipliers: usize) -> impl Iterator<Item = String> {
    (1..=multipliers).flat_map(|k| [format!("multiplier_{k}_re"), format!("multiplier_{k}_im")])
}

/// Real and imaginary parts, each after a comma. A number that is not finite, or of a multiplier that is not there, is an empty
/// cell.
pub(crate) fn parts(multipliers: &[[f64; 2]], columns: usize) -> String {
    (0..columns).map(|k| finite(multipliers.get(k).unwrap_or(&[f64::NAN; 2]))).collect()
}

/// The names of the columns of the drift.
pub(crate) fn drifts(machine: &Machine) -> impl Iterator<Item = String> {
    machine.parts().coordinates.iter().map(|name| format!("drift.{name}"))
}

impl Columns {
    /// Those of an oscillator in these units, or of a machine, with its drift where it `drifts`.
    pub(crate) fn new(machine: Option<&Machine>, units: &Units, drifts: bool) -> Self {
        Self {
            multipliers: machine.map_or(2, |machine| 2 * machine.n()),
            speeds: units.column("speeds", QuantityKind::Velocity),
            drift: machine.filter(|_| drifts).into_iter().flat_map(self::drifts).collect(),
            period: machine.is_some_and(|machine| machine.period().is_none()),
        }
    }

    /// The names, separated by commas.
    pub(crate) fn names(&self) -> String {
        let closings = ["phases".to_owned(), self.speeds.clone(), "stops".to_owned()];
        let period = self.period.then(|| "period".to_owned());
        let all = numbered(self.multipliers).chain(self.drift.iter().cloned()).chain(closings).chain(period);
        all.collect::<Vec<_>>().join(",")
    }

    /// The cells of a cycle with these events and this period, each after a comma. Phases, speeds and stops are lists with blanks
    /// between. The drift is by the coordinates of a machine that can be translated.
    pub(crate) fn cells(
        &self,
        (events, period): (&[EventObject<'_>], f64),
        multipliers: &[[f64; 2]],
        drift: Option<&Map<String, Value>>,
    ) -> String {
        let list = |text: &dyn Fn(&EventObject<'_>) -> String| {
            format!(",{}", closings(events).map(text).collect::<Vec<_>>().join(" "))
        };
        let mut cells = parts(multipliers, self.multipliers);
        let drift = drift.into_iter().flat_map(Map::values).filter_map(Value::as_f64).take(self.drift.len());
        drift.for_each(|drift| cells.push_str(&format!(",{}", Number(drift))));
        // without forcing there is no phase
        cells.push_str(&list(&|closing| Number(closing.phase.unwrap_or(0.0)).to_string()));
        cells.push_str(&list(&|closing| Number(closing.speed).to_string()));
        cells.push_str(&list(&|closing| closing.stop.to_owned()));
        if self.period {
            cells.push_str(&format!(",{}", Number(period)));
        }
        cells
    }
}
