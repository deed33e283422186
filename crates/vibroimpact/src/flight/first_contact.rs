//! The first contact of a flight with a stop, with a guarantee that none is missed.
//!
//! # What is guaranteed
//! The search advances only over times for which a proven upper bound of the distance $`y`$ from each stop stays
//! negative ([`bounds`](super), by the 2nd and 3rd derivative over a window). So no contact lies in the time that it
//! has passed. It ends in one of five ways:
//!
//! - a **transversal impact**: the velocity towards the stop is proven positive, and the mass is proven beyond the stop
//!   at the end of a short interval. So the interval contains exactly one contact, and the third-order iteration
//!   $`s \leftarrow s + 2g/(p + \sqrt{p^2 + 2qg})`$ converges to it to the last bits;
//! - a **grazing contact**: a maximum of $`y`$ that differs from zero by less than the bound of its rounding error,
//!   which every evaluation returns. In double precision it cannot be distinguished from a tangential contact. Its
//!   depth is reported;
//! - **never**, because of the amplitudes or a common period ([`Horizon`]);
//! - **none until** a stated time, because the limits of the search were reached;
//! - **contact** at `s = 0`: the mass is on the stop and does not leave it.
//!
//! The contact from which a flight starts is divided out (`bounds::leave_time`). So no displacement of the start and no
//! cool-down is needed, and flights of $`10^{-12}`$ are found like any other.
//!
//! Bounds are evaluated in rounded arithmetic. They are used with a relative slack of $`10^{-12}`$. This is far above
//! the rounding errors of their few operations, and too small to cost a step. Rounding errors of the *values* are taken
//! into account in both directions. The distance from a stop is reduced by its rounding error before a step is
//! computed. An impact is reported only if the mass is proven beyond the stop by more than the rounding error. A
//! maximum that differs from the stop by less is called grazing, one above is an impact, and one below is passed. An
//! undamped flight that began on a stop returns to it after the common period, if there is one; if there was no contact
//! before, this is a grazing contact.

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

/// The first contact, if it is known that there is none before the time `clear` (0 for unknown), and the number of
/// search steps.
pub(crate) fn counted(osc: &Oscillator, flight: &Flight, limits: SearchLimits, mut clear: f64) -> (Contact, u32) {
    let mut search = match Search::begin(osc, flight, clear > 0.0) {
        Ok(search) => search,
        Err(contact) => return (contact, 0),
    };
    // most flights end within a few steps, so bounds that need arctangents are computed only after them
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
            if search.s.max(clear) >= known.until {
                search.stride_to(clear);
                return (search.ended(known), step);
            }
            if let Some(envelope) = known.envelope
                && step >= patient
            {
                for (reach, (sign, stop)) in reaches.iter_mut().zip(search.walls()) {
                    reach.get_or_insert_with(|| Reach::new(envelope, sign, stop.gap, known.until));
                }
                let (from, mut next) = (search.s.max(clear), known.until);
                for reach in reaches.iter().flatten() {
                    let (closed, examined) = reach.next(from, next);
                    next = next.min(closed);
                    step += examined;
                }
                clear = next;
            }
        }
        search.stride_to(clear);
        if let Some(contact) = search.advance() {
            return (contact, step + 1);
        }
        step += 1;
    }
    (Contact::NoneUntil(search.s), limits.steps)
}

/// The number of steps after which the bounds of the whole flight are computed.
const QUICK: u32 = 12;
/// The number of steps after which the times at which the flight can reach a stop are computed.
const PATIENT: u32 = 64;
