//! Points of an attractor: its closings of stops, and its states once in every forcing period.

use crate::diagram::{EVENTS_EACH, at_phase_zero};
use crate::dynamics::refused;
use crate::{RunError, Stopped, motion_limits};
use vibroimpact::chaos::Section;
use vibroimpact::events;
use vibroimpact::events::{Event, Motion, Sample};
use vibroimpact::machine::Machine;
use vibroimpact::motion::ImpactState;
use vibroimpact::{Oscillator, Start};

/// The points of a motion in two sections, in the order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectionPoints {
    /// Its closings of stops.
    pub closings: Vec<SectionClosing>,
    /// Its states at phase 0 of the forcing: the stroboscopic section.
    pub strobes: Vec<events::Start>,
}

/// A closing of a stop.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionClosing {
    /// The number of the stop.
    pub stop: usize,
    /// The speed of the closing.
    pub speed: f64,
    /// The state after it.
    pub state: events::Start,
}

impl SectionPoints {
    /// The points of a motion of an oscillator.
    #[must_use]
    pub fn of_oscillator(osc: &Oscillator, found: &Section) -> Self {
        let state = |x, v, phase| events::Start { q: vec![x], qdot: vec![v], phase, ..events::Start::default() };
        let closing = |at: &ImpactState| {
            let (gap, restitution) = osc.stop(at.side).map_or((0.0, 0.0), |stop| (stop.gap, stop.restitution));
            let sign = at.side.sign();
            // without a rebound 0, not -0
            let after = state(sign * gap, -sign * restitution * at.velocity + 0.0, at.phase);
            SectionClosing { stop: at.side.place(), speed: at.velocity, state: after }
        };
        let strobe = |at: &Start| state(at.x, at.v, at.phase);
        Self {
            closings: found.impacts.iter().map(closing).collect(),
            strobes: found.strobes.iter().map(strobe).collect(),
        }
    }
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
    let motion = Motion::new(machine, start, motion_limits(machine, f64::INFINITY)).map_err(refused)?;
    let events = motion.take(whole(EVENTS_EACH * (transient + points))).take_while(|_| go_on());
    let closing = |event: Event| {
        let state = events::Start { q: event.q, qdot: event.qdot, phase: event.phase, ..events::Start::default() };
        SectionClosing { stop: event.place, speed: event.speed, state }
    };
    let closings = events.filter(Event::closes).skip(whole(transient)).take(whole(points)).map(closing).collect();
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
    use vibroimpact::scenario;

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
        let expected = SectionPoints::of_oscillator(&osc, &expected);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        let same = |a: &events::Start, b: &events::Start| near(a.q[0], b.q[0]) && near(a.qdot[0], b.qdot[0]);
        for (own, other) in found.closings.iter().zip(&expected.closings) {
            assert!(near(own.speed, other.speed) && near(own.state.phase, other.state.phase), "{own:?} {other:?}");
            assert!(own.stop == other.stop && same(&own.state, &other.state), "{own:?} {other:?}");
        }
        assert!(found.strobes.iter().zip(&expected.strobes).all(|(own, other)| same(own, other)));
        let free = Machine::new(MachineParts::new(["x"]).with_mass(0, 1.0).with_link(&[1.0], 1.0, 0.1)).unwrap();
        let refused = section(&free, &events::Start::default(), (1, 1), &|| true);
        assert!(matches!(refused, Err(RunError::Plan(PlanError::Unforced))), "{refused:?}");
    }
}
