//! The events of machines against an independent simulation in high precision (see README.md here).

#[cfg(test)]
mod accumulation;
#[cfg(test)]
mod branches;
#[cfg(test)]
mod branches_at_corners;
#[cfg(test)]
mod branches_beyond;
#[cfg(test)]
mod branches_unforced;
#[cfg(test)]
mod case;
#[cfg(test)]
mod closed_forms;
#[cfg(test)]
mod collapse;
#[cfg(test)]
mod curves;
#[cfg(test)]
mod curves_unforced;
#[cfg(test)]
mod drift;
#[cfg(test)]
mod equal_parts;
#[cfg(test)]
mod exponents;
#[cfg(test)]
mod limit_cycles;
#[cfg(test)]
mod no_impact;
#[cfg(test)]
mod one_instant;
#[cfg(test)]
mod quantities;
mod regions;
#[cfg(test)]
mod rounding;
#[cfg(test)]
mod samples;
#[cfg(test)]
mod small_mass;
#[cfg(test)]
mod stability;
#[cfg(test)]
mod state;
#[cfg(test)]
mod sticking;
#[cfg(test)]
mod verdicts;

use case::{Case, cases};
use std::fmt::Write as _;
use vibroimpact::events::{Event, EventKind, Limits, Motion};

/// Roundings of the time and of its condition that are allowed.
const ROUNDINGS: f64 = 50.0;

/// What differs first, with its event.
fn difference(case: &Case) -> Option<String> {
    let limits = Limits { time: 1e3, ..Limits::default() };
    let motion = match Motion::new(&case.machine, &case.start, limits) {
        Ok(motion) => motion,
        Err(error) => return Some(format!("refused: {error}")),
    };
    let mut motion = motion.filter(|event| event.kind != EventKind::Graze);
    for (k, want) in case.events.iter().take(case.robust).enumerate() {
        let Some(event) = motion.next() else { return Some(format!("event {k}: none, {want:?} wanted")) };
        // what follows the sum of a chatter is compared in `after_chatter`
        let sums = matches!(event.kind, EventKind::Stick | EventKind::Collapse);
        if sums && want.kind == "impact" {
            return None;
        }
        let name = case.machine.name_of(event.place);
        if (event.kind.name(), name) != (want.kind.as_str(), want.stop.as_str()) {
            return Some(format!("event {k}: {} {name} at {:e}, {want:?} wanted", event.kind.name(), event.time));
        }
        let allowed = ROUNDINGS * f64::EPSILON * (want.condition + want.time);
        if (event.time - want.time).abs() > allowed {
            let error = (event.time - want.time) / (f64::EPSILON * (want.condition + want.time));
            return Some(format!(
                "event {k}: {} {name} at {:e}, {want:?} wanted: {error:e} roundings",
                event.kind.name(),
                event.time
            ));
        }
        // vectors have no speeds of openings
        let speed = if want.kind == "open" { separation(case, &event) } else { want.speed };
        // the speed of a stop that is nearly missed is sensitive; vectors have no condition for it
        if (event.speed - speed).abs() > 1e-9 * (1.0 + want.condition) && want.kind != "slip" {
            return Some(format!("event {k}: speed {:e}, {want:?} wanted", event.speed));
        }
        if let Some(wrong) =
            case.states.iter().find(|state| state.event == k).and_then(|state| state.differs(&event, ROUNDINGS))
        {
            return Some(format!("event {k}: {wrong}"));
        }
    }
    None
}

/// The speed at which the body leaves the stop of an event.
fn separation(case: &Case, event: &Event) -> f64 {
    let stop = &case.machine.stops()[event.place];
    let body: f64 = stop.direction.iter().zip(&event.qdot).map(|(w, v)| w * v).sum();
    let frequency = case.machine.parts().frequency.unwrap_or(0.0);
    let moving = stop.motion.iter().map(|motion| {
        let order = f64::from(motion.order);
        let (sin, cos) = (order * event.phase).sin_cos();
        order * frequency * (motion.sin * cos - motion.cos * sin)
    });
    -body - moving.sum::<f64>()
}

/// The events after a chatter, by the time of its end.
fn after_chatter(case: &Case) -> Option<String> {
    let after = case.after_chatter.as_ref()?;
    let limits = Limits { time: 1e3, ..Limits::default() };
    let motion = Motion::new(&case.machine, &case.start, limits).ok()?;
    let first = after.events.first()?;
    let near =
        |event: &Event| event.kind == EventKind::Stick && (event.time - first.time).abs() < 1e-3 * (1.0 + first.time);
    let mut motion = motion.filter(|event| event.kind != EventKind::Graze).take(3000).skip_while(|event| !near(event));
    for (k, want) in after.events.iter().take(after.robust).enumerate() {
        let Some(event) = motion.next() else {
            return Some(format!("after chatter, event {k}: none, {want:?} wanted"));
        };
        if event.kind == EventKind::Stick && want.kind == "impact" && k > 0 {
            return None; // the next chatter is summed
        }
        let name = case.machine.name_of(event.place);
        // the sum has an error of 1e-11 of what is summed
        let allowed = 1e-10 * (1.0 + want.condition) + ROUNDINGS * f64::EPSILON * (want.condition + want.time);
        if (event.kind.name(), name) != (want.kind.as_str(), want.stop.as_str())
            || (event.time - want.time).abs() > allowed
        {
            return Some(format!(
                "after chatter, event {k}: {} {name} at {:e}, {want:?} wanted",
                event.kind.name(),
                event.time
            ));
        }
    }
    None
}

/// Many small vectors are allocated for each event.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

#[test]
fn events_in_high_precision() {
    let mut faults = String::new();
    let (mut events, mut all) = (0, 0);
    for (kind, cases) in cases() {
        let mut wrong = 0;
        for case in &cases {
            all += 1;
            events += case.robust;
            if let Some(difference) = difference(case).or_else(|| after_chatter(case)) {
                wrong += 1;
                writeln!(faults, "{}: {difference}", case.name).unwrap();
            }
        }
        if wrong > 0 {
            writeln!(faults, "== {kind}: {wrong} of {} differ", cases.len()).unwrap();
        }
    }
    assert!(faults.is_empty(), "{all} machines, {events} events\n{faults}");
}
