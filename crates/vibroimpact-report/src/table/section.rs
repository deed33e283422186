//! Both sections of an attractor: one row for each point.

use super::Table;
use crate::Units;
use crate::json::event::side;
use crate::number::Number;
use vibroimpact::chaos::Section;
use vibroimpact::machine::Machine;
use vibroimpact::{Oscillator, QuantityKind};
use vibroimpact_study::SectionPoints;

/// A closing, with the state after it, or a state at phase 0.
struct Row<'a> {
    /// The stop and the speed of a closing.
    closing: Option<(&'a str, f64)>,
    phase: f64,
    /// Coordinates and velocities.
    state: Vec<f64>,
}

/// The table with these names of the speed and of the columns of a state. The section is `closing` or `strobe`.
fn written<'a>(speed: &str, state: &[String], rows: impl Iterator<Item = Row<'a>> + 'a) -> Table<'a> {
    let header = format!("section,stop,phase,{speed},{}", state.join(","));
    let rows = rows.map(|Row { closing, phase, state }| {
        let phase = Number(phase);
        let begin = closing.map_or_else(
            || format!("strobe,,{phase},"),
            |(stop, speed)| format!("closing,{stop},{phase},{}", Number(speed)),
        );
        begin + &state.into_iter().map(|x| format!(",{}", Number(x))).collect::<String>()
    });
    Table::new(header, rows)
}

/// The table of `vibro lyapunov`: the closings first.
#[must_use]
pub fn table<'a>(points: &'a Section, osc: &'a Oscillator, units: Units) -> Table<'a> {
    let state = move |x: f64, v: f64| vec![x * units.length(), v * units.velocity()];
    let impacts = points.impacts.iter().map(move |at| {
        let (sign, stop) = (at.side.sign(), osc.stop(at.side));
        let (x, v) = stop.map_or((0.0, 0.0), |stop| (sign * stop.gap, -sign * stop.restitution * at.velocity));
        let closing = Some((side(at.side), at.velocity * units.velocity()));
        Row { closing, phase: at.phase, state: state(x, v) }
    });
    let strobes = points.strobes.iter().map(move |at| Row { closing: None, phase: at.phase, state: state(at.x, at.v) });
    let names = [units.column("x", QuantityKind::Length), units.column("v", QuantityKind::Velocity)];
    written(&units.column("speed", QuantityKind::Velocity), &names, impacts.chain(strobes))
}

/// The same of a machine.
pub(crate) fn of_machine<'a>(machine: &'a Machine, found: &'a SectionPoints) -> Table<'a> {
    let names = &machine.parts().coordinates;
    let names = ["q", "qdot"].into_iter().flat_map(|of| names.iter().map(move |name| format!("{of}.{name}")));
    let closings = found.closings.iter().map(move |at| Row {
        closing: Some((machine.name_of(at.place), at.speed)),
        phase: at.phase,
        state: [at.q.as_slice(), at.qdot.as_slice()].concat(),
    });
    let strobes = found.strobes.iter();
    let strobes =
        strobes.map(|at| Row { closing: None, phase: at.phase, state: [at.q.as_slice(), at.qdot.as_slice()].concat() });
    written("speed", &names.collect::<Vec<_>>(), closings.chain(strobes))
}
