//! The columns of a cycle of any system: its multipliers, its drift and its closings.

use crate::Units;
use crate::json::event::side;
use crate::number::Number;
use std::borrow::Cow;
use vibroimpact::QuantityKind;
use vibroimpact::machine::Machine;
use vibroimpact::math::Multiplier;
use vibroimpact::orbit::Cycle;
use vibroimpact::orbit::machine;

/// Which columns a table has.
pub(super) struct Columns {
    multipliers: usize,
    speeds: String,
    /// The coordinates of a machine that can be translated.
    drift: Vec<String>,
    /// Whether there is no forcing: with it the label says the period.
    period: bool,
}

/// What the cells of a cycle say.
pub(super) struct Cells<'a> {
    multipliers: Cow<'a, [Multiplier]>,
    drift: &'a [f64],
    /// Phase, speed and stop of each closing.
    closings: Vec<(f64, f64, &'a str)>,
    period: f64,
}

/// The names of the columns of so many multipliers.
pub(super) fn numbered(multipliers: usize) -> impl Iterator<Item = String> {
    (1..=multipliers).flat_map(|k| [format!("multiplier_{k}_re"), format!("multiplier_{k}_im")])
}

/// Real and imaginary parts, each after a comma. A number that is not finite, or of a multiplier that is not there, is an empty
/// cell.
pub(super) fn parts(multipliers: &[Multiplier], columns: usize) -> String {
    let part = |x: f64| if x.is_finite() { format!(",{}", Number(x)) } else { ",".to_owned() };
    let both = |k: usize| multipliers.get(k).map_or_else(|| ",,".to_owned(), |of| part(of.re) + &part(of.im));
    (0..columns).map(both).collect()
}

/// The names of the columns of the drift.
pub(super) fn drifts(machine: &Machine) -> impl Iterator<Item = String> {
    machine.parts().coordinates.iter().map(|name| format!("drift.{name}"))
}

impl Columns {
    pub(super) fn of_oscillator(units: &Units) -> Self {
        let speeds = units.column("speeds", QuantityKind::Velocity);
        Self { multipliers: 2, speeds, drift: Vec::new(), period: false }
    }

    /// Those of a machine, with its drift where it `drifts`.
    pub(super) fn of_machine(machine: &Machine, drifts: bool) -> Self {
        Self {
            multipliers: 2 * machine.n(),
            speeds: "speeds".to_owned(),
            drift: self::drifts(machine).filter(|_| drifts).collect(),
            period: machine.period().is_none(),
        }
    }

    /// The names, separated by commas.
    pub(super) fn names(&self) -> String {
        let closings = ["phases".to_owned(), self.speeds.clone(), "stops".to_owned()];
        let period = self.period.then(|| "period".to_owned());
        let all = numbered(self.multipliers).chain(self.drift.iter().cloned()).chain(closings).chain(period);
        all.collect::<Vec<_>>().join(",")
    }

    /// The cells of a cycle, each after a comma. Phases, speeds and stops are lists with blanks between.
    pub(super) fn cells(&self, of: &Cells<'_>) -> String {
        let list = |text: &dyn Fn(&(f64, f64, &str)) -> String| {
            format!(",{}", of.closings.iter().map(text).collect::<Vec<_>>().join(" "))
        };
        let drift = of.drift.iter().take(self.drift.len()).map(|drift| format!(",{}", Number(*drift)));
        let mut cells = parts(&of.multipliers, self.multipliers) + &drift.collect::<String>();
        cells.push_str(&list(&|(phase, ..)| Number(*phase).to_string()));
        cells.push_str(&list(&|(_, speed, _)| Number(*speed).to_string()));
        cells.push_str(&list(&|(.., stop)| (*stop).to_owned()));
        if self.period {
            cells.push_str(&format!(",{}", Number(of.period)));
        }
        cells
    }
}

impl<'a> Cells<'a> {
    pub(super) fn of_oscillator(cycle: &'a Cycle, units: &Units) -> Self {
        let closings = cycle
            .points
            .iter()
            .map(|point| (point.state.phase, point.state.velocity * units.velocity(), side(point.state.side)));
        Self {
            multipliers: Cow::Borrowed(&cycle.multipliers),
            drift: &[],
            closings: closings.collect(),
            // the label says it
            period: f64::NAN,
        }
    }

    pub(super) fn of_machine(cycle: &'a machine::Cycle, machine: &'a Machine) -> Self {
        let closings = cycle.events.iter().filter(|event| event.closes());
        Self {
            multipliers: Cow::Borrowed(&cycle.multipliers),
            drift: &cycle.drift,
            closings: closings.map(|event| (event.phase, event.speed, machine.name_of(event.place))).collect(),
            period: cycle.period,
        }
    }
}
