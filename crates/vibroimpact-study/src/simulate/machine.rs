//! The events of a motion of a machine, up to a number of events or forcing periods, and the reason why the list ends.

use super::{SEARCH_LIMIT, TELL, most_impacts};
use crate::{Control, PlanError, RunError, Simulated, Stopped};
use vibroimpact::events::{End, Event, Limits, Motion, Start};
use vibroimpact::machine::Machine;

/// Follows a motion up to the given number of events and of forcing periods.
pub(crate) fn simulate(
    machine: &Machine,
    start: &Start,
    (impacts, periods): (Option<u64>, Option<f64>),
    control: &Control<'_>,
) -> Result<Simulated<Event>, RunError> {
    let most = most_impacts(impacts, periods);
    let until = periods.zip(machine.period()).map_or(f64::INFINITY, |(periods, period)| periods * period);
    let limits = limits(until);
    let mut motion = Motion::new(machine, start, limits).map_err(|error| PlanError::Machine(error.into()))?;
    let mut events: Vec<Event> = Vec::new();
    let (reason, time) = loop {
        let count = events.len() as u64;
        if count >= most {
            break ("event_limit", events.last().map_or(0.0, |event| event.time));
        }
        if control.stopping() {
            return Err(Stopped { done: count, total: most }.into());
        }
        let Some(event) = motion.next() else {
            let time = motion.time().min(until);
            let last = events.last().map_or(0.0, |event| event.time);
            break match motion.end() {
                // for ever, whatever the limit
                end @ Some(End::Never | End::Stuck) => (name(end), last),
                end => (if motion.time() >= until { "time_limit" } else { name(end) }, time),
            };
        };
        if event.time > until {
            break ("time_limit", until);
        }
        events.push(event);
        if (events.len() as u64).is_multiple_of(TELL) {
            (control.progress)(events.len() as u64);
        }
    };
    let last = events.last().map_or(0.0, |event| event.time);
    let for_ever = matches!(reason, "no_more_impacts" | "stuck");
    let after =
        if for_ever || reason == "time_limit" && until.is_infinite() { beyond(machine, &events) } else { time - last };
    let shown_until = (last + after).min(if for_ever { until } else { time });
    Ok(Simulated { events, reason, time, horizon: None, shown_until })
}

/// The events of a motion again, each with the state from which the motion goes on after it. They are followed anew, so that
/// the states of a long motion need no memory.
///
/// # Errors
/// [`PlanError`] for an invalid start.
pub fn events_with_states<'a>(
    machine: &'a Machine,
    start: &Start,
    periods: Option<f64>,
) -> Result<Motion<'a>, PlanError> {
    let until = periods.zip(machine.period()).map_or(f64::INFINITY, |(periods, period)| periods * period);
    Motion::with_states(machine, start, limits(until)).map_err(|error| PlanError::Machine(error.into()))
}

/// The limits of a search for events until a time.
pub(crate) fn limits(until: f64) -> Limits {
    let limits = Limits::default();
    Limits { time: if until.is_finite() { limits.time.max(until) } else { limits.time }, ..limits }
}

/// For how long a motion without further events is worth showing: five periods of the forcing, or as long again.
fn beyond(machine: &Machine, events: &[Event]) -> f64 {
    let last = events.last().map_or(0.0, |event| event.time);
    machine.period().map_or(if last > 0.0 { 0.5 * last } else { 10.0 }, |period| 5.0 * period)
}

/// The name of an end.
const fn name(end: Option<End>) -> &'static str {
    match end {
        Some(End::Never) => "no_more_impacts",
        Some(End::Stuck) => "stuck",
        None | Some(End::SearchLimit) => SEARCH_LIMIT,
        Some(End::NoEventWithin) => "time_limit",
        Some(End::Inconsistent) => "inconsistent",
        Some(End::Collapse) => "collapse",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{MachineSource, no_files};
    use core::sync::atomic::AtomicBool;

    fn machine(text: &str) -> Machine {
        MachineSource::from_text(text, no_files).unwrap().machine().unwrap()
    }

    #[test]
    fn each_end_has_its_reason() {
        let driven = machine(
            "[machine]\nbodies = { a = 1 }\nfrequency = 0.7\nlink = [{ between = [\"a\", \"ground\"], stiffness = 1 }]\n\
             force = [{ at = \"a\", sin = 1 }]\nstop = [{ name = \"s\", at = \"a\", gap = 0.2, restitution = 0.5 }]",
        );
        let run =
            |impacts, periods| simulate(&driven, &Start::default(), (impacts, periods), &Control::default()).unwrap();
        let some = run(Some(7), None);
        assert_eq!((some.reason, some.events.len(), some.time), ("event_limit", 7, some.events[6].time));
        let timed = run(None, Some(3.0));
        assert_eq!((timed.reason, timed.time), ("time_limit", 3.0 * driven.period().unwrap()));
        assert!(timed.events.len() > 3 && timed.shown_until == timed.time);
        let free =
            machine("[machine]\nbodies = { a = 1 }\nstop = [{ name = \"s\", at = \"a\", gap = 1, restitution = 0.5 }]");
        let start = Start { qdot: vec![2.0], ..Start::default() };
        let left = simulate(&free, &start, (None, None), &Control::default()).unwrap();
        assert_eq!((left.reason, left.events.len(), left.time, left.shown_until), ("no_more_impacts", 1, 0.5, 0.75));
    }

    #[test]
    fn the_flag_stops_it() {
        let ball = machine("[machine]\nbodies = { a = 1 }");
        let stop = AtomicBool::new(true);
        let control = Control { stop: &stop, ..Control::default() };
        let stopped = simulate(&ball, &Start::default(), (Some(5), None), &control);
        assert_eq!(stopped, Err(RunError::Stopped(Stopped { done: 0, total: 5 })));
    }
}
