//! A motion as an iterator over its events, with the legs (flights and intervals of sticking) between them.
//!
//! Time restarts at each event and the phase is advanced instead; the total time is a compensated sum. So the state of
//! a motion is the phase and velocity at the stop, and precision does not degrade with time.

use super::{End, Event, EventKind, ImpactState};
use crate::contact::{chatter, landing, sticking};
use crate::flight::{Contact, Flight, SearchLimits};
use crate::lanes::{self, PropagatorCache, Stride};
use crate::math::Wide;
use crate::system::{Oscillator, Side, Start, phase};

/// The motion of the mass between two events.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path {
    /// The mass flies.
    Flight(Flight),
    /// The mass sticks on a stop, or its remaining impacts of a chatter are too small to matter.
    Rest(Side),
}

/// The motion between two events.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Time from the start of the motion to the beginning of the leg.
    pub begin: f64,
    /// Its length; infinite if no event ends it.
    pub duration: f64,
    /// Phase of the force at its beginning.
    pub phase: f64,
    /// The motion of the mass.
    pub path: Path,
}

impl Leg {
    /// Position and velocity a time `s` after the beginning of the leg.
    #[must_use]
    pub fn state(&self, osc: &Oscillator, s: f64) -> (f64, f64) {
        match &self.path {
            Path::Flight(flight) => flight.state(s),
            Path::Rest(side) => (side.sign() * osc.stop(*side).map_or(0.0, |stop| stop.gap), 0.0),
        }
    }

    /// The same as a start, with the phase there. The position is limited to the range between the stops, because
    /// rounding can put it beyond.
    #[must_use]
    pub fn start(&self, osc: &Oscillator, s: f64) -> Start {
        let (x, v) = self.state(osc, s);
        let (lowest, highest) = Start::room(osc);
        Start { x: x.clamp(lowest, highest), v, phase: phase::advance(self.phase, osc.beta(), s) }
    }

    /// The state with the phase `wanted` at the time nearest to a time `s` after the beginning of the leg, within the
    /// time `known`. `s` only selects the period, so the rounding error of a sum of many periods has no effect.
    #[must_use]
    pub fn at_phase(&self, osc: &Oscillator, s: f64, wanted: f64, known: f64) -> Start {
        // the time to the phase that is wanted, by less than half a period
        let early = phase::difference(wanted, phase::advance(self.phase, osc.beta(), s)) / osc.beta();
        Start { phase: wanted, ..self.start(osc, (s + early).clamp(0.0, known)) }
    }
}

/// The events of a motion, in order. It ends when there is no further event; [`Motion::end`] gives the reason.
///
/// ```
/// use vibroimpact::{Oscillator, Start, motion::{EventKind, Motion}};
/// let osc = Oscillator::new(1.0 / 1.3, 0.75, 0.5)?;
/// let impacts = Motion::new(&osc, Start::at_rest(&osc)).take(200).filter(|e| matches!(e.kind, EventKind::Impact { .. }));
/// assert_eq!(impacts.count(), 200);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a> {
    osc: &'a Oscillator,
    stride: Option<Stride>,
    limits: SearchLimits,
    time: Wide,
    mode: Mode,
    last: Option<Leg>,
    steps: u64,
}

#[derive(Clone, Copy, Debug)]
enum Mode {
    Flying(Flight),
    /// A flight that begins with a release from the stop on this side.
    Released(Side, Flight),
    /// A chatter after an impact is summed: the mass sticks after `duration`.
    Settling {
        side: Side,
        phase: f64,
        duration: f64,
        error: f64,
        chatter: bool,
    },
    Resting {
        side: Side,
        phase: f64,
    },
    Ended(End),
}

impl<'a> Motion<'a> {
    /// The motion of `osc` from `start`.
    #[must_use]
    pub fn new(osc: &'a Oscillator, start: Start) -> Self {
        Self::with_limits(osc, start, SearchLimits::default())
    }

    /// The same, with the given limits of the search for the first contact of each flight.
    #[must_use]
    pub fn with_limits(osc: &'a Oscillator, start: Start, limits: SearchLimits) -> Self {
        Self::begin(osc, limits, Mode::Flying(Flight::new(osc, start)))
    }

    /// The motion after an impact.
    #[must_use]
    pub fn after(osc: &'a Oscillator, state: &ImpactState, limits: SearchLimits) -> Self {
        // any mode: `restart` sets it
        let mut motion = Self::begin(osc, limits, Mode::Ended(End::Stuck(state.side)));
        motion.restart(state);
        motion
    }

    /// Makes it the motion [after](Self::after) an impact, without computing the constants of the flights again.
    pub(super) fn restart(&mut self, state: &ImpactState) {
        let rebound = self.osc.stop(state.side).map_or(0.0, |stop| stop.rebound(state.velocity));
        self.mode = self.after_impact(state.side, state.phase, rebound);
        (self.time, self.last, self.steps) = (Wide::default(), None, 0);
    }

    /// The motion after a release from the stop on `side`. It ends at once, without an event, if that stop never
    /// releases the mass.
    #[must_use]
    pub fn released(osc: &'a Oscillator, side: Side) -> Self {
        let mode = match sticking::release_phase(osc, side) {
            Some(phase) => Mode::Released(side, Flight::release(osc, side, phase)),
            None => Mode::Ended(End::Stuck(side)),
        };
        Self::begin(osc, SearchLimits::default(), mode)
    }

    fn begin(osc: &'a Oscillator, limits: SearchLimits, mode: Mode) -> Self {
        Self { osc, stride: Stride::new(osc), limits, time: Wide::default(), mode, last: None, steps: 0 }
    }

    /// The same motion, begun at this time of a longer one.
    pub(crate) fn begun(self, time: Wide) -> Self {
        Self { time, ..self }
    }

    /// The time of the last event.
    pub(crate) const fn time(&self) -> Wide {
        self.time
    }

    /// Why there is no further event; `None` while the motion continues.
    #[must_use]
    pub const fn end(&self) -> Option<End> {
        match self.mode {
            Mode::Ended(end) => Some(end),
            _ => None,
        }
    }

    /// The leg before the last event returned; after the end, the leg without an end.
    #[must_use]
    pub const fn leg(&self) -> Option<&Leg> {
        self.last.as_ref()
    }

    /// The number of search steps so far, a measure of the computing time: about thirty for each impact, and far more
    /// for long flights.
    #[must_use]
    pub const fn steps(&self) -> u64 {
        self.steps
    }

    fn event(&mut self, leg: Leg, phase: f64, side: Side, kind: EventKind) -> Event {
        self.time += leg.duration;
        self.last = Some(leg);
        Event { time: self.time.value(), phase, side, kind }
    }

    fn finish(&mut self, phase: f64, path: Path, end: End) {
        self.last = Some(Leg { begin: self.time.value(), duration: f64::INFINITY, phase, path });
        self.mode = Mode::Ended(end);
    }

    /// Follows a flight to its end; `released` is the stop from which it was released, if it begins with a release.
    fn fly(&mut self, flight: Flight, released: Option<Side>, cache: Option<&PropagatorCache>) -> Option<Event> {
        let leg =
            |duration| Leg { begin: self.time.value(), duration, phase: flight.phase, path: Path::Flight(flight) };
        let (contact, steps) = lanes::found((self.stride.as_ref(), cache), self.osc, &flight, self.limits);
        self.steps += u64::from(steps);
        // it has left the stop and comes back to it without an impact: it rests again
        if let Contact::Impact { time, side, .. } | Contact::Grazing { time, side, .. } = contact
            && released == Some(side)
            && let Some(landing) = landing::landing(self.osc, side).filter(|landing| landing.is_at(self.osc, time))
        {
            let (phase, leg) = (landing.phase, leg(landing.duration));
            self.mode = Mode::Resting { side, phase };
            return Some(self.event(leg, phase, side, EventKind::Stick { chatter: false, error: 0.0 }));
        }
        let (duration, side, velocity) = match contact {
            Contact::Impact { time, side, velocity } => (time, side, velocity),
            Contact::Contact { side } => {
                let velocity = side.sign() * flight.v;
                if velocity <= 0.0 {
                    // at rest on the stop and pressed against it
                    let (phase, leg) = (flight.phase, leg(0.0));
                    self.mode = Mode::Resting { side, phase };
                    return Some(self.event(leg, phase, side, EventKind::Stick { chatter: false, error: 0.0 }));
                }
                // it begins on the stop and moves towards it: an impact at once
                (0.0, side, velocity)
            }
            Contact::Grazing { time, side, depth } => {
                let (phase, leg) = (flight.phase_at(time), leg(time));
                // the flight goes on from the stop, without velocity towards it
                self.mode = Mode::Flying(Flight::new(self.osc, self.on_stop(side, 0.0, phase)));
                return Some(self.event(leg, phase, side, EventKind::Graze { depth }));
            }
            Contact::Never(why) => {
                self.finish(flight.phase, Path::Flight(flight), End::Never(why));
                return None;
            }
            Contact::NoneUntil(s) => {
                self.finish(flight.phase, Path::Flight(flight), End::NoneFor(s));
                return None;
            }
        };
        let (phase, leg) = (flight.phase_at(duration), leg(duration));
        let rebound = self.osc.stop(side).map_or(0.0, |stop| stop.rebound(velocity));
        self.mode = self.after_impact(side, phase, rebound);
        Some(self.event(leg, phase, side, EventKind::Impact { velocity_before: velocity, velocity_after: -rebound }))
    }

    /// The motion after an impact: a flight, or sticking after a chatter that can be summed or after a rebound speed of
    /// zero.
    fn after_impact(&self, side: Side, phase: f64, rebound: f64) -> Mode {
        if rebound == 0.0 {
            // eps = 0, or a rebound below the smallest number: at rest on the stop, and it sticks if the force presses
            return if sticking::pressure(self.osc, side, phase) > 0.0 {
                Mode::Settling { side, phase, duration: 0.0, error: 0.0, chatter: false }
            } else {
                Mode::Flying(Flight::new(self.osc, self.on_stop(side, 0.0, phase)))
            };
        }
        match chatter::completion(self.osc, side, phase, rebound, chatter::DEFAULT_SMALLNESS) {
            Some(sum) => Mode::Settling { side, phase, duration: sum.duration, error: sum.error, chatter: true },
            None => Mode::Flying(Flight::new(self.osc, self.on_stop(side, rebound, phase))),
        }
    }

    /// The state that leaves the stop with the speed `rebound`.
    fn on_stop(&self, side: Side, rebound: f64, phase: f64) -> Start {
        let sign = side.sign();
        Start { x: sign * self.osc.stop(side).map_or(0.0, |stop| stop.gap), v: -sign * rebound, phase }
    }
}

impl Iterator for Motion<'_> {
    type Item = Event;

    fn next(&mut self) -> Option<Event> {
        self.advance(None)
    }
}

impl Motion<'_> {
    /// The next event; a cache of the propagators of the oscillator saves time in a long motion and changes nothing.
    pub(crate) fn advance(&mut self, cache: Option<&PropagatorCache>) -> Option<Event> {
        match self.mode {
            Mode::Flying(flight) => self.fly(flight, None, cache),
            Mode::Released(side, flight) => self.fly(flight, Some(side), cache),
            Mode::Settling { side, phase, duration, error, chatter } => {
                let leg = Leg { begin: self.time.value(), duration, phase, path: Path::Rest(side) };
                let phase = phase::advance(phase, self.osc.beta(), duration);
                self.mode = Mode::Resting { side, phase };
                Some(self.event(leg, phase, side, EventKind::Stick { chatter, error }))
            }
            Mode::Resting { side, phase } => match sticking::rest(self.osc, side, phase) {
                sticking::Rest::Until { time, phase: release } => {
                    let leg = Leg { begin: self.time.value(), duration: time, phase, path: Path::Rest(side) };
                    self.mode = Mode::Released(side, Flight::release(self.osc, side, release));
                    Some(self.event(leg, release, side, EventKind::Release))
                }
                sticking::Rest::Forever => {
                    self.finish(phase, Path::Rest(side), End::Stuck(side));
                    None
                }
            },
            Mode::Ended(_) => None,
        }
    }
}
