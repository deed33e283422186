//! Whether a solution of the equations is a motion: each flight has to reach its own end first.

use super::cycle::Cycle;
use super::grazing::grazes;
use super::ring::Ring;
use crate::flight::{Contact, Flight, SearchLimits, first_contact};
use crate::motion::MAX_TOUCHES;
use crate::system::{Oscillator, Side, Start};

/// Where a solution of the equations of a cycle fails to be a motion: it meets a stop before it is meant to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarlierContact {
    /// The flight: the one that leaves this impact of the cycle's list.
    pub flight: usize,
    /// Which stop it meets.
    pub side: Side,
    /// When, since the impact it leaves, or since phase 0 for the motion without impacts; 0 where it does not leave the stop at all.
    pub time: f64,
}

/// A periodic orbit, and whether it is a possible motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    /// The cycle.
    pub cycle: Cycle,
    /// False for a solution of the equations that passes through a stop on its way.
    pub physical: bool,
    /// Where it does so first, `None` for a possible motion.
    pub earlier: Option<EarlierContact>,
}

impl Orbit {
    /// A cycle, and the judgement whether it is a possible motion.
    #[must_use]
    pub fn judged(osc: &Oscillator, cycle: Cycle) -> Self {
        let earlier = earlier_contact(osc, &cycle);
        Self { cycle, physical: earlier.is_none(), earlier }
    }
}

/// A contact this much of the flight's length before its end is the end itself, moved by the rounding that an
/// unstable flight amplifies.
const END: f64 = 1e-6;

/// The first contact of `cycle` with a stop that is not an impact of it, found by flying each of its flights; `None` if
/// there is none, so that the cycle is a possible motion. A touch without effect does not count.
///
/// An impact with a speed of zero or less counts as one that is not left. Zero to within rounding is zero: without that impact
/// the cycle would be the same and touch the stop there.
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

/// The contact that keeps a flight from `start` from lasting for `interval`.
fn blocked(osc: &Oscillator, start: Start, interval: f64, end: Side) -> Option<(Side, f64)> {
    let (mut start, mut passed) = (start, 0.0);
    for _ in 0..MAX_TOUCHES {
        let flight = Flight::new(osc, start);
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
