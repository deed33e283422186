//! Whether a solution of the equations is admissible: no flight may reach a stop before its end.

use super::cycle::Cycle;
use super::grazing::grazes;
use super::ring::Ring;
use crate::flight::{Contact, Flight, SearchLimits, first_contact};
use crate::motion::MAX_TOUCHES;
use crate::system::{Oscillator, Side, Start};

/// Why a solution of the equations of a cycle is inadmissible: a flight reaches a stop before its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarlierContact {
    /// The flight, by the index of the impact that it leaves in the list of the cycle.
    pub flight: usize,
    /// The stop that it reaches.
    pub side: Side,
    /// The time since the impact that it leaves, or since phase 0 for the motion without impacts; 0 if it does not
    /// leave the stop.
    pub time: f64,
}

/// A solution of the equations of a cycle, and whether it is admissible.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    /// The cycle.
    pub cycle: Cycle,
    /// Whether the cycle is admissible; false if a flight passes through a stop.
    pub physical: bool,
    /// The first contact that makes it inadmissible; `None` for an admissible cycle.
    pub earlier: Option<EarlierContact>,
}

impl Orbit {
    /// A cycle with the result of [`earlier_contact`].
    #[must_use]
    pub fn judged(osc: &Oscillator, cycle: Cycle) -> Self {
        let earlier = earlier_contact(osc, &cycle);
        Self { cycle, physical: earlier.is_none(), earlier }
    }
}

/// A contact in this last fraction of a flight is its end, displaced by rounding errors that an unstable flight
/// amplifies.
const END: f64 = 1e-6;

/// The first contact of `cycle` with a stop that is not one of its impacts; each flight is computed. `None` if there is
/// none, so that the cycle is admissible. A grazing contact has no effect and does not count.
///
/// An impact with a speed of zero or less counts as a contact at time 0. So does a speed that is zero to within
/// rounding: without that impact the cycle would be the same motion, which grazes the stop there.
#[must_use]
pub fn earlier_contact(osc: &Oscillator, cycle: &Cycle) -> Option<EarlierContact> {
    if !cycle.rests.is_empty() {
        return None;
    }
    let m = cycle.points.len();
    if m == 0 {
        return super::free::met(osc).map(|(side, time)| EarlierContact { flight: 0, side, time });
    }
    let ring = Ring::of(osc, cycle);
    (0..m).find_map(|k| {
        let (point, next) = (&cycle.points[k], &cycle.points[(k + 1) % m]);
        if point.state.velocity <= 0.0 || ring.as_ref().is_some_and(|ring| grazes(osc, ring, k)) {
            return Some(EarlierContact { flight: k, side: point.state.side, time: 0.0 });
        }
        let (side, time) = blocked(osc, point.state.rebound(osc), point.interval, next.state.side)?;
        Some(EarlierContact { flight: k, side, time })
    })
}

/// The contact at which a flight from `start` ends before `interval`; `None` if it does not.
fn blocked(osc: &Oscillator, start: Start, interval: f64, end: Side) -> Option<(Side, f64)> {
    let (mut start, mut passed) = (start, 0.0);
    for _ in 0..MAX_TOUCHES {
        let flight = Flight::new(osc, start);
        // the search counts the longer one of the periods of force and machine; a little more, so that the end is
        // within
        let periods = 1.01 * (interval - passed) / osc.period().max(core::f64::consts::TAU);
        match first_contact(osc, &flight, SearchLimits { periods, ..SearchLimits::default() }) {
            Contact::Impact { time, side, .. } => {
                let early = passed + time < (1.0 - END) * interval || (side != end && passed + time < interval);
                return early.then_some((side, passed + time));
            }
            Contact::Contact { side } => return Some((side, passed)),
            Contact::Grazing { time, side, .. } => {
                passed += time;
                if passed >= (1.0 - END) * interval {
                    return None;
                }
                let x = side.sign() * osc.stop(side).map_or(0.0, |stop| stop.gap);
                start = Start { x, v: 0.0, phase: flight.phase_at(time) };
            }
            Contact::Never(_) | Contact::NoneUntil(_) => return None,
        }
    }
    None
}
