//! Points of the attractor of a machine: its closings of stops, and its states once in every forcing period.

use crate::diagram::{EVENTS_EACH, at_phase_zero};
use crate::dynamics::refused;
use crate::{RunError, Stopped};
use vibroimpact::events;
use vibroimpact::events::{Event, Limits, Motion, Sample};
use vibroimpact::machine::Machine;

/// The points of a motion of a machine in two sections, in the order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectionPoints {
    /// Its closings of stops; velocities are those after the closing.
    pub closings: Vec<Event>,
    /// Its states at phase 0 of the forcing: the stroboscopic section.
    pub strobes: Vec<events::Start>,
}

/// So many closings after a transient of closings, and so many states at phase 0 after a transient of forcing periods. There are
/// fewer if the motion has no more of them.
pub(crate) fn section(
    machine: &Machine,
    start: &events::Start,
    (transient, points): (u64, u64),
    go_on: &dyn Fn() -> bool,
) -> Result<SectionPoints, RunError> {
    let whole = |count: u64| usize::try_from(count).unwrap_or(usize::MAX);
    let motion = Motion::new(machine, start, Limits::default()).map_err(refused)?;
    let events = motion.take(whole(EVENTS_EACH * (transient + points))).take_while(|_| go_on());
    let closings = events.filter(Event::closes).skip(whole(transient)).take(whole(points)).collect();
    let (_, samples) = at_phase_zero(machine, start, transient + points)?;
    let states = samples.take_while(|_| go_on()).filter(|sample| sample.even);
    let state = |sample: Sample| events::Start { phase: 0.0, ..sample.start() };
    let strobes = states.skip(whole(transient)).take(whole(points)).map(state).collect();
    if !go_on() {
        return Err(Stopped { done: 0, total: 1 }.into());
    }
    Ok(SectionPoints { closings, strobes })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PlanError;
    use vibroimpact::chaos::section as of_oscillator;
    use vibroimpact::machine::MachineParts;
    use vibroimpact::{Oscillator, Start, scenario};

    /// A machine of one coordinate has the sections of the oscillator.
    #[test]
    fn of_one_coordinate() {
        let osc: Oscillator = scenario::S.oscillator();
        let parts = MachineParts::new(["x"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, 0.0).with_frequency(osc.beta());
        let parts = parts.with_force(0, 1, 0.0, 1.0).with_rigid_stop("wall", &[1.0], osc.gap(), osc.restitution());
        let machine = Machine::new(parts).unwrap();
        let (transient, points) = (300, 20);
        let rest = Start::at_rest(&osc);
        let start =
            events::Start { q: vec![rest.x], qdot: vec![rest.v], phase: rest.phase, ..events::Start::default() };
        let found = section(&machine, &start, (transient, points), &|| true).unwrap();
        let expected = of_oscillator(&osc, rest, transient, points);
        assert_eq!((found.closings.len(), found.strobes.len()), (20, 20));
        for (closing, impact) in found.closings.iter().zip(&expected.impacts) {
            assert!((closing.phase - impact.phase).abs() < 1e-9 && (closing.speed - impact.velocity).abs() < 1e-9);
        }
        for (state, strobe) in found.strobes.iter().zip(&expected.strobes) {
            assert!((state.q[0] - strobe.x).abs() < 1e-9 && (state.qdot[0] - strobe.v).abs() < 1e-9, "{state:?}");
        }
        let free = Machine::new(MachineParts::new(["x"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, 0.1)).unwrap();
        let refused = section(&free, &events::Start::default(), (1, 1), &|| true);
        assert!(matches!(refused, Err(RunError::Plan(PlanError::Unforced))), "{refused:?}");
    }
}
