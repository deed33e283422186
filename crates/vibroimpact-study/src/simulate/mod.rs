//! The events of one motion, up to a number of impacts or forcing periods, and the reason why the list ends.

mod machine;

use crate::{Control, PlanError, Stopped, limits};
pub use machine::events_with_states;
pub(crate) use machine::{limits as limits_until, simulate as simulate_machine};
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

/// The reason of a list of events that ends because the search for the next one used all its steps.
pub const SEARCH_LIMIT: &str = "search_limit";

/// Number of impacts or events between two reports of progress.
pub(crate) const TELL: u64 = 1024;

/// The events of a motion of any system and the reason why the list ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulated<E = Event> {
    /// The events, in order.
    pub events: Vec<E>,
    /// The reason why the list ends: `impact_limit` (of a machine `event_limit`), `time_limit`, `no_more_impacts`, `stuck` or
    /// `search_limit`; of a machine also `inconsistent` or `collapse`.
    pub reason: &'static str,
    /// The time at which the list ends.
    pub time: f64,
    /// Why an oscillator has no more impacts, if this is decided.
    pub horizon: Option<NoImpact>,
    /// The time up to which a waveform is worth showing: not far beyond the last event if none follows it.
    pub shown_until: f64,
}

/// The number of impacts, of a machine of events, to follow, with defaults applied.
#[must_use]
pub fn most_impacts(impacts: Option<u64>, periods: Option<f64>) -> u64 {
    impacts.unwrap_or(if periods.is_some() { MOST_IMPACTS } else { DEFAULT_IMPACTS })
}

/// Checks the numbers of events and of forcing periods of a simulation.
pub(crate) fn check_lengths(impacts: Option<u64>, periods: Option<f64>) -> Result<(), PlanError> {
    impacts.map_or(Ok(()), |given| limits::check("impacts", given, 1..=10_000_000))?;
    match periods.filter(|n| !(*n > 0.0 && *n <= 1e9)) {
        Some(given) => Err(PlanError::OutOfRange {
            name: "periods",
            given: given.to_string(),
            range: "0 < periods <= 1e9".to_owned(),
            hint: "",
        }),
        None => Ok(()),
    }
}

/// The reason why a list of events ends, the time at which it ends, and why there are no more impacts, if this is decided.
pub(crate) type Ended = (&'static str, f64, Option<NoImpact>);

/// When a list of events ends.
pub(crate) struct Bounds {
    pub(crate) impacts: u64,
    until: f64,
    period: f64,
    /// The limits of the search for each contact.
    pub(crate) search: SearchLimits,
}

/// The events of a motion so far.
#[derive(Clone, Copy, Default)]
pub(crate) struct SoFar {
    /// The number of impacts.
    pub(crate) struck: u64,
    /// The number of events since the last impact.
    idle: u32,
    /// The time of the last event.
    last: f64,
}

impl Bounds {
    /// Up to the given number of impacts and of forcing periods; 100 impacts, or a million with `periods`, when absent.
    pub(crate) fn new(osc: &Oscillator, (impacts, periods): (Option<u64>, Option<f64>)) -> Self {
        let search = SearchLimits::default();
        Self {
            impacts: most_impacts(impacts, periods),
            until: periods.map_or(f64::INFINITY, |n| n * osc.period()),
            period: osc.period(),
            search: SearchLimits { periods: search.periods.max(periods.unwrap_or(0.0)), ..search },
        }
    }

    /// Whether the next event of a motion belongs to the list, and the end if the list ends with it or before it.
    #[inline]
    pub(crate) fn next(&self, so_far: &mut SoFar, event: &Event) -> (bool, Option<Ended>) {
        if event.time > self.until {
            return (false, Some(("time_limit", self.until, None)));
        }
        so_far.last = event.time;
        let end = if let EventKind::Impact { .. } = event.kind {
            (so_far.struck, so_far.idle) = (so_far.struck + 1, 0);
            (so_far.struck >= self.impacts).then_some(("impact_limit", event.time, None))
        } else {
            so_far.idle += 1;
            let horizon = Some(NoImpact::Grazing { phase: event.phase });
            (so_far.idle >= IDLE).then_some(("no_more_impacts", event.time, horizon))
        };
        (true, end)
    }

    /// The end of a list if no event follows those so far.
    pub(crate) fn ended(&self, so_far: &SoFar, end: Option<End>) -> Ended {
        ended(end, so_far.last, self.until, self.period)
    }
}

/// Follows a motion up to the given number of impacts and of forcing periods; 100 impacts, or a million with `periods`,
/// when absent.
///
/// # Errors
/// [`Stopped`] when stopped by its control.
pub fn simulate(
    osc: &Oscillator,
    start: Start,
    limits: (Option<u64>, Option<f64>),
    control: &Control<'_>,
) -> Result<Simulated, Stopped> {
    let bounds = Bounds::new(osc, limits);
    let mut motion = Motion::with_limits(osc, start, bounds.search);
    let mut events: Vec<Event> = Vec::new();
    let mut so_far = SoFar::default();
    let (reason, time, horizon) = loop {
        if control.stopping() {
            return Err(Stopped { done: so_far.struck, total: bounds.impacts });
        }
        let Some(event) = motion.next() else {
            break bounds.ended(&so_far, motion.end());
        };
        let before = so_far.struck;
        let (listed, end) = bounds.next(&mut so_far, &event);
        if listed {
            events.push(event);
        }
        if so_far.struck > before && so_far.struck.is_multiple_of(TELL) {
            (control.progress)(so_far.struck);
        }
        if let Some(end) = end {
            break end;
        }
    };
    let shown_until = match reason {
        "impact_limit" | "time_limit" => time,
        _ => time + 5.0 * osc.period(),
    };
    Ok(Simulated { events, reason, time, horizon, shown_until })
}

/// The reason why no further event came; `last` is the time of the last event.
fn ended(end: Option<End>, last: f64, until: f64, period: f64) -> Ended {
    match end {
        Some(End::Never(why)) => ("no_more_impacts", last, Some(NoImpact::Flight(why))),
        Some(End::Stuck(_)) => ("stuck", last, None),
        Some(End::NoneFor(time)) if last + time >= until => ("time_limit", until, None),
        Some(End::NoneFor(time)) => {
            let periods = (time / period).floor();
            let horizon = Some(NoImpact::ForPeriods(periods));
            // 999 or more: the search reached its horizon; otherwise it used up its steps before
            if periods >= 999.0 { ("no_more_impacts", last, horizon) } else { (SEARCH_LIMIT, last, horizon) }
        }
        None => (SEARCH_LIMIT, last, None),
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
        assert!(none.horizon.is_some() && none.shown_until == 5.0 * far.period());
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
