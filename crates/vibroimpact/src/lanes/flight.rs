//! A flight from its launch to its first contact: steps that are proven clear, then a strike; where neither can be proven,
//! halved steps; where halving does not help, nothing is claimed.

use super::hull::MARGIN;
use super::stride::{LEVELS, NODES, Propagators, State, Stride};
use super::strike::{Guess, Launch, Strike};
use crate::flight::{Contact, Flight, SearchLimits, counted};
use crate::math::Numbers;
use crate::system::{Oscillator, Side};

/// The first contact of `flight` with the stops of `osc`, as a [`Motion`](crate::motion::Motion) gets it: by strides where they
/// can prove it, else by the careful search [`flight::first_contact`](crate::flight::first_contact), which says what the answers mean
/// and what `limits` are.
#[must_use]
pub fn first_contact(osc: &Oscillator, flight: &Flight, limits: SearchLimits) -> Contact {
    found(Stride::new(osc).as_ref(), osc, flight, limits).0
}

/// The same with the oscillator's strides at hand; and the steps it took.
pub(crate) fn found(
    stride: Option<&Stride>,
    osc: &Oscillator,
    flight: &Flight,
    limits: SearchLimits,
) -> (Contact, u32) {
    match stride.map_or(Err(0.0), |stride| stride.first_contact(flight)) {
        Ok(hit) if hit.time <= limits.horizon(osc) => (hit.into(), 1),
        Ok(_) => counted(osc, flight, limits, 0.0),
        Err(clear) => counted(osc, flight, limits, clear),
    }
}

/// A first contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    /// Time since the launch.
    pub(crate) time: f64,
    /// Speed of arrival.
    pub(crate) velocity: f64,
    /// +1 at the upper stop, -1 at the lower.
    pub(crate) side: f64,
}

/// How a stretch of a flight went.
pub(super) enum Progress {
    /// Struck.
    Hit(Hit),
    /// The step that was in doubt is clear; the flight goes on from here.
    Clear(State<f32>),
    /// Left to the careful search.
    Rare,
}

impl Stride {
    /// The first contact of a flight; where it takes the careful search to tell, the time up to which there is none.
    pub(crate) fn first_contact(&self, flight: &Flight) -> Result<Hit, f64> {
        self.fly(&Launch { x: flight.x, v: flight.v, sin: flight.sin, cos: flight.cos })
    }

    fn fly(&self, launch: &Launch<f64>) -> Result<Hit, f64> {
        let mut state = launch.state().rough();
        loop {
            let next = self.rough.step(state);
            let (from, to) = (self.end(&state), self.end(&next));
            if self.clear(&self.rough.scale, &from, &to, self.margin(state.s), false) {
                state = next;
            } else {
                let guess = Guess::of(&self.guess(self.rough.h, state.s, &from, &to));
                let strike = self.polish(&guess, &self.approach(launch, &guess, self));
                if self.first_roughly(&strike, state.s, &from) == 1 {
                    return Ok(strike.into());
                }
                match self.refine(launch, state, self) {
                    Progress::Hit(hit) => return Ok(hit),
                    Progress::Clear(on) => state = on,
                    Progress::Rare => return Err(f64::from(state.s)),
                }
            }
            if self.late(state.s) {
                return Err(f64::from(state.s));
            }
        }
    }

    /// Past the last step that lanes fly.
    #[inline(always)]
    pub(super) fn late<L: Numbers>(&self, s: L) -> L::Mask {
        L::splat(f64::from(NODES) * self.pace.h).less(s)
    }

    /// The level at which a flight that is pressed back at once, and returns after some 2v/a, may be proven to.
    fn promising(&self, state: &State<f64>) -> usize {
        let a = self.end(state).a;
        let back = if state.v * a < 0.0 { -4.0 * state.v / a } else { f64::INFINITY };
        let mut h = self.pace.h;
        let mut level = 0;
        while h > back && level < LEVELS - 1 {
            h *= 0.5;
            level += 1;
        }
        level
    }

    /// Goes on from the beginning of a step in doubt in halved steps, halved again where they are in doubt too, to its end or to
    /// a contact.
    pub(super) fn refine(
        &self,
        launch: &Launch<f64>,
        way: State<f32>,
        propagators: &impl Propagators<f64>,
    ) -> Progress {
        let mut state = self.after_steps(launch, f64::from(way.s), propagators);
        let end = state.s + self.pace.h;
        let mut level = 0;
        while level < LEVELS {
            let pace = propagators.pace(level);
            let next = pace.step(state);
            let ends = (state.s, self.end(&state), self.end(&next));
            let swing = self.swing(&pace.scale, &ends.1, &ends.2, MARGIN);
            if swing.clear {
                state = next;
                // lengths are dyadic fractions: the sums are exact
                if state.s >= end {
                    return Progress::Clear(state.rough());
                }
                continue;
            }
            // from the whole step a contact was guessed before
            if swing.above || level > 0 {
                let guess = if swing.above {
                    self.guess_near(pace.h, &ends, &swing)
                } else {
                    self.guess(pace.h, ends.0, &ends.1, &ends.2)
                };
                let strike = self.polish(&guess, &self.approach(launch, &guess, propagators));
                if self.first(&strike, state.s, &ends.1) {
                    return Progress::Hit(strike.into());
                }
            }
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

    /// The contacts that are flown, against the careful search; how many were left.
    fn compare(osc: &Oscillator, starts: impl Iterator<Item = Start>) -> u32 {
        let stride = Stride::new(osc).unwrap();
        let mut rare = 0;
        for start in starts {
            let flight = Flight::new(osc, start);
            let Ok(hit) = stride.first_contact(&flight) else {
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
