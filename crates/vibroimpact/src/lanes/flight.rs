//! A flight from its launch to its first contact: steps that are proven clear, then a contact that is proven to be the
//! first. Where neither can be proven, steps are halved; where this does not help, the flight is left to the careful
//! search.

use super::constants::Constants;
use super::hull::MARGIN;
use super::propagator_cache::{Cached, PropagatorCache};
use super::stride::{Halvings, LEVELS, Propagators, State, Stride};
use super::strike::{Guess, Launch, Strike};
use crate::flight::{Contact, Flight, SearchLimits, counted};
use crate::system::{Oscillator, Side};

/// The first contact of `flight` with the stops of `osc`, as in a [`Motion`](crate::motion::Motion): by strides where
/// they can prove it, otherwise by the careful search [`flight::first_contact`](crate::flight::first_contact), which
/// documents the results and `limits`.
#[must_use]
pub fn first_contact(osc: &Oscillator, flight: &Flight, limits: SearchLimits) -> Contact {
    found((Stride::new(osc).as_ref(), None), osc, flight, limits).0
}

/// The same with the strides of the oscillator given, if it has any, and a cache of its propagators; returns also the
/// number of steps.
pub(crate) fn found(
    (stride, cache): (Option<&Stride>, Option<&PropagatorCache>),
    osc: &Oscillator,
    flight: &Flight,
    limits: SearchLimits,
) -> (Contact, u32) {
    match stride.map_or(Err(0.0), |stride| stride.first_contact(flight, cache)) {
        Ok(hit) if hit.time <= limits.horizon(osc) => (hit.into(), 1),
        // beyond the horizon the careful search says what it knows
        Ok(_) => counted(osc, flight, limits, 0.0),
        Err(clear) => counted(osc, flight, limits, clear),
    }
}

/// A first contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    /// Time since the launch.
    pub(crate) time: f64,
    /// Arrival speed.
    pub(crate) velocity: f64,
    /// +1 at the upper stop, -1 at the lower.
    pub(crate) side: f64,
}

/// The result of a step that was examined.
pub(super) enum Progress {
    /// There is a contact.
    Hit(Hit),
    /// The step is clear; the flight continues from here.
    Clear(State<f32>),
    /// Left to the careful search.
    Rare,
}

impl Stride {
    /// The first contact of a flight. If only the careful search can decide, an error with the time up to which there
    /// is no contact.
    pub(crate) fn first_contact(&self, flight: &Flight, cache: Option<&PropagatorCache>) -> Result<Hit, f64> {
        let launch = Launch { x: flight.x, v: flight.v, sin: flight.sin, cos: flight.cos };
        match cache {
            Some(cache) => self.fly(&launch, &Cached(self, cache)),
            None => self.fly(&launch, self),
        }
    }

    /// Takes steps from the launch until one is not proven clear, and examines that one.
    fn fly(&self, launch: &Launch<f64>, with: &(impl Propagators<f64> + Halvings)) -> Result<Hit, f64> {
        let Self { constants, roughly, rough, .. } = self;
        let mut state = launch.state().rough();
        loop {
            let next = rough.step(state);
            let (from, to) = (roughly.end(&state), roughly.end(&next));
            if roughly.clear(&rough.scale, &from, &to, roughly.margin(state.s), false) {
                state = next;
            } else {
                let guess = Guess::of(&roughly.guess(rough.h, state.s, &from, &to));
                let strike = constants.polish(&guess, &constants.approach(launch, &guess, with));
                // as the lanes do it: the bits are those of a batch
                if Constants::first_roughly(roughly, &strike, state.s, &from) == 1 {
                    return Ok(strike.into());
                }
                match self.refine(launch, state, with, with) {
                    Progress::Hit(hit) => return Ok(hit),
                    Progress::Clear(on) => state = on,
                    Progress::Rare => return Err(f64::from(state.s)),
                }
            }
            if roughly.late(state.s) {
                return Err(f64::from(state.s));
            }
        }
    }

    /// For a flight that is pressed back and returns after about 2v/a: the number of halvings with which its contact
    /// may be proven.
    fn promising(&self, state: &State<f64>) -> usize {
        let a = self.constants.end(state).a;
        // twice the time after which it returns, so that a step holds the whole arc
        let back = if state.v * a < 0.0 { -4.0 * state.v / a } else { f64::INFINITY };
        let mut h = self.constants.h;
        let mut level = 0;
        while h > back && level < LEVELS - 1 {
            h *= 0.5;
            level += 1;
        }
        level
    }

    /// Continues from the beginning of a step that was not proven clear, in halved steps, which are halved again where
    /// necessary, to the end of that step or to a contact.
    pub(super) fn refine(
        &self,
        launch: &Launch<f64>,
        way: State<f32>,
        propagators: &impl Propagators<f64>,
        halvings: &impl Halvings,
    ) -> Progress {
        let constants = &self.constants;
        let mut state = constants.after_steps(launch, f64::from(way.s), propagators);
        let end = state.s + constants.h;
        let mut level = 0;
        while level < LEVELS {
            let pace = halvings.pace(level);
            let next = pace.step(state);
            let ends = (state.s, constants.end(&state), constants.end(&next));
            let swing = constants.swing(&pace.scale, &ends.1, &ends.2, MARGIN);
            if swing.clear {
                state = next;
                // lengths are dyadic fractions, so the sums are exact
                if state.s >= end {
                    return Progress::Clear(state.rough());
                }
                continue;
            }
            // for the whole step the guess of a contact was tried before
            if swing.above || level > 0 {
                let guess = if swing.above {
                    constants.guess_near(pace.h, &ends, &swing)
                } else {
                    constants.guess(pace.h, ends.0, &ends.1, &ends.2)
                };
                let strike = constants.polish(&guess, &constants.approach(launch, &guess, propagators));
                if constants.first(&strike, state.s, &ends.1) {
                    return Progress::Hit(strike.into());
                }
            }
            // the next level, or straight to one with which the arc may be proven
            level = (level + 1).max(self.promising(&state));
        }
        Progress::Rare
    }
}

impl Launch<f64> {
    /// The state at the launch.
    pub(super) fn state(&self) -> State<f64> {
        State { s: 0.0, x: self.x, v: self.v, sin: self.sin, cos: self.cos }
    }
}

impl From<Hit> for Contact {
    fn from(hit: Hit) -> Self {
        Self::Impact { time: hit.time, side: Side::of_sign(hit.side), velocity: hit.velocity }
    }
}

impl From<Strike<f64>> for Hit {
    fn from(strike: Strike<f64>) -> Self {
        Self { time: strike.time, velocity: strike.velocity, side: strike.side }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario;
    use crate::system::Start;
    use crate::verdict::{StartBox, scattered_starts};

    /// Compares the contacts that the lanes prove with the careful search; returns the number of flights left to that
    /// search.
    fn compare(osc: &Oscillator, starts: impl Iterator<Item = Start>) -> u32 {
        let stride = Stride::new(osc).unwrap();
        let mut rare = 0;
        for start in starts {
            let flight = Flight::new(osc, start);
            let Ok(hit) = stride.first_contact(&flight, None) else {
                rare += 1;
                continue;
            };
            let (contact, _) = counted(osc, &flight, SearchLimits::default(), 0.0);
            let Contact::Impact { time, side, velocity } = contact else {
                panic!("{osc:?} {start:?} {hit:?} {contact:?}")
            };
            let close = 2e-14 * (osc.gap().abs() + start.x.abs() + start.v.abs() + time) * (1.0 + 1.0 / velocity);
            assert!(
                (hit.time - time).abs() < close && (hit.velocity - velocity).abs() < close && hit.side == side.sign(),
                "{osc:?} {start:?} {hit:?} {contact:?}"
            );
        }
        rare
    }

    #[test]
    fn contacts_are_those_of_the_careful_search() {
        for point in scenario::PAPER {
            for (damping, lower) in [(0.0, None), (0.02, None), (0.7, None), (0.0, Some(1.2)), (0.1, Some(0.4))] {
                let mut osc = point.oscillator().with_damping(damping).unwrap();
                if let Some(gap) = lower {
                    osc = osc.with_second_stop(gap, 0.6).unwrap();
                }
                let area = StartBox::natural(&osc);
                let scattered = (2..1000).map(|k| scattered_starts(&osc, area, 5, k));
                let rare = compare(&osc, scattered);
                assert!(damping > 0.0 || rare < 200, "{} {damping} {lower:?} {rare}", point.name);
                let launched = (2..1000).map(|k| {
                    let start = scattered_starts(&osc, area, 6, k);
                    Start { x: osc.gap(), v: -start.v.abs() * 0.7, ..start }
                });
                let rare = compare(&osc, launched);
                assert!(damping > 0.0 || rare < 20, "{} {damping} {lower:?} {rare}", point.name);
            }
        }
    }
}
