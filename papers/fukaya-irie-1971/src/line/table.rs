//! The events as a table in Markdown.

use super::beside::{Seen, Sides, sides};
use super::branches::{Event, Kind, at};
use crate::Error;
use std::fmt::Write as _;
use vibroimpact::Start;
use vibroimpact::verdict::{SettleOptions, settle};

/// One row for each event, and rows for the ends of the line.
pub(super) fn markdown(events: &[Event]) -> Result<String, Error> {
    let mut text = String::from(
        "| $\\delta$ | event | orbits | simulated just below | simulated just above | at $\\pm$ | confirmed |\n\
         |--:|---|---|---|---|--:|---|\n",
    );
    let mut confirmed = 0;
    for (k, event) in events.iter().enumerate() {
        let others = events.iter().enumerate().filter(|(j, _)| *j != k);
        let room = others.map(|(_, other)| (other.gap - event.gap).abs()).fold(f64::INFINITY, f64::min);
        let found = sides(event, room)?;
        confirmed += usize::from(found.confirmed);
        let _ = writeln!(
            text,
            "| {:.12} | {} | {} | {} | {} | {:.0e} | {} |",
            event.gap,
            name(event.kind),
            labels(event),
            told(&found.below),
            above(event, &found),
            found.off,
            if found.confirmed { "yes" } else { "no" }
        );
    }
    let _ = writeln!(text, "\n{confirmed} of {} events are confirmed by simulation on both sides.", events.len());
    let f = at(0.0)?.free_amplitude();
    let below: Vec<String> = [-0.4, -0.7, -1.0].iter().map(|gap| from_rest(*gap)).collect::<Result<_, _>>()?;
    let _ = writeln!(
        text,
        "The amplitude without a stop is $|f|$ = {f:.12}. Further down a motion from rest ends as {}.",
        below.join(", ")
    );
    Ok(text)
}

fn from_rest(gap: f64) -> Result<String, Error> {
    let osc = at(gap)?;
    let end = settle(&osc, Start::at_rest(&osc), &SettleOptions::default()).verdict;
    Ok(format!("{} at {gap}", end.label()))
}

const fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Flip => "flip",
        Kind::Fold => "fold",
        Kind::Grazing => "grazing",
        Kind::LossOfContact => "loss of contact",
    }
}

fn labels(event: &Event) -> String {
    let mut labels: Vec<String> = event.orbits.iter().map(|orbit| orbit.label().to_string()).collect();
    if event.kind == Kind::Fold {
        labels.truncate(1);
        return format!("{} twice", labels.concat());
    }
    labels.join(", ")
}

/// The orbits that exist, stable (s) or unstable (u); for an unstable one also the motion into which a neighbouring
/// motion settles.
fn told(seen: &[Seen]) -> String {
    let mut ends: Vec<String> = Vec::new();
    let there: Vec<String> = seen
        .iter()
        .filter(|orbit| {
            if !orbit.attracts && !ends.contains(&orbit.ends) {
                ends.push(orbit.ends.clone());
            }
            orbit.repeats
        })
        .map(|orbit| format!("{} {}", orbit.label, if orbit.attracts { "s" } else { "u" }))
        .collect();
    let there = if there.is_empty() { "none".to_owned() } else { there.join(", ") };
    if ends.is_empty() { there } else { format!("{there} → {}", ends.join(", ")) }
}

fn above(event: &Event, found: &Sides) -> String {
    let told = told(&found.above);
    if event.kind == Kind::LossOfContact && found.confirmed { format!("{told}; free motion") } else { told }
}
