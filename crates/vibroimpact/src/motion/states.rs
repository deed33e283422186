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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::EventKind;
    use crate::scenario;

    /// At the times of events the states are those after them, and between them those of the closed form.
    #[test]
    fn at_events_and_between() {
        let osc = scenario::N.oscillator();
        let start = Start { x: -1.0, v: 0.3, phase: 0.5 };
        let events: Vec<_> = Motion::new(&osc, start).take(60).collect();
        let times: Vec<f64> = events.iter().map(|event| event.time).collect();
        for (event, state) in events.iter().zip(states_at(&osc, start, &times)) {
            let EventKind::Impact { velocity_after, .. } = event.kind else { continue };
            let state = state.unwrap();
            assert!((state.x - osc.gap()).abs() < 1e-15 && (state.v - velocity_after).abs() < 1e-14);
            assert!(crate::system::phase::difference(state.phase, event.phase).abs() < 1e-14);
        }
        let mut motion = Motion::new(&osc, start);
        for _ in 0..30 {
            motion.next();
            let leg = *motion.leg().unwrap();
            let time = leg.begin + 0.4 * leg.duration;
            let (x, v) = leg.state(&osc, 0.4 * leg.duration);
            let state = states_at(&osc, start, &[time])[0].unwrap();
            assert!((state.x - x).abs() < 1e-13 && (state.v - v).abs() < 1e-13);
        }
    }

    #[test]
    fn after_the_last_event_and_before_the_start() {
        let pressed = Oscillator::new(0.9, -1.5, 0.5).unwrap();
        let start = Start { x: -3.0, v: 0.0, phase: 0.0 };
        let states = states_at(&pressed, start, &[-1.0, 0.0, 1e4]);
        assert_eq!((states[0], states[1]), (None, Some(start)));
        assert_eq!(states[2].map(|state| (state.x, state.v)), Some((-1.5, 0.0)));
        // a flight without end
        let far = Oscillator::new(0.5, 40.0, 0.5).unwrap();
        let rest = Start::at_rest(&far);
        assert!(states_at(&far, rest, &[1e5])[0].is_some_and(|state| state.x.abs() < 40.0));
    }
}
