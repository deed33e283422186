//! Both sections of an attractor: one row for each point.

use super::Table;
use crate::Units;
use crate::json::event::Stops;
use crate::number::Number;
use vibroimpact::QuantityKind;
use vibroimpact::events::Start;
use vibroimpact_study::SectionPoints;

/// The table of `vibro lyapunov`, with these names of the coordinates and velocities: the closings first, with the state after
/// each, then the states at phase 0. The section is `closing` or `strobe`.
pub(crate) fn table<'a>(
    points: &'a SectionPoints,
    system: &'a impl Stops,
    (q, qdot): &(Vec<String>, Vec<String>),
    units: Units,
) -> Table<'a> {
    let row = move |begin: String, at: &Start| {
        let (q, qdot) = (at.q.iter().map(|x| x * units.length()), at.qdot.iter().map(|v| v * units.velocity()));
        begin + &q.chain(qdot).map(|x| format!(",{}", Number(x))).collect::<String>()
    };
    let closings = points.closings.iter().map(move |at| {
        let (stop, speed) = (system.name_of_stop(at.stop), Number(at.speed * units.velocity()));
        row(format!("closing,{stop},{},{speed}", Number(at.state.phase)), &at.state)
    });
    let strobes = points.strobes.iter().map(move |at| row(format!("strobe,,{},", Number(at.phase)), at));
    let header = [&["section,stop,phase".to_owned(), units.column("speed", QuantityKind::Velocity)][..], q, qdot];
    Table::new(header.concat().join(","), closings.chain(strobes))
}
