//! Both sections of an attractor of a machine: one row for each point.

use super::Table;
use crate::number::Number;
use vibroimpact::machine::Machine;
use vibroimpact_study::MachineSection;

/// One row a point, the closings first: section (`closing`, or `strobe` for the states at phase 0), stop, phase, speed of the
/// closing, coordinates and velocities, which at a closing are those after it.
pub(crate) fn table<'a>(machine: &'a Machine, found: &'a MachineSection) -> Table<'a> {
    let names = &machine.parts().coordinates;
    let states = ["q", "qdot"].into_iter().flat_map(|of| names.iter().map(move |name| format!("{of}.{name}")));
    let header = ["section", "stop", "phase", "speed"].map(str::to_owned).into_iter().chain(states);
    let state = |q: &[f64], qdot: &[f64]| q.iter().chain(qdot).map(|x| format!(",{}", Number(*x))).collect::<String>();
    let closings = found.closings.iter().map(move |at| {
        let (stop, phase, speed) = (machine.name_of(at.place), Number(at.phase), Number(at.speed));
        format!("closing,{stop},{phase},{speed}{}", state(&at.q, &at.qdot))
    });
    let strobes = found.strobes.iter();
    let strobes = strobes.map(move |at| format!("strobe,,{},{}", Number(at.phase), state(&at.q, &at.qdot)));
    Table::new(header.collect::<Vec<_>>().join(","), closings.chain(strobes))
}
