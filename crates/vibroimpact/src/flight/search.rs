//! The steps of the search for a first contact. [`first_contact`](super::first_contact) states its guarantee and the
//! reasons.

use super::bounds::{View, leave_time, radius, safe_time, single_contact_within};
use super::horizon::Outlook;
use super::{Contact, Flight, FlightPoint, Horizon};
use crate::system::{Oscillator, Side, Stop};

/// Bounds are used up to this fraction, so that their own rounding errors have no effect.
const SLACK: f64 = 1.0 - 1e-12;

/// The state of a search: there is no contact up to the current point.
pub(super) struct Search<'a> {
    osc: &'a Oscillator,
    flight: &'a Flight,
    /// Distance of the start from each stop, exact: `gap - sign x0`.
    room: [f64; 2],
    /// Distance of each stop from the rest position.
    gap: [f64; 2],
    /// Time of the current point.
    pub(super) s: f64,
    point: FlightPoint,
    reach: f64,
}

impl<'a> Search<'a> {
    /// The search from the beginning of a flight; an error with the contact there if the mass is on a stop and does not
    /// leave it. If the flight is known to have `left` the stops, the search must [stride](Self::stride_to) to a later time
    /// first.
    pub(super) fn begin(osc: &'a Oscillator, flight: &'a Flight, left: bool) -> Result<Self, Contact> {
        let (mut room, mut gap) = ([f64::INFINITY; 2], [f64::INFINITY; 2]);
        let mut leave = f64::INFINITY;
        let r = radius(flight.x, flight.v);
        for (side, stop) in osc.stops() {
            let apart = stop.gap - side.sign() * flight.x;
            (room[index(side)], gap[index(side)]) = (apart, stop.gap);
            if apart <= 0.0 && !left {
                leave = leave.min(leave_time(flight, side.sign(), stop.gap, r).ok_or(Contact::Contact { side })?);
            }
        }
        let reach = FIRST_REACH / (1.0 + flight.response().damping());
        let start = FlightPoint {
            displacement: 0.0,
            x: flight.x,
            far: false,
            v: flight.v,
            a: flight.a,
            j: flight.jerk(),
            rounding: 0.0,
        };
        let mut search = Self { osc, flight, room, gap, s: 0.0, point: start, reach };
        if leave.is_finite() {
            // the other stop must not be reached during this time
            let other = search.views().filter(|view| view.g > 0.0);
            let safe = other.map(|v| safe_time(flight, v, r, reach)).fold(leave, f64::min);
            search.move_to(safe * SLACK);
        }
        Ok(search)
    }

    /// The result when there was no contact up to the time at which the search may end.
    pub(super) fn ended(&self, known: &Outlook) -> Contact {
        match known.never {
            // a flight that began on a stop is back on it after the common period, which is at most a grazing contact
            Some(Horizon::CommonPeriod { .. }) => {
                let back = self.osc.stops().find(|(side, _)| self.room[index(*side)] <= 0.0);
                match back {
                    Some((side, _)) => Contact::Grazing { time: known.until, side, depth: 0.0 },
                    None => known.never.map_or(Contact::NoneUntil(self.s), Contact::Never),
                }
            }
            Some(why) => Contact::Never(why),
            None => Contact::NoneUntil(self.s),
        }
    }

    /// Each stop, with the sign that mirrors the lower one.
    pub(super) fn walls(&self) -> impl Iterator<Item = (f64, Stop)> {
        self.osc.stops().map(|(side, stop)| (side.sign(), stop))
    }

    fn views(&self) -> impl Iterator<Item = View> {
        self.osc.stops().map(|(side, _)| self.view(side, &self.point))
    }

    /// The state of the flight relative to a stop, with the distance in the more accurate of its two forms.
    #[inline]
    fn view(&self, side: Side, point: &FlightPoint) -> View {
        let (sign, k) = (side.sign(), index(side));
        let g = if point.far { self.gap[k] - sign * point.x } else { self.room[k] - sign * point.displacement };
        View { side, g, p: sign * point.v, q: sign * point.a, j: sign * point.j }
    }

    #[inline]
    fn move_to(&mut self, s: f64) {
        self.s = s;
        self.point = self.flight.at(s);
    }

    /// Advances to `s`, if that is ahead; it must be known that there is no contact before.
    pub(super) fn stride_to(&mut self, s: f64) {
        if s > self.s {
            self.move_to(s);
        }
    }

    /// Takes one safe step, or returns the contact.
    #[inline]
    pub(super) fn advance(&mut self) -> Option<Contact> {
        let r = radius(self.point.x, self.point.v);
        let mut safe = f64::INFINITY;
        let mut nearest: Option<View> = None;
        for (side, _) in self.osc.stops() {
            let view = self.view(side, &self.point);
            if view.g <= GRAZING_ZONE * self.point.rounding {
                return self.at_rounding(view, r);
            }
            // the distance is reduced by its rounding error
            let seen = View { g: view.g - self.point.rounding, ..view };
            let time = safe_time(self.flight, seen, r, self.reach);
            if time < safe {
                (safe, nearest) = (time, Some(view));
            }
        }
        if let Some(view) = nearest
            && let Some(span) = single_contact_within(self.flight, view, r, 2.0 * self.point.rounding)
            && self.others_clear(view.side, span, r)
        {
            return Some(self.refine(view.side, self.s + span));
        }
        let step = safe * SLACK;
        // a step that its window limited is followed by a longer window
        self.reach = if step >= self.reach { 2.0 * step } else { 1.25 * step };
        let next = self.s + step;
        if next <= self.s {
            // the step is below the resolution of the time: the contact is here, to the last bit
            return nearest.and_then(|view| self.at_rounding(view, r));
        }
        self.move_to(next);
        None
    }

    fn others_clear(&self, side: Side, span: f64, r: f64) -> bool {
        self.views().filter(|other| other.side != side).all(|other| safe_time(self.flight, other, r, span) >= span)
    }

    /// The only contact in `(self.s, end]`, by a third-order iteration that stays in the bracket.
    fn refine(&self, side: Side, end: f64) -> Contact {
        let (mut low, mut high) = (self.s, end);
        let (mut s, mut view) = (self.s, self.view(side, &self.point));
        for _ in 0..MAX_REFINEMENTS {
            let disc = view.p * view.p + 2.0 * view.q * view.g;
            let step = 2.0 * view.g / (view.p + disc.max(0.0).sqrt());
            let mut next = s + step;
            if !(next >= low && next <= high) {
                next = 0.5 * (low + high);
            }
            // the next evaluation could not improve this step
            if step.abs() <= CONVERGED * next {
                return Contact::Impact { time: next, side, velocity: (view.p + view.q * (next - s)).max(0.0) };
            }
            s = next;
            let point = self.flight.at(s);
            view = self.view(side, &point);
            if view.g > 0.0 {
                low = s;
            } else {
                high = s;
            }
        }
        Contact::Impact { time: s, side, velocity: view.p.max(0.0) }
    }

    /// The distance from this stop is within its rounding error: determines the kind of contact, or advances if there
    /// is none.
    #[cold]
    fn at_rounding(&mut self, view: View, r: f64) -> Option<Contact> {
        let rounding = self.point.rounding.max(f64::MIN_POSITIVE);
        // transversal: the velocity carries the mass through the rounding error in a negligible time
        let curvature = 1.0 + r * (1.0 + 2.0 * self.flight.response().damping());
        if view.p > 0.0 && view.p * view.p > 16.0 * curvature * rounding {
            let width = 4.0 * GRAZING_ZONE * rounding / view.p;
            return Some(self.refine_freely(view, width));
        }
        // tangential: find the nearby extremum of y, where y' = 0
        let (mut s, mut here) = (self.s, view);
        for _ in 0..MAX_REFINEMENTS {
            if here.q == 0.0 {
                break;
            }
            let step = -here.p / here.q;
            let next = (s + step).max(0.0);
            if !next.is_finite() || (next - self.s).abs() > 1.0 {
                break;
            }
            let moved = (next - s).abs();
            s = next;
            let point = self.flight.at(s);
            here = self.view(view.side, &point);
            if moved <= CONVERGED * s {
                break;
            }
        }
        let apex = self.flight.at(s);
        let depth = self.view(view.side, &apex).g;
        let zone = GRAZING_ZONE * apex.rounding.max(rounding);
        if here.q < 0.0 && s >= self.s {
            if depth > zone {
                // no contact: continue from the closest point
                self.s = s;
                self.point = apex;
                self.reach = FIRST_REACH;
                return None;
            }
            if depth >= -zone {
                return Some(Contact::Grazing { time: s, side: view.side, depth });
            }
            // it passes the stop: the contact lies between here and the maximum
            return Some(self.bisect(view.side, self.s, s));
        }
        if view.p < 0.0 && here.q <= 0.0 {
            // leaving the stop: the closest point was passed, within its rounding error
            return Some(Contact::Grazing { time: self.s, side: view.side, depth: view.g });
        }
        // approaching with an acceleration towards the stop: contact follows at once
        Some(self.refine_freely(view, 1e-6))
    }

    /// The contact at the current point, to within `width`.
    fn refine_freely(&self, view: View, width: f64) -> Contact {
        let (mut s, mut here) = (self.s, view);
        for _ in 0..4 {
            let disc = here.p * here.p + 2.0 * here.q * here.g;
            let denominator = here.p + disc.max(0.0).sqrt();
            let step = if denominator > 0.0 { 2.0 * here.g / denominator } else { 0.0 };
            let step = step.clamp(-width, width);
            s = (s + step).max(0.0);
            here = self.view(view.side, &self.flight.at(s));
            if step.abs() <= CONVERGED * s {
                break;
            }
        }
        Contact::Impact { time: s, side: view.side, velocity: here.p.max(0.0) }
    }

    /// The contact between `low`, before the stop, and `high`, the maximum beyond it.
    fn bisect(&self, side: Side, mut low: f64, mut high: f64) -> Contact {
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.view(side, &self.flight.at(middle)).g > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        Contact::Impact { time: high, side, velocity: self.view(side, &self.flight.at(high)).p.max(0.0) }
    }
}

/// The window of the first step.
const FIRST_REACH: f64 = 0.7;
/// A maximum within this number of rounding errors of the stop counts as grazing.
const GRAZING_ZONE: f64 = 1.0;
/// The relative step at which the iteration ends: another third-order step would change the root by less than its last
/// bit.
const CONVERGED: f64 = 1e-9;
/// The largest number of iterations; two or three usually suffice.
const MAX_REFINEMENTS: u32 = 60;

#[inline]
const fn index(side: Side) -> usize {
    match side {
        Side::Upper => 0,
        Side::Lower => 1,
    }
}
