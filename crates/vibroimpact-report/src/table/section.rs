//! Both sections of an attractor: one row for each point.

use super::Table;
use crate::Units;
use crate::json::event::side;
use crate::number::Number;
use vibroimpact::chaos::Section;
use vibroimpact::{Oscillator, QuantityKind};

/// The table of `vibro lyapunov`.
#[must_use]
pub fn table<'a>(points: &'a Section, osc: &'a Oscillator, units: Units) -> Table<'a> {
    let speed = units.column("speed", QuantityKind::Velocity);
    let (x, v) = (units.column("x", QuantityKind::Length), units.column("v", QuantityKind::Velocity));
    Table::new(format!("section,stop,phase,{speed},{x},{v}"), rows(points, osc, units))
}

/// One row for each point, the impacts first, with the state after them.
fn rows<'a>(points: &'a Section, osc: &'a Oscillator, units: Units) -> impl Iterator<Item = String> + 'a {
    let state = move |x: f64, v: f64| format!("{},{}", Number(x * units.length()), Number(v * units.velocity()));
    let impacts = points.impacts.iter().map(move |at| {
        let (sign, stop) = (at.side.sign(), osc.stop(at.side));
        let (x, v) = stop.map_or((0.0, 0.0), |stop| (sign * stop.gap, -sign * stop.restitution * at.velocity));
        let (phase, speed) = (Number(at.phase), Number(at.velocity * units.velocity()));
        format!("closing,{},{phase},{speed},{}", side(at.side), state(x, v))
    });
    impacts.chain(points.strobes.iter().map(move |at| format!("strobe,,{},,{}", Number(at.phase), state(at.x, at.v))))
}
