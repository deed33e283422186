//! The events of a machine as a table.

use core::fmt::Write;
use vibroimpact::machine::Machine;
use vibroimpact_report::number::short;
use vibroimpact_study::MachineSimulated;

/// One line for each event: time, kind, stop, speed, coordinates and velocities after it.
pub(crate) fn events(machine: &Machine, MachineSimulated { events, reason, time, .. }: &MachineSimulated) -> String {
    let wide = events.iter().map(|event| machine.name_of(event.place).len()).max().unwrap_or(0).max(4);
    let mut text = format!("{:>14}  {:<8} {:<wide$} {:>12}", "time", "event", "stop", "speed");
    for name in &machine.parts().coordinates {
        let _ = write!(text, " {name:>12}");
    }
    for name in &machine.parts().coordinates {
        let _ = write!(text, " {:>12}", format!("{name}'"));
    }
    text.push('\n');
    for event in events {
        let (kind, stop) = (event.kind.name(), machine.name_of(event.place));
        let _ = write!(text, "{:>14}  {kind:<8} {stop:<wide$} {:>12}", short(event.time), short(event.speed));
        for value in event.q.iter().chain(&event.qdot) {
            let _ = write!(text, " {:>12}", short(*value));
        }
        text.push('\n');
    }
    let why = match *reason {
        "event_limit" => "the number of events that was asked for".to_owned(),
        "no_more_impacts" => "no further event, for ever".to_owned(),
        "stuck" => "at rest on a stop, for ever".to_owned(),
        "time_limit" => format!("no further event up to time {}", short(*time)),
        other => other.replace('_', " "),
    };
    let _ = writeln!(text, "end: {why}");
    text
}
