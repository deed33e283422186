//! The events of one motion, up to a number of impacts, forcing periods or a time, and the reason why the list ends.

mod machine;
mod plan;

use crate::{Control, Stopped};
pub(crate) use machine::simulate as simulate_machine;
pub use machine::{events_with_states, motion_limits};
pub use plan::SimulatePlan;
use vibroimpact::flight::SearchLimits;
use vibroimpact::motion::{End, Event, EventKind, Motion};
use vibroimpact::verdict::NoImpact;
use vibroimpact::{Oscillator, Start};

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
    /// The time at which it ends at the latest; infinite without such a limit.
    pub until: f64,
    /// Why an oscillator has no more impacts, if this is decided.
    pub horizon: Option<NoImpact>,
    /// The time up to which a waveform is worth showing: not far beyond the last event if none follows it.
    pub shown_until: f64,
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
    /// Up to the lengths of a plan.
    pub(crate) fn new(osc: &Oscillator, plan: &SimulatePlan) -> Self {
        let (search, period, until) = (SearchLimits::default(), osc.period(), plan.until(Some(osc.period())));
        // a period more, so that rounding does not end the search before the time
        let periods = if until.is_finite() { until / period + 1.0 } else { 0.0 };
        let search = SearchLimits { periods: search.periods.max(periods), ..search };
        Self { impacts: plan.most_impacts(), until, period, search }
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

/// Follows a motion from a start up to the lengths of a plan.
///
/// # Errors
/// [`Stopped`] when stopped by its control.
pub fn simulate(
    osc: &Oscillator,
    start: Start,
    plan: &SimulatePlan,
    control: &Control<'_>,
) -> Result<Simulated, Stopped> {
    let bounds = Bounds::new(osc, plan);
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
        _ if bounds.until.is_finite() => bounds.until,
        _ => time + 5.0 * osc.period(),
    };
    Ok(Simulated { events, reason, time, until: bounds.until, horizon, shown_until })
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

    fn plan() -> SimulatePlan {
        SimulatePlan::default()
    }

    #[test]
    fn each_end_has_its_reason() {
        let osc = vibroimpact::scenario::N.oscillator();
        let follow = |osc: &Oscillator, plan| simulate(osc, Start::at_rest(osc), &plan, &Control::default()).unwrap();
        let run = |osc: &Oscillator, impacts, periods| follow(osc, SimulatePlan { impacts, periods, ..plan() });
        let some = run(&osc, Some(7), None);
        assert_eq!((some.reason, some.events.len()), ("impact_limit", 7));
        let timed = run(&osc, None, Some(3.0));
        assert_eq!((timed.reason, timed.time), ("time_limit", 3.0 * osc.period()));
        let shorter = follow(&osc, SimulatePlan { periods: Some(3.0), time: Some(some.events[4].time), ..plan() });
        assert_eq!((shorter.reason, shorter.time, shorter.events.len()), ("time_limit", some.events[4].time, 5));
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
        let stopped = simulate(&osc, Start::at_rest(&osc), &SimulatePlan { impacts: Some(5), ..plan() }, &control);
        assert_eq!(stopped, Err(Stopped { done: 0, total: 5 }));
    }
}
