//! The events of both.
//!
//! What an event may differ by is measured: the oscillator's motion is started again behind each event from states that
//! differ by a few roundings, and the changes of each later event are added up. Where such a change alters the sequence
//! of events, the rest of the motion is not determined by its numbers and is not compared.

use crate::{System, systems};
use vibroimpact::events;
use vibroimpact::events::Limits;
use vibroimpact::flight::SearchLimits;
use vibroimpact::motion::{End, Event, EventKind, Motion};
use vibroimpact::{Oscillator, Side, Start};

const EVENTS: usize = 50;
/// Longer flights are not compared.
const SEARCH: SearchLimits = SearchLimits { periods: 40.0, steps: 4000 };
/// The change of a state, in roundings of its terms.
const CHANGE: f64 = 8.0;
/// How often the sum of all changes the events may differ.
const OFTEN: f64 = 2.0;
/// Relative error of the duration of a chatter that is summed: that of a machine has two terms, not three.
const SUMMED: f64 = 1e-10;

/// Kind, place and speed as a machine has them.
fn told(event: &Event) -> (events::EventKind, usize, f64) {
    let place = usize::from(event.side == Side::Lower);
    match event.kind {
        EventKind::Impact { velocity_before, .. } => (events::EventKind::Impact, place, velocity_before),
        EventKind::Graze { .. } => (events::EventKind::Graze, place, 0.0),
        EventKind::Stick { .. } => (events::EventKind::Stick, place, 0.0),
        EventKind::Release => (events::EventKind::Release, place, 0.0),
    }
}

const fn is_graze(event: &Event) -> bool {
    matches!(event.kind, EventKind::Graze { .. })
}

/// What time, phase and speed of each event may differ by, and how many events are determined.
fn allowed(system: &System, events: &[Event]) -> (Vec<[f64; 3]>, usize) {
    let osc = &system.oscillator;
    let mut sums = vec![[0.0; 3]; events.len()];
    let mut determined = events.len();
    for begin in 0..=events.len() {
        if begin >= determined {
            break;
        }
        let (starts, time) = if begin == 0 {
            (around(osc, system.start, None, 0.0), 0.0)
        } else {
            let last = &events[begin - 1];
            let flown = last.time - if begin > 1 { events[begin - 2].time } else { 0.0 };
            let at = osc.stop(last.side).unwrap().gap * last.side.sign();
            match last.kind {
                // what follows is the end of a chatter, or a rest, which forgets what was before
                _ if events.get(begin).is_none_or(|next| matches!(next.kind, EventKind::Stick { .. })) => continue,
                EventKind::Impact { velocity_after, .. } => {
                    let v = velocity_after * last.side.sign();
                    (around(osc, Start { x: at, v, phase: last.phase }, Some(last.side), flown), last.time)
                }
                EventKind::Release => {
                    // the phase of a release is the zero of a force
                    let error = CHANGE * f64::EPSILON * (1.0 + 1.0 / last.phase.cos().abs().max(1e-8));
                    (vec![(Start { x: at, v: 0.0, phase: last.phase + error }, error / osc.beta())], last.time)
                }
                _ => continue,
            }
        };
        for (start, late) in starts {
            let motion = Motion::with_limits(osc, start, SEARCH).filter(|event| !is_graze(event));
            let mut changed = motion.take(determined - begin);
            for (k, event) in events.iter().enumerate().take(determined).skip(begin) {
                let same = changed.next().filter(|other| {
                    let ((kind, place, _), (kind_here, place_here, _)) = (told(other), told(event));
                    kind == kind_here && place == place_here
                });
                let Some(other) = same else {
                    determined = determined.min(k);
                    break;
                };
                sums[k][0] += (other.time + time + late - event.time).abs();
                sums[k][1] += turned(other.phase, event.phase);
                sums[k][2] += (told(&other).2 - told(event).2).abs();
            }
        }
    }
    (sums, determined)
}

fn turned(one: f64, other: f64) -> f64 {
    let turn = (one - other).abs();
    turn.min(core::f64::consts::TAU - turn)
}

/// States that differ by a few roundings from one, which lies on a stop or nowhere. The time `flown` before has a rounding
/// error too.
fn around(osc: &Oscillator, start: Start, on: Option<Side>, flown: f64) -> Vec<(Start, f64)> {
    let size = start.x.abs() + osc.free_amplitude().min(1e3) + start.v.abs();
    let error = CHANGE * f64::EPSILON;
    let turn = error * (4.0 + osc.beta() * flown);
    let inward = on.map_or(if start.x > 0.0 { -1.0 } else { 1.0 }, |side| -side.sign());
    let moved =
        |x: f64, v: f64, phase: f64| (Start { x: start.x + x, v: start.v + v, phase: start.phase + phase }, 0.0);
    let mut all = vec![moved(inward * error * size, 0.0, 0.0), moved(0.0, 0.0, turn)];
    all.extend([moved(0.0, inward * error * size, 0.0), moved(0.0, 0.0, -turn)]);
    // a slow rebound keeps its sign
    if start.v * inward > error * size {
        all.push(moved(0.0, -inward * error * size, 0.0));
    }
    all
}

#[derive(Default)]
struct Tally {
    systems: usize,
    events: usize,
    undetermined: usize,
    chatters: usize,
    grazes: [usize; 2],
    worst: f64,
    faults: Vec<String>,
}

fn compare(system: &System, tally: &mut Tally) -> Result<(), String> {
    let osc = &system.oscillator;
    let mut motion = Motion::with_limits(osc, system.start, SEARCH);
    let all: Vec<Event> = motion.by_ref().take(EVENTS + 10).collect();
    let end = motion.end();
    tally.grazes[0] += all.iter().filter(|event| is_graze(event)).count();
    let events: Vec<Event> = all.into_iter().filter(|event| !is_graze(event)).collect();
    let (sums, determined) = allowed(system, &events);
    let (machine, start) = (system.machine(), system.machine_start());
    let limits = Limits { time: 300.0, ..Limits::default() };
    let mut own = events::Motion::new(&machine, &start, limits).map_err(|error| error.to_string())?;
    let mut next = |tally: &mut Tally| -> Option<events::Event> {
        loop {
            let event = own.next()?;
            if event.kind != events::EventKind::Graze {
                return Some(event);
            }
            tally.grazes[1] += 1;
        }
    };
    tally.undetermined += usize::from(determined < events.len());
    let mut k = 0;
    let mut last = 0.0;
    while k < determined.min(EVENTS) {
        let event = &events[k];
        let Some(mut got) = next(tally) else {
            return if event.time - last > limits.time { Ok(()) } else { Err(format!("event {k}: none, {event:?}")) };
        };
        let mut want = told(event);
        let mut slack = 0.0;
        // the sum of a chatter begins at different impacts: both are followed to its end
        let begin = event.time;
        let is = |kind: events::EventKind, other: events::EventKind| {
            kind == events::EventKind::Stick && other == events::EventKind::Impact
        };
        if is(got.kind, want.0) {
            while is(got.kind, want.0) {
                k += 1;
                if k >= determined {
                    return Ok(());
                }
                want = told(&events[k]);
            }
            slack = SUMMED * (events[k].time - begin);
        } else if is(want.0, got.kind) {
            let from = got.time;
            while is(want.0, got.kind) {
                got = next(tally).ok_or_else(|| format!("event {k}: none in a chatter"))?;
            }
            slack = SUMMED * (event.time - from);
        }
        let event = &events[k];
        if let EventKind::Stick { chatter: true, error } = event.kind {
            tally.chatters += 1;
            let began = if k > 0 { events[k - 1].time } else { 0.0 };
            slack += error + SUMMED * (event.time - began);
        }
        if (got.kind, got.place) != (want.0, want.1) {
            return Err(format!("event {k}: {got:?}, not {event:?}"));
        }
        let rounding = OFTEN * f64::EPSILON;
        let terms = 1.0 + osc.free_amplitude().min(1e3) + osc.gap().abs();
        // the time of the flight is rounded, and the speed goes with it
        let pull = (event.time - last) * (1.0 + osc.gap().abs() + 2.0 * osc.damping() * want.2);
        let release = if event.kind == EventKind::Release { 8.0 / event.phase.cos().abs().max(1e-8) } else { 0.0 };
        let limits = [
            OFTEN * sums[k][0] + rounding * (event.time + release / osc.beta()) + slack,
            OFTEN * sums[k][1] + rounding * (8.0 + release + osc.beta() * event.time) + slack * osc.beta(),
            OFTEN * sums[k][2] + rounding * (terms + pull),
        ];
        let differ = [(got.time - event.time).abs(), turned(got.phase, event.phase), (got.speed - want.2).abs()];
        for ((name, differ), limit) in ["time", "phase", "speed"].iter().zip(differ).zip(limits) {
            tally.worst = tally.worst.max(differ / limit);
            if differ > limit || differ.is_nan() {
                return Err(format!(
                    "event {k} of {determined}: {name} differs by {differ:e}, {limit:e} allowed: {got:?}, {event:?}"
                ));
            }
        }
        tally.events += 1;
        last = event.time;
        k += 1;
    }
    if k == events.len()
        && matches!(end, Some(End::Never(_) | End::Stuck(_)))
        && let Some(event) = next(tally)
    {
        return Err(format!("after the last event, {end:?}: {event:?}"));
    }
    Ok(())
}

#[test]
fn the_same_events() {
    let mut tally = Tally::default();
    for system in systems() {
        tally.systems += 1;
        if let Err(fault) = compare(&system, &mut tally) {
            tally.faults.push(format!("{}\n    {fault}", system.text));
        }
    }
    let Tally { systems, events, undetermined, chatters, grazes, worst, faults } = &tally;
    let summary = format!(
        "{systems} systems, {events} events, {chatters} summed chatters, {undetermined} not determined to the end, grazes \
         {grazes:?}, worst {worst}"
    );
    assert!(faults.is_empty(), "{summary}\n{} differ:\n{}", faults.len(), faults.join("\n"));
    // what was compared is most of what there is
    assert!(*events > 10_000 && *undetermined < 50 && *chatters > 100, "{summary}");
}
