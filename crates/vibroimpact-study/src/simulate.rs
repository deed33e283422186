//! The events of one motion, up to a number of impacts or forcing periods, and the reason why the list ends.

use crate::{Control, Stopped};
use vibroimpact::flight::SearchLimits;
use vibroimpact::motion::{End, Event, EventKind, Motion};
use vibroimpact::verdict::NoImpact;
use vibroimpact::{Oscillator, Start};

/// Number of impacts if neither impacts nor periods are given.
const DEFAULT_IMPACTS: u64 = 100;
/// Number of impacts if only a number of periods is given.
const MOST_IMPACTS: u64 = 1_000_000;
/// Number of consecutive grazing contacts, sticks and releases without an impact after which the motion is not followed
/// further.
const IDLE: u32 = 1000;

/// Number of impacts between two reports of progress.
const TELL: u64 = 1024;

/// The events of a motion and the reason why the list ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulated {
    /// The events, in order.
    pub events: Vec<Event>,
    /// The reason why the list ends: `impact_limit`, `time_limit`, `no_more_impacts`, `stuck` or `search_limit`.
    pub reason: &'static str,
    /// The time at which the list ends.
    pub time: f64,
    /// Why there are no more impacts, if this is decided.
    pub horizon: Option<NoImpact>,
}

/// The number of impacts to follow, with defaults applied.
#[must_use]
pub(crate) fn most_impacts(impacts: Option<u64>, periods: Option<f64>) -> u64 {
    impacts.unwrap_or(if periods.is_some() { MOST_IMPACTS } else { DEFAULT_IMPACTS })
}

/// Follows a motion up to the given number of impacts and of forcing periods; 100 impacts, or a million with `periods`,
/// when absent.
///
/// # Errors
/// [`Stopped`] when stopped by its control.
pub fn simulate(
    osc: &Oscillator,
    start: Start,
    (impacts, periods): (Option<u64>, Option<f64>),
    control: &Control<'_>,
) -> Result<Simulated, Stopped> {
    let impacts = most_impacts(impacts, periods);
    let limits = SearchLimits::default();
    let limits = SearchLimits { periods: limits.periods.max(periods.unwrap_or(0.0)), ..limits };
    let until = periods.map_or(f64::INFINITY, |n| n * osc.period());
    let mut motion = Motion::with_limits(osc, start, limits);
    let mut events: Vec<Event> = Vec::new();
    let (mut struck, mut idle) = (0, 0);
    let (reason, time, horizon) = loop {
        let last = events.last().map_or(0.0, |event| event.time);
        if control.stopping() {
            return Err(Stopped { done: struck, total: impacts });
        }
        let Some(event) = motion.next() else {
            break ended(motion.end(), last, until, osc.period());
        };
        if event.time > until {
            break ("time_limit", until, None);
        }
        events.push(event);
        if let EventKind::Impact { .. } = event.kind {
            (struck, idle) = (struck + 1, 0);
            if struck % TELL == 0 {
                (control.progress)(struck);
            }
            if struck >= impacts {
                break ("impact_limit", event.time, None);
            }
        } else {
            idle += 1;
            if idle >= IDLE {
                let phase = event.phase;
                break ("no_more_impacts", event.time, Some(NoImpact::Grazing { phase }));
            }
        }
    };
    Ok(Simulated { events, reason, time, horizon })
}

/// The reason why no further event came; `last` is the time of the last event.
fn ended(end: Option<End>, last: f64, until: f64, period: f64) -> (&'static str, f64, Option<NoImpact>) {
    match end {
        Some(End::Never(why)) => ("no_more_impacts", last, Some(NoImpact::Flight(why))),
        Some(End::Stuck(_)) => ("stuck", last, None),
        Some(End::NoneFor(time)) if last + time >= until => ("time_limit", until, None),
        Some(End::NoneFor(time)) => {
            let periods = (time / period).floor();
            let horizon = Some(NoImpact::ForPeriods(periods));
            // 999 or more: the search reached its horizon; otherwise it used up its steps before
            if periods >= 999.0 { ("no_more_impacts", last, horizon) } else { ("search_limit", last, horizon) }
        }
        None => ("search_limit", last, None),
    }
}

impl Simulated {
    /// The time up to which a waveform is worth showing: a little beyond the last event if no event follows it.
    #[must_use]
    pub fn shown_until(&self, osc: &Oscillator) -> f64 {
        match self.reason {
            "impact_limit" | "time_limit" => self.time,
            _ => self.time + 5.0 * osc.period(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::sync::atomic::AtomicBool;

    #[test]
    fn each_end_has_its_reason() {
        let osc = vibroimpact::scenario::N.oscillator();
        let run = |osc: &Oscillator, impacts, periods| {
            simulate(osc, Start::at_rest(osc), (impacts, periods), &Control::default()).unwrap()
        };
        let some = run(&osc, Some(7), None);
        assert_eq!((some.reason, some.events.len()), ("impact_limit", 7));
        let timed = run(&osc, None, Some(3.0));
        assert_eq!((timed.reason, timed.time), ("time_limit", 3.0 * osc.period()));
        let pressed = Oscillator::new(0.9, -1.5, 0.5).unwrap();
        assert_eq!(run(&pressed, Some(10), None).reason, "stuck");
        let far = Oscillator::new(0.5, 40.0, 0.5).unwrap();
        let none = run(&far, Some(10), None);
        assert_eq!((none.reason, none.events.len()), ("no_more_impacts", 0));
        assert!(none.horizon.is_some() && none.shown_until(&far) == 5.0 * far.period());
    }

    #[test]
    fn the_flag_stops_it() {
        let osc = vibroimpact::scenario::N.oscillator();
        let stop = AtomicBool::new(true);
        let control = Control { stop: &stop, ..Control::default() };
        let stopped = simulate(&osc, Start::at_rest(&osc), (Some(5), None), &control);
        assert_eq!(stopped, Err(Stopped { done: 0, total: 5 }));
    }
}
