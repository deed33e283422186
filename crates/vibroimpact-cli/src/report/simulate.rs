//! The events of a motion as text.

use crate::report::words::{meaning, table};
use vibroimpact::motion::EventKind;
use vibroimpact_report::Asked;
use vibroimpact_report::number::short;
use vibroimpact_study::Simulated;

/// The events, and the reason why the list ends.
pub(crate) fn text(followed: &Simulated, asked: &Asked) -> String {
    let units = &asked.units;
    let heads = [
        units.named("time", "s"),
        "phase".into(),
        "<event".into(),
        units.named("before", "m/s"),
        units.named("after", "m/s"),
    ];
    let both = asked.system.second_stop.is_some();
    let rows: Vec<Vec<String>> = followed
        .events
        .iter()
        .map(|event| {
            let mut row = vec![short(event.time * units.time()), short(event.phase)];
            let at = if both && event.side == vibroimpact::Side::Lower { " (second stop)" } else { "" };
            let name = match event.kind {
                EventKind::Impact { .. } => "impact",
                EventKind::Graze { .. } => "graze",
                EventKind::Stick { chatter: true, .. } => "stick after chatter",
                EventKind::Stick { chatter: false, .. } => "stick",
                EventKind::Release => "release",
            };
            row.push(format!("{name}{at}"));
            if let EventKind::Impact { velocity_before, velocity_after } = event.kind {
                row.push(short(velocity_before * units.velocity()));
                row.push(short(velocity_after * units.velocity()));
            }
            row
        })
        .collect();
    let mut text = if rows.is_empty() { "no events\n".to_owned() } else { table(&heads, &rows) };
    let time = short(followed.time * units.time());
    text.push_str(&match (followed.reason, &followed.horizon) {
        ("no_more_impacts", Some(horizon)) => {
            let why = vibroimpact::verdict::Verdict::NoImpact(*horizon);
            format!("end     after time {time}: {}\n", meaning(&why))
        }
        ("stuck", _) => format!("end     after time {time}: it stays on the stop for ever\n"),
        ("impact_limit", _) => format!("end     at time {time}: the number of impacts asked for\n"),
        ("time_limit", _) => format!("end     at time {time}: the number of periods asked for\n"),
        _ => format!("end     after time {time}: the search for the next impact ran out of steps\n"),
    });
    text
}
