//! Both sections of an attractor: one row for each point.

use super::Table;
use crate::Units;
use crate::json::motion::side;
use crate::number::Number;
use vibroimpact::Oscillator;
use vibroimpact::chaos::Section;

/// The table of `vibro lyapunov`.
#[must_use]
pub fn table<'a>(points: &'a Section, osc: &'a Oscillator, units: Units) -> Table<'a> {
    Table::new(COLUMNS.to_owned(), rows(points, osc, units))
}

/// The columns of the table of both sections.
const COLUMNS: &str = "section,side,phase,x,v";

/// One row for each point, the impacts first.
fn rows<'a>(points: &'a Section, osc: &'a Oscillator, units: Units) -> impl Iterator<Item = String> + 'a {
    let state = move |phase, x: f64, v: f64| {
        format!("{},{},{}", Number(phase), Number(x * units.length()), Number(v * units.velocity()))
    };
    let impacts = points.impacts.iter().map(move |at| {
        let (sign, gap) = (at.side.sign(), osc.stop(at.side).map_or(0.0, |stop| stop.gap));
        format!("impact,{},{}", side(at.side), state(at.phase, sign * gap, sign * at.velocity))
    });
    impacts.chain(points.strobes.iter().map(move |at| format!("strobe,,{}", state(at.phase, at.x, at.v))))
}
