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
//! The contact a flight starts from is divided out (`bounds::leave_time`), not stepped over: there is neither a nudge nor a
//! cool-down, and flights of $`10^{-12}`$ are found like any other.
//!
//! Bounds are evaluated in rounded arithmetic. They are used with a relative slack of $`10^{-12}`$, far above the
//! rounding of their few operations and far below anything that costs a step. What rounding can do to the *values* is
//! covered from both sides: a distance that rounding may hide counts as gone, so nothing within it is stepped over, and an
//! impact is only claimed where the mass is proven beyond the stop by more than rounding. A maximum within it is called
//! grazing, one above it is an impact, one below it is passed. An undamped flight that began on a stop is back on it
//! after the common period, if there is one: where nothing came before, that is a touch.

use super::horizon::Outlook;
use super::reach::Reach;
use super::search::Search;
use super::{Contact, Flight, Horizon, SearchLimits};
use crate::system::Oscillator;

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
    counted(osc, flight, limits, 0.0).0
}

/// The first contact where it is known that there is none up to the time `clear`, if that is not 0; and the steps it took to find.
pub(crate) fn counted(osc: &Oscillator, flight: &Flight, limits: SearchLimits, clear: f64) -> (Contact, u32) {
    let mut search = match Search::begin(osc, flight) {
        Ok(search) => search,
        Err(contact) => return (contact, 0),
    };
    search.stride_to(clear);
    // most flights end within a few steps: what needs arctangents waits until then
    let (quick, patient) = if clear > 0.0 { (0, 0) } else { (QUICK, PATIENT) };
    let mut outlook: Option<Outlook> = None;
    let mut reaches = [None; 2];
    let mut step = 0;
    while step < limits.steps {
        if step == quick {
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
            if let Some(envelope) = known.envelope
                && step >= patient
            {
                for (reach, (sign, stop)) in reaches.iter_mut().zip(search.walls()) {
                    reach.get_or_insert_with(|| Reach::new(envelope, sign, stop.gap));
                }
                let mut next = known.until;
                for reach in reaches.iter().flatten() {
                    let (clear, strides) = reach.next(search.s, next);
                    next = next.min(clear);
                    step += strides;
                }
                search.stride_to(next);
            }
        }
        if let Some(contact) = search.advance() {
            return (contact, step + 1);
        }
        step += 1;
    }
    (Contact::NoneUntil(search.s), limits.steps)
}

/// Steps after which the outlook of the whole flight is worked out.
const QUICK: u32 = 12;
/// Steps after which strides are tried.
const PATIENT: u32 = 64;
