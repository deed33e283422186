//! The events of a motion of a machine, up to a number of events, forcing periods or a time, and the reason why the list ends.

use super::{SEARCH_LIMIT, SimulatePlan, TELL};
use crate::{Control, PlanError, RunError, Simulated, Stopped};
use vibroimpact::events::{End, Event, Limits, Motion, Start};
use vibroimpact::machine::Machine;
use vibroimpact::verdict::machine::longest_flight;

/// Follows a motion from a start up to the lengths of a plan.
pub(crate) fn simulate(
    machine: &Machine,
    start: &Start,
    plan: &SimulatePlan,
    control: &Control<'_>,
) -> Result<Simulated<Event>, RunError> {
    let (most, until) = (plan.most_impacts(), plan.until(machine.period()));
    let mut motion =
        Motion::new(machine, start, motion_limits(machine, until)).map_err(|error| PlanError::Machine(error.into()))?;
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
    let shown_until = match (for_ever, until.is_finite()) {
        (true, true) => until,
        (true, false) => last + beyond(machine, &events),
        (false, false) if reason == "time_limit" => time.min(last + beyond(machine, &events)),
        (false, _) => time,
    };
    Ok(Simulated { events, reason, time, until, horizon: None, shown_until })
}

/// The events of a motion again, up to this time, each with the state from which the motion goes on after it. They are followed
/// anew, so that the states of a long motion need no memory.
///
/// # Errors
/// [`PlanError`] for an invalid start.
pub fn events_with_states<'a>(machine: &'a Machine, start: &Start, until: f64) -> Result<Motion<'a>, PlanError> {
    Motion::with_states(machine, start, motion_limits(machine, until)).map_err(|error| PlanError::Machine(error.into()))
}

/// The limits of a motion until a time, which may be infinite: a flight is followed up to then, and for as long as for a verdict, which does
/// not depend on the unit of time.
#[must_use]
pub fn motion_limits(machine: &Machine, until: f64) -> Limits {
    let longest = longest_flight(machine);
    Limits { time: if until.is_finite() { longest.max(until) } else { longest }, ..Limits::default() }
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
        let follow = |plan| simulate(&driven, &Start::default(), &plan, &Control::default()).unwrap();
        let run = |impacts, periods| follow(SimulatePlan { impacts, periods, ..SimulatePlan::default() });
        let some = run(Some(7), None);
        assert_eq!((some.reason, some.events.len(), some.time), ("event_limit", 7, some.events[6].time));
        let timed = run(None, Some(3.0));
        assert_eq!((timed.reason, timed.time), ("time_limit", 3.0 * driven.period().unwrap()));
        assert!(timed.events.len() > 3 && timed.shown_until == timed.time);
        let free =
            machine("[machine]\nbodies = { a = 1 }\nstop = [{ name = \"s\", at = \"a\", gap = 1, restitution = 0.5 }]");
        let start = Start { qdot: vec![2.0], ..Start::default() };
        let from = |plan| simulate(&free, &start, &plan, &Control::default()).unwrap();
        let left = from(SimulatePlan::default());
        assert_eq!((left.reason, left.events.len(), left.time, left.shown_until), ("no_more_impacts", 1, 0.5, 0.75));
        let timed = from(SimulatePlan { time: Some(3.0), ..SimulatePlan::default() });
        assert_eq!((timed.reason, timed.time, timed.shown_until), ("no_more_impacts", 0.5, 3.0));
        let before = from(SimulatePlan { time: Some(0.25), ..SimulatePlan::default() });
        assert_eq!(
            (before.reason, before.events.len(), before.time, before.shown_until),
            ("time_limit", 0, 0.25, 0.25)
        );
    }

    #[test]
    fn the_flag_stops_it() {
        let ball = machine("[machine]\nbodies = { a = 1 }");
        let stop = AtomicBool::new(true);
        let control = Control { stop: &stop, ..Control::default() };
        let stopped =
            simulate(&ball, &Start::default(), &SimulatePlan { impacts: Some(5), ..SimulatePlan::default() }, &control);
        assert_eq!(stopped, Err(RunError::Stopped(Stopped { done: 0, total: 5 })));
    }
}
