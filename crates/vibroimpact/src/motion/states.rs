//! The states of a motion at given times, from the closed form of its legs.

use super::{End, Leg, Motion};
use crate::flight::SearchLimits;
use crate::system::{Oscillator, Start};

/// The states of the motion of `osc` from `start` at these times, which must not fall; `None` where nothing is known. At
/// the time of an event the state is that after it.
///
/// ```
/// use vibroimpact::{Start, motion::states_at, scenario};
/// let osc = scenario::N.oscillator();
/// let start = Start::at_rest(&osc);
/// let states = states_at(&osc, start, &[0.0, 1.0, 2.5]);
/// assert_eq!(states[0], Some(start));
/// assert!(states.iter().flatten().all(|state| state.x <= osc.gap()));
/// ```
#[must_use]
pub fn states_at(osc: &Oscillator, start: Start, times: &[f64]) -> Vec<Option<Start>> {
    let limits = SearchLimits::default();
    let last = times.last().copied().unwrap_or(0.0);
    // as long as there are times, every flight is searched to the last of them
    let limits = SearchLimits { periods: limits.periods.max(last / osc.period()), ..limits };
    let mut motion = Motion::with_limits(osc, start, limits);
    let mut leg: Option<(Leg, f64)> = None;
    times.iter().map(|time| state(osc, &mut motion, &mut leg, *time)).collect()
}

/// The state at one time. `leg` is the last leg of the motion, and the time up to which it is known.
fn state(osc: &Oscillator, motion: &mut Motion<'_>, leg: &mut Option<(Leg, f64)>, time: f64) -> Option<Start> {
    if time.is_nan() || time < 0.0 {
        return None;
    }
    loop {
        if let Some((leg, end)) = leg
            && time < *end
        {
            return Some(leg.start(osc, time - leg.begin));
        }
        if motion.end().is_some() {
            return None;
        }
        let event = motion.next();
        let now = *motion.leg()?;
        // the time of the event itself, which the sum of a beginning and a duration may miss by a rounding
        let end = match (event, motion.end()) {
            (Some(event), _) => event.time,
            (None, Some(End::NoneFor(time))) => now.begin + time,
            (None, _) => now.begin + now.duration,
        };
        *leg = Some((now, end));
    }
}
