//! `vibro simulate --machine`: the events of a machine.

use crate::failure::Failure;
use crate::report::machine_events as text;
use crate::session::Session;
use vibroimpact::events::{MachineLimits, MachineMotion, MachineStart};
use vibroimpact::machine::Machine;
use vibroimpact_report::json::MachineEvents;

/// The number of events without a limit, and with a number of periods.
const EVENTS: u64 = 100;
const EVENTS_IN_PERIODS: u64 = 1_000_000;

pub(super) fn run(
    (name, machine, start): (&str, &Machine, &MachineStart),
    (events, periods): (Option<u64>, Option<f64>),
    json: bool,
    session: &Session,
) -> Result<(), Failure> {
    let time = match (periods, machine.period()) {
        (None, _) => f64::INFINITY,
        (Some(periods), Some(period)) if periods > 0.0 && periods <= 1e9 => periods * period,
        (Some(periods), Some(_)) => {
            return Err(Failure::bad(format!("periods = {periods} lies outside 0 < periods <= 1e9")));
        }
        (Some(_), None) => {
            return Err(Failure::bad(format!(
                "`{name}` has no forcing, so no forcing periods\nhint: --impacts N limits the number of events"
            )));
        }
    };
    let most = events.unwrap_or(if periods.is_some() { EVENTS_IN_PERIODS } else { EVENTS });
    let mut motion = MachineMotion::new(machine, start, MachineLimits::default())
        .map_err(|error| Failure::bad(error.to_string()))?;
    let mut found = Vec::new();
    let mut end = None;
    let mut until = 0.0;
    while (found.len() as u64) < most {
        let Some(event) = motion.next() else {
            end = motion.end();
            until = motion.time();
            break;
        };
        if event.time > time {
            (end, until) = (Some(vibroimpact::events::MachineEnd::NoEventWithin), time);
            break;
        }
        until = event.time;
        found.push(event);
    }
    if json {
        return session.print_json(&MachineEvents::new((name, machine), start, &found, (end, until)));
    }
    session.print(&text::events(machine, &found, (end, until)))
}
