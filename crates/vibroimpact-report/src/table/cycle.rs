//! The columns of a cycle of any system: its multipliers, its drift and its closings.

use super::quantities::finite;
use crate::Units;
use crate::json::event::{EventObject, closings};
use crate::number::Number;
use serde_json::{Map, Value};
use vibroimpact::QuantityKind;
use vibroimpact::machine::Machine;

/// Which columns a table has.
pub(super) struct Columns {
    multipliers: usize,
    speeds: String,
    /// The coordinates of a machine that can be translated.
    drift: Vec<String>,
    /// Whether there is no forcing: with it the label says the period.
    period: bool,
}

/// The names of the columns of so many multipliers.
pub(super) fn numbered(multipliers: usize) -> impl Iterator<Item = String> {
    (1..=multipliers).flat_map(|k| [format!("multiplier_{k}_re"), format!("multiplier_{k}_im")])
}

/// Real and imaginary parts, each after a comma. A number that is not finite, or of a multiplier that is not there, is an empty
/// cell.
pub(super) fn parts(multipliers: &[[f64; 2]], columns: usize) -> String {
    (0..columns).map(|k| finite(multipliers.get(k).unwrap_or(&[f64::NAN; 2]))).collect()
}

/// The names of the columns of the drift.
pub(super) fn drifts(machine: &Machine) -> impl Iterator<Item = String> {
    machine.parts().coordinates.iter().map(|name| format!("drift.{name}"))
}

impl Columns {
    /// Those of an oscillator in these units, or of a machine, with its drift where it `drifts`.
    pub(super) fn new(machine: Option<&Machine>, units: &Units, drifts: bool) -> Self {
        Self {
            multipliers: machine.map_or(2, |machine| 2 * machine.n()),
            speeds: units.column("speeds", QuantityKind::Velocity),
            drift: machine.filter(|_| drifts).into_iter().flat_map(self::drifts).collect(),
            period: machine.is_some_and(|machine| machine.period().is_none()),
        }
    }

    /// The names, separated by commas.
    pub(super) fn names(&self) -> String {
        let closings = ["phases".to_owned(), self.speeds.clone(), "stops".to_owned()];
        let period = self.period.then(|| "period".to_owned());
        let all = numbered(self.multipliers).chain(self.drift.iter().cloned()).chain(closings).chain(period);
        all.collect::<Vec<_>>().join(",")
    }

    /// The cells of a cycle with these events and this period, each after a comma. Phases, speeds and stops are lists with blanks
    /// between. The drift is by the coordinates of a machine that can be translated.
    pub(super) fn cells(
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
