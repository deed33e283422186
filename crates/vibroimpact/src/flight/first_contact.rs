//! The first contact of a flight with a stop, which cannot be missed.
//!
//! # What is guaranteed
//! The search advances only over times during which a proven upper bound of the distance $`y`$ to each stop stays
//! negative ([`bounds`](super), 2nd and 3rd derivative over a window), so no contact can lie in what it has passed. It
//! ends in one of five ways:
//!
//! - a **transversal impact**: once the velocity towards the stop is proven positive and the stop proven passed within
//!   a short interval, that interval holds exactly one contact, and the third-order iteration
//!   $`s \leftarrow s + 2g/(p + \sqrt{p^2 + 2qg})`$ refines it to the last bits;
//! - a **grazing contact**: a maximum of $`y`$ closer to zero than the rounding of its own evaluation, a bound of which
//!   every evaluation carries. Nothing computed in double precision can tell it from a touch. Its depth is reported;
//! - **never**, by the amplitudes or by commensurability ([`Horizon`]);
//! - **none until** a stated time: the limits of the search;
//! - **contact** already at `s = 0`: the mass is on the stop and does not leave it.
//!
//! The contact a flight starts from is divided out ([`leave_time`]), not stepped over: there is neither a nudge nor a
//! cool-down, and flights of $`10^{-12}`$ are found like any other.
//!
//! Bounds are evaluated in rounded arithmetic. They are used with a relative slack of $`10^{-12}`$, far above the
//! rounding of their few operations and far below anything that costs a step. What rounding can do to the *values* is
//! covered from both sides: a distance that rounding may hide counts as gone, so nothing within it is stepped over, and an
//! impact is only claimed where the mass is proven beyond the stop by more than rounding. A maximum within it is called
//! grazing, one above it is an impact, one below it is passed. An undamped flight that began on a stop is back on it
//! after the common period, if there is one: where nothing came before, that is a touch.

use super::bounds::{View, leave_time, radius, safe_time, single_contact_within};
use super::horizon::Outlook;
use super::{Flight, Horizon, Point, SearchLimits};
use crate::system::{Oscillator, Side, Stop};

/// How a flight first meets a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// It strikes a stop.
    Impact {
        /// Time since the beginning of the flight.
        time: f64,
        /// Which stop.
        side: Side,
        /// Speed of arrival, towards the stop.
        velocity: f64,
    },
    /// It touches a stop tangentially, to within what rounding can tell.
    Grazing {
        /// Time since the beginning of the flight.
        time: f64,
        /// Which stop.
        side: Side,
        /// What is computed of the distance left at the closest point: positive short of the stop, negative beyond.
        depth: f64,
    },
    /// It never meets a stop, for ever, and why.
    Never(Horizon),
    /// No contact up to this time since the beginning; beyond it nothing was decided.
    NoneUntil(f64),
    /// It begins on this stop and does not leave it: it arrives there, or rests there under a force into the stop.
    Contact {
        /// Which stop.
        side: Side,
    },
}

/// The first contact of `flight` with the stops of `osc`.
///
/// ```
/// use vibroimpact::{Oscillator, Start, flight::{Contact, Flight, SearchLimits, first_contact}};
/// let osc = Oscillator::new(1.0 / 1.8, 0.25, 0.5)?;
/// let flight = Flight::new(&osc, Start::at_rest(&osc));
/// let Contact::Impact { time, velocity, .. } = first_contact(&osc, &flight, SearchLimits::default()) else { panic!() };
/// let (x, v) = flight.state(time);
/// assert!((x - 0.25).abs() < 1e-15 && (v - velocity).abs() < 1e-14);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[must_use]
pub fn first_contact(osc: &Oscillator, flight: &Flight, limits: SearchLimits) -> Contact {
    counted(osc, flight, limits).0
}

/// The first contact, and the steps it took to find.
pub(crate) fn counted(osc: &Oscillator, flight: &Flight, limits: SearchLimits) -> (Contact, u32) {
    let mut search = match Search::begin(osc, flight) {
        Ok(search) => search,
        Err(contact) => return (contact, 0),
    };
    // most flights end within a few steps: what needs arctangents waits until then
    let mut outlook: Option<Outlook> = None;
    for step in 0..limits.steps {
        if step == QUICK {
            let known = Outlook::new(osc, flight, limits);
            if known.never == Some(Horizon::Amplitude) && known.until == 0.0 {
                return (Contact::Never(Horizon::Amplitude), step);
            }
            outlook = Some(known);
        }
        if let Some(known) = &outlook {
            if search.s >= known.until {
                return (search.ended(known), step);
            }
            if step >= PATIENT
                && let Some(envelope) = &known.envelope
            {
                let stride = search.walls().map(|(sign, stop)| envelope.stride(search.s, sign, stop.gap));
                search.stride_to(stride.fold(f64::INFINITY, f64::min).min(known.until));
            }
        }
        if let Some(contact) = search.advance() {
            return (contact, step + 1);
        }
    }
    (Contact::NoneUntil(search.s), limits.steps)
}

/// Steps after which the outlook of the whole flight is worked out.
const QUICK: u32 = 12;
/// Steps after which strides by the envelope are tried.
const PATIENT: u32 = 64;
/// Bounds are used up to this fraction, so that their own rounding cannot matter.
const SLACK: f64 = 1.0 - 1e-12;

struct Search<'a> {
    osc: &'a Oscillator,
    flight: &'a Flight,
    /// Distance from the start to each stop, exact: `gap - sign x0`.
    room: [f64; 2],
    /// Distance of each stop from the rest position.
    gap: [f64; 2],
    /// Nothing was touched up to here.
    s: f64,
    point: Point,
    reach: f64,
}

impl<'a> Search<'a> {
    fn begin(osc: &'a Oscillator, flight: &'a Flight) -> Result<Self, Contact> {
        let (mut room, mut gap) = ([f64::INFINITY; 2], [f64::INFINITY; 2]);
        let mut leave = f64::INFINITY;
        let r = radius(flight.x, flight.v);
        for (side, stop) in osc.stops() {
            let left = stop.gap - side.sign() * flight.x;
            (room[index(side)], gap[index(side)]) = (left, stop.gap);
            if left <= 0.0 {
                leave = leave.min(leave_time(flight, side.sign(), stop.gap, r).ok_or(Contact::Contact { side })?);
            }
        }
        let reach = FIRST_REACH / (1.0 + flight.response().damping());
        let start = Point {
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
            // the other stop must not be reached in the meantime
            let other = search.views().filter(|view| view.g > 0.0);
            let safe = other.map(|v| safe_time(flight, v, r, reach)).fold(leave, f64::min);
            search.move_to(safe * SLACK);
        }
        Ok(search)
    }

    /// The answer when nothing was met as far as one has to look.
    fn ended(&self, known: &Outlook) -> Contact {
        match known.never {
            // a flight that began on a stop is back on it after the common period: at most a touch
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

    fn walls(&self) -> impl Iterator<Item = (f64, Stop)> {
        self.osc.stops().map(|(side, stop)| (side.sign(), stop))
    }

    fn views(&self) -> impl Iterator<Item = View> {
        self.osc.stops().map(|(side, _)| self.view(side, &self.point))
    }

    #[inline]
    fn view(&self, side: Side, point: &Point) -> View {
        let (sign, k) = (side.sign(), index(side));
        let g = if point.far { self.gap[k] - sign * point.x } else { self.room[k] - sign * point.displacement };
        View { side, g, p: sign * point.v, q: sign * point.a, j: sign * point.j }
    }

    #[inline]
    fn move_to(&mut self, s: f64) {
        self.s = s;
        self.point = self.flight.at(s);
    }

    fn stride_to(&mut self, s: f64) {
        if s > self.s {
            self.move_to(s);
        }
    }

    /// One safe step, or the contact it found.
    #[inline]
    fn advance(&mut self) -> Option<Contact> {
        let r = radius(self.point.x, self.point.v);
        let mut safe = f64::INFINITY;
        let mut nearest: Option<View> = None;
        for (side, _) in self.osc.stops() {
            let view = self.view(side, &self.point);
            if view.g <= GRAZING_ZONE * self.point.rounding {
                return self.at_rounding(view, r);
            }
            // what rounding may hide counts as gone
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
        self.reach = if step >= self.reach { 2.0 * step } else { 1.25 * step };
        let next = self.s + step;
        if next <= self.s {
            // the bound no longer moves the clock: the contact is here, to the last bit
            return nearest.and_then(|view| self.at_rounding(view, r));
        }
        self.move_to(next);
        None
    }

    fn others_clear(&self, side: Side, span: f64, r: f64) -> bool {
        self.views().filter(|other| other.side != side).all(|other| safe_time(self.flight, other, r, span) >= span)
    }

    /// The single contact in `(self.s, end]`, by a third-order iteration kept in the bracket.
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
            // the step is already as good as the next evaluation could judge
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

    /// The distance to this stop is down to rounding: decide what kind of contact it is, or pass.
    #[cold]
    fn at_rounding(&mut self, view: View, r: f64) -> Option<Contact> {
        let rounding = self.point.rounding.max(f64::MIN_POSITIVE);
        // transversal: the velocity carries it through the zone of rounding within a time too short to matter
        let curvature = 1.0 + r * (1.0 + 2.0 * self.flight.response().damping());
        if view.p > 0.0 && view.p * view.p > 16.0 * curvature * rounding {
            let width = 4.0 * GRAZING_ZONE * rounding / view.p;
            return Some(self.refine_freely(view, width));
        }
        // tangential: find the extremum of y nearby, y' = 0
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
                // clear after all: go on from the closest point
                self.s = s;
                self.point = apex;
                self.reach = FIRST_REACH;
                return None;
            }
            if depth >= -zone {
                return Some(Contact::Grazing { time: s, side: view.side, depth });
            }
            // it does pass the stop: the contact lies between here and the apex
            return Some(self.bisect(view.side, self.s, s));
        }
        if view.p < 0.0 && here.q <= 0.0 {
            // leaving: the closest point was passed within rounding
            return Some(Contact::Grazing { time: self.s, side: view.side, depth: view.g });
        }
        // approaching with the force behind it: contact is imminent
        Some(self.refine_freely(view, 1e-6))
    }

    /// Contact right here, to within `width`.
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

    /// The contact between `low`, short of the stop, and `high`, beyond it and at the extremum.
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

/// Window of the first step.
const FIRST_REACH: f64 = 0.7;
/// A maximum within this many times the rounding of its evaluation counts as grazing.
const GRAZING_ZONE: f64 = 1.0;
/// Relative step at which a root is refined: one more third-order step would move it by less than its last bit.
const CONVERGED: f64 = 1e-9;
/// The iteration converges in two or three steps; this caps it.
const MAX_REFINEMENTS: u32 = 60;

#[inline]
const fn index(side: Side) -> usize {
    match side {
        Side::Upper => 0,
        Side::Lower => 1,
    }
}
