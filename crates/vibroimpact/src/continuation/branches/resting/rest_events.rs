//! The events of a branch of cycles that stick, between two values of the parameter.
//!
//! - A flight reaches a stop, or an impact loses its speed. The smallest distance of this flight from the stop is a
//!   smooth function of the parameter on either side, because the motion before it is the same. The event is the zero
//!   of this function.
//! - All impacts before the mass sticks lose their speed together. This is the zero of the distance from the stop at
//!   the phase at which the force begins to press the mass against it.
//! - The time of sticking becomes zero. Near its completion a chatter, as seen from the release, shrinks by a fixed
//!   factor with each impact, and the time of sticking is not smooth: it is a power of the distance of the parameter,
//!   with an exponent near 0.6. But whether the mass sticks is decided to the last digit, so bisection finds the value.

use super::likeness::{Likeness, likeness, shape, stretch};
use super::rest_branch::{FoundEvent, RestBranch};
use crate::contact::sticking::release_phase;
use crate::continuation::event::{BranchEvent, EventDetail};
use crate::flight::Flight;
use crate::math::root;
use crate::math::{sin_cos, sort_by};
use crate::orbit::{Excursion, Stretch, turning_near};
use crate::system::{Oscillator, Side, phase};
use core::f64::consts::PI;

/// An impact that appears or disappears.
struct Touched {
    value: f64,
    appears: bool,
    /// The indices of the stretch and of the impact in it.
    place: (usize, usize),
    /// The time of flight up to this impact here and beyond, where there is one.
    flown: [Option<f64>; 2],
    side: Side,
    phase: f64,
}

impl RestBranch {
    /// The event between the current value and `to`, where the motion is `there`; `None` if no event is identified.
    pub(crate) fn between(&self, to: f64, there: Option<&Excursion>, alike: &Likeness) -> Option<FoundEvent> {
        match (alike, there) {
            (Likeness::From(places), Some(there)) => {
                if let Some(found) = places.iter().find_map(|&place| self.landing(place, to, there)) {
                    return Some(found);
                }
                let off = |touched: &Touched| (touched.value - self.value).abs();
                let mut touched: Vec<Touched> =
                    places.iter().filter_map(|&place| self.touch(place, to, there)).collect();
                // the first event on the way, with all others at the same value
                sort_by(&mut touched, |a, b| off(a).total_cmp(&off(b)));
                let first = touched.first()?.value;
                touched.retain(|touched| (touched.value - first).abs() <= TOGETHER * (1.0 + first.abs()));
                self.graze(&touched, there)
            }
            (Likeness::Rests, _) => self.other_rests(to),
            _ => None,
        }
    }

    /// The event at which the flight towards impact `k` of stretch `s`, which differs at `to`, grazes a stop.
    fn touch(&self, (s, k): (usize, usize), to: f64, there: &Excursion) -> Option<Touched> {
        let (a, b) = (self.excursion.stretches.get(s)?, there.stretches.get(s)?);
        let (appears, struck, clear, long) = match (a.strikes.get(k), b.strikes.get(k)) {
            (Some(x), Some(y)) if y.flown < x.flown => (true, y, a, Some(x.flown)),
            (Some(x), Some(y)) => (false, x, b, Some(y.flown)),
            (None, Some(y)) => (true, y, a, None),
            (Some(x), None) => (false, x, b, None),
            (None, None) => return None,
        };
        // without a longer flight the mass sticks after the impact before, which needs restitution 0
        if long.is_none() && clear.rest.is_none_or(|rest| rest.span.chatter) {
            return None;
        }
        let side = struck.state.side;
        let near = |value: f64| -> Option<(f64, f64)> {
            let osc = self.at(value)?;
            let excursion = self.excursion_at(value)?;
            let stretch = excursion.stretches.get(s)?;
            match long {
                Some(long) => {
                    let flight = leaving(&osc, stretch, k)?;
                    let closest = turning_near(&osc, &flight, side, long, struck.flown)?;
                    Some((closest.distance, flight.phase_at(closest.time)))
                }
                None => {
                    let last = stretch.strikes.get(k.checked_sub(1)?)?.state;
                    Some((osc.stop(side)?.gap - side.sign() * sin_cos(last.phase).0, last.phase))
                }
            }
        };
        let width = (to - self.value).abs();
        let (here, beyond) = (near(self.value)?.0, near(to)?.0);
        // without a change of sign the flight does not graze between both values
        if here * beyond >= 0.0 {
            return None;
        }
        let by = root::between(|by| Some(near(self.ahead(by))?.0), (0.0, here), (width, beyond), RESOLUTION * width)?;
        let value = self.ahead(by);
        let phase = phase::wrap(near(value)?.1);
        let flown = [a, b].map(|stretch| stretch.strikes.get(k).map(|strike| strike.flown));
        Some(Touched { value, appears, place: (s, k), flown, side, phase })
    }

    /// The event of grazing contacts at the same value: one, or with two equal stops one on each.
    fn graze(&self, touched: &[Touched], there: &Excursion) -> Option<FoundEvent> {
        let first = touched.first()?;
        if !self.explained(touched, there) {
            return None;
        }
        let (before, after) = (self.excursion.cycle()?.label, there.cycle()?.label);
        let excursion = self.short_of(touched)?;
        let cycle = excursion.cycle()?;
        let told = |touched: &Touched| {
            let (s, k) = touched.place;
            let listed = excursion.before(s) + k;
            // one that appears and is first in the list follows the last impact of the period before
            let last = cycle.points.len().saturating_sub(1);
            let impact = if touched.appears { listed.checked_sub(1).unwrap_or(last) } else { listed };
            (Some(impact), touched.phase)
        };
        let (appears, (impact, phase)) = (first.appears, told(first));
        let second = touched.get(1).filter(|second| second.appears == appears);
        let detail = EventDetail { impact, phase, also: second.map(told), labels: (before, Some(after)) };
        let (stop, also) = (first.side.place(), second.map(|second| second.side.place()));
        let event = BranchEvent::Grazing { stop, also, appears, turns: false, detail: Some(detail) };
        Some(FoundEvent { value: first.value, event, cycle })
    }

    /// Whether these impacts are the only difference between the motions.
    fn explained(&self, touched: &[Touched], there: &Excursion) -> bool {
        let without = |excursion: &Excursion, appears: bool| {
            let mut excursion = excursion.clone();
            for (s, k) in touched.iter().filter(|touched| touched.appears == appears).map(|touched| touched.place) {
                if let Some(stretch) = excursion.stretches.get_mut(s).filter(|stretch| k < stretch.strikes.len()) {
                    let gone = stretch.strikes.remove(k);
                    if let Some(next) = stretch.strikes.get_mut(k) {
                        // the flight goes on to the next impact
                        next.flown += gone.flown;
                    }
                }
            }
            excursion
        };
        let (here, there) = (without(&self.excursion, false), without(there, true));
        matches!(likeness(&here, &there), Likeness::Alike(_))
    }

    /// Whether the motion at another value corresponds to the current one up to slow impacts.
    fn begins_like(&self, other: &Excursion) -> bool {
        let slow = |stretch: &Stretch, k: usize| stretch.strikes.get(k).is_none_or(|x| x.state.velocity < UNSEEN);
        let pairs = self.excursion.stretches.iter().zip(&other.stretches);
        pairs.into_iter().all(|(a, b)| stretch(a, b).map_or_else(|k| slow(a, k) && slow(b, k), |_| true))
    }

    /// The motion before a grazing event, at the event; at a slightly earlier value if rounding has made it the motion
    /// beyond.
    fn short_of(&self, touched: &[Touched]) -> Option<Excursion> {
        let so_far = |excursion: &Excursion| {
            touched.iter().all(|touched| {
                let (s, k) = touched.place;
                let strike = excursion.stretches.get(s).and_then(|stretch| stretch.strikes.get(k));
                match (strike.map(|strike| strike.flown), touched.flown) {
                    (Some(flown), [Some(here), Some(beyond)]) => (flown - here).abs() < (flown - beyond).abs(),
                    (flown, [here, _]) => flown.is_some() == here.is_some(),
                }
            })
        };
        let value = touched.first()?.value;
        let width = (value - self.value).abs();
        let mut back = RESOLUTION * width;
        let mut at = value;
        for _ in 0..MAX_BACK {
            if let Some(excursion) = self.excursion_at(at).filter(so_far) {
                return Some(excursion);
            }
            back *= 10.0;
            if back >= width {
                break;
            }
            at = self.ahead(width - back);
        }
        Some(self.excursion.clone())
    }

    /// The event at which the mass lands without speed, if the impacts up to `k` of stretch `s` are slow here and at
    /// `to`: at this event the mass is on the stop at the phase at which the force begins to press it there.
    fn landing(&self, (s, k): (usize, usize), to: f64, there: &Excursion) -> Option<FoundEvent> {
        let (a, b) = (self.excursion.stretches.get(s)?, there.stretches.get(s)?);
        let slow = |stretch: &Stretch, k: usize| stretch.strikes.get(k).is_some_and(|x| x.state.velocity < SLOW);
        let first = (0..=k).find(|&k| slow(a, k) && slow(b, k))?;
        let strike = a.strikes.get(first)?;
        let side = strike.state.side;
        // the phase at which the force begins to press, and the distance from the stop and the velocity then
        let then = |value: f64| -> Option<(f64, f64, f64)> {
            let osc = self.at(value)?;
            let flight = leaving(&osc, self.excursion_at(value)?.stretches.get(s)?, first)?;
            // the sine is symmetric about a quarter turn: the force begins to press as long before it as it releases
            // after it
            let pressed = phase::wrap(PI - release_phase(&osc, side)?);
            let time = strike.flown + phase::difference(pressed, strike.state.phase) / osc.beta();
            let point = flight.at(time);
            let room = osc.stop(side)?.gap - side.sign() * flight.x;
            Some((pressed, room - side.sign() * point.displacement, point.v))
        };
        let width = (to - self.value).abs();
        let (here, beyond) = (then(self.value)?.1, then(to)?.1);
        if here * beyond >= 0.0 {
            return None;
        }
        let by = root::between(|by| Some(then(self.ahead(by))?.1), (0.0, here), (width, beyond), RESOLUTION * width)?;
        let value = self.ahead(by);
        let (phase, _, speed) = then(value)?;
        if speed.abs() > SOFT {
            return None;
        }
        let excursion = self.excursion_at(value).filter(|excursion| excursion.periods.is_some());
        let excursion = excursion.unwrap_or_else(|| self.excursion.clone());
        let cycle = excursion.cycle()?;
        let (before, after) = (self.excursion.cycle()?.label, there.cycle()?.label);
        let impact = Some(excursion.before(s) + first);
        let detail = EventDetail { impact, phase, also: None, labels: (before, Some(after)) };
        Some(FoundEvent { value, event: BranchEvent::SoftLanding { stop: side.place(), detail: Some(detail) }, cycle })
    }

    /// The event between the current value and `to` at which the intervals of sticking change: the time of one becomes
    /// zero, or a release no longer exists, or a chatter becomes complete.
    pub(crate) fn other_rests(&self, to: f64) -> Option<FoundEvent> {
        let same = |excursion: &Excursion| shape(excursion) == shape(&self.excursion);
        if self.excursion_at(to).is_some_and(|there| same(&there)) {
            return None;
        }
        let rests = |value: f64| self.excursion_at(value).is_some_and(|excursion| same(&excursion));
        let (inside, outside) = root::border(self.value, to, rests);
        let excursion = self.excursion_at(inside).filter(|inside| self.begins_like(inside))?;
        let cycle = excursion.cycle()?;
        let osc = self.at(outside)?;
        for rest in excursion.rests() {
            let side = rest.span.side;
            if release_phase(&osc, side).is_none() && osc.stop(side).is_some_and(|stop| stop.gap < 0.0) {
                let event = BranchEvent::RestForEver { stop: side.place() };
                return Some(FoundEvent { value: outside, event, cycle });
            }
        }
        let shrunk = |excursion: &Excursion| {
            excursion.rests().find(|rest| rest.held * osc.beta() < SHRUNK).map(|rest| rest.span)
        };
        if let Some(rest) = shrunk(&excursion) {
            // after a chatter that is not complete there are infinitely many impacts
            let (stop, after) = (rest.side.place(), (!rest.chatter).then_some(cycle.label));
            let detail = EventDetail::at(rest.release, (cycle.label, after));
            let event = BranchEvent::Sticking { stop, begins: false, detail: Some(detail) };
            return Some(FoundEvent { value: inside, event, cycle });
        }
        let beyond = self.excursion_at(outside)?;
        let rest = shrunk(&beyond)?;
        let (before, cycle) = (cycle.label, beyond.cycle()?);
        let detail = EventDetail::at(rest.release, (before, Some(cycle.label)));
        let event = BranchEvent::Sticking { stop: rest.side.place(), begins: true, detail: Some(detail) };
        Some(FoundEvent { value: outside, event, cycle })
    }
}

/// The flight towards impact `k` of a stretch.
fn leaving(osc: &Oscillator, stretch: &Stretch, k: usize) -> Option<Flight> {
    match k.checked_sub(1) {
        None => Some(Flight::release(osc, stretch.from, release_phase(osc, stretch.from)?)),
        Some(before) => Some(Flight::new(osc, stretch.strikes.get(before)?.state.rebound(osc))),
    }
}

/// The resolution to which a grazing event is located, as a fraction of the interval.
const RESOLUTION: f64 = 1e-13;
/// Impacts faster than this do not lose their speed within a step.
const SLOW: f64 = 0.02;
/// Where intervals of sticking change, the lists of impacts slower than this may differ.
const UNSEEN: f64 = 1e-4;
/// A speed below this at a landing counts as zero.
const SOFT: f64 = 1e-6;
/// Grazing contacts at values closer than this, relative to the value, are one event.
const TOGETHER: f64 = 1e-11;
/// The largest number of steps back from a grazing event, each ten times as long as the one before.
const MAX_BACK: u32 = 14;
/// A time of sticking below this, as a phase, counts as zero next to a value at which there is none.
const SHRUNK: f64 = 1e-6;
