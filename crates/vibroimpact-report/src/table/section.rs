//! Both sections of an attractor: one row for each point.

use super::Table;
use crate::Units;
use crate::json::motion::side;
use crate::number::Number;
use vibroimpact::chaos::Section;
use vibroimpact::{Oscillator, QuantityKind};

/// The table of `vibro lyapunov`.
#[must_use]
pub fn table<'a>(points: &'a Section, osc: &'a Oscillator, units: Units) -> Table<'a> {
    let (x, v) = (units.column("x", QuantityKind::Length), units.column("v", QuantityKind::Velocity));
    Table::new(format!("section,side,phase,{x},{v}"), rows(points, osc, units))
}

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
