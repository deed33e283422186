//! Events per second of machines, one motion on one thread: the measure of `benches/peers/machines.py`.
//!
//!     cargo run --release -p vibroimpact --example machine_rates -- [EVENTS [NAME]]
//!     cargo run --release -p vibroimpact --example machine_rates -- --starts NAME COUNT [--grazing]
//!
//! The second form prints random starts, coordinates and velocities, and behind a bar the times of their first five events
//! before the time 60. With `--grazing` the first event of each is a touch of a speed of about 1e-3 or less.
#![allow(clippy::print_stdout, reason = "an example for the terminal")]

#[path = "../benches/speed/machine_problems.rs"]
mod machine_problems;

use machine_problems::{Problem, all};
use std::time::Instant;
use vibroimpact::events::{Event, EventKind, Limits, Motion, Start};

const HORIZON: f64 = 60.0;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if words.first().is_some_and(|word| word == "--starts") {
        let problem = all().into_iter().find(|problem| problem.name == words[1]).expect("the name of a machine");
        let count: usize = words[2].parse().expect("a number of starts");
        let grazing = words.iter().any(|word| word == "--grazing");
        return starts(&problem, count, grazing);
    }
    let count: usize = words.first().map_or(20_000, |word| word.parse().expect("a number of events"));
    for problem in all() {
        if words.get(1).is_none_or(|only| only == problem.name) {
            rate(&problem, count);
        }
    }
}

fn motion<'a>(problem: &'a Problem, start: &Start) -> Motion<'a> {
    Motion::new(&problem.machine, start, Limits { time: HORIZON, ..Limits::default() }).expect("a legal start")
}

fn rate(problem: &Problem, count: usize) {
    let begin = Instant::now();
    let (mut events, mut time) = (0_u32, 0.0);
    let motion = Motion::new(&problem.machine, &problem.start, Limits::default()).expect("a legal start");
    for event in motion.take(count) {
        events += 1;
        time = event.time;
    }
    let rate = f64::from(events) / begin.elapsed().as_secs_f64();
    println!("{:16} {events:7} events to time {time:12.4}: {rate:10.0} per second", problem.name);
}

fn starts(problem: &Problem, count: usize, grazing: bool) {
    let mut state = 1971_u64;
    let mut unit = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 32).expect("32 bits")) / 2.0_f64.powi(32)
    };
    let mut done = 0;
    for _ in 0..100 * count {
        if done == count {
            break;
        }
        let mut draw = |q: f64, v: f64| {
            let n = problem.machine.n();
            // modes of a beam by their frequencies
            let stiffness = &problem.machine.parts().stiffness;
            let rate = |i: usize| if problem.name == "beam" { stiffness[(i, i)].sqrt() } else { 1.0 };
            let q: Vec<f64> = (0..n).map(|i| q * (2.0 * unit() - 1.0) / rate(i)).collect();
            let qdot = (0..n).map(|_| v * (2.0 * unit() - 1.0)).collect();
            Start { q, qdot, phase: 0.0, ..Start::default() }
        };
        let (q, v) = if problem.name == "beam" { (0.1, 0.1) } else { (0.5, 1.0) };
        let mut start = draw(q, v);
        if open(problem, &start).is_none() {
            continue;
        }
        if grazing {
            let Some(touch) = toward_a_touch(problem, &start, &draw(q, v)) else { continue };
            start = touch;
        }
        // what the others do not know: rest, and touches without effect
        let events: Vec<Event> = motion(problem, &start).take(5).collect();
        let known = |event: &Event| !matches!(event.kind, EventKind::Stick | EventKind::Release | EventKind::Graze);
        if events.len() < 5 || events[4].time > HORIZON || !events.iter().all(known) {
            continue;
        }
        let numbers = |all: &[f64]| all.iter().map(|x| format!("{x:?} ")).collect::<String>();
        let times: Vec<f64> = events.iter().map(|event| event.time).collect();
        println!("{}{}| {}", numbers(&start.q), numbers(&start.qdot), numbers(&times));
        done += 1;
    }
}

/// Whether a start lies clear of all stops.
fn open(problem: &Problem, start: &Start) -> Option<()> {
    let clear = problem.machine.stops().iter().all(|stop| {
        let moved: f64 = stop.direction.iter().zip(&start.q).map(|(w, q)| w * q).sum();
        let wall: f64 = stop.motion.iter().map(|motion| motion.cos).sum();
        stop.gap - wall - moved > 0.01
    });
    clear.then_some(())
}

/// A start between two ones whose first events differ much: its first event is nearly missed.
fn toward_a_touch(problem: &Problem, one: &Start, other: &Start) -> Option<Start> {
    open(problem, other)?;
    let between = |part: f64| {
        let mix = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + part * (b - a)).collect();
        Start { q: mix(&one.q, &other.q), qdot: mix(&one.qdot, &other.qdot), phase: 0.0, ..Start::default() }
    };
    let first = |part: f64| motion(problem, &between(part)).next().map(|event| (event.time, event.speed));
    let (mut low, mut high) = (0.0, 1.0);
    let (mut early, mut late) = (first(low)?, first(high)?);
    for _ in 0..26 {
        let middle = 0.5 * (low + high);
        let there = first(middle)?;
        // towards the side whose time is farther away
        if (there.0 - early.0).abs() > (there.0 - late.0).abs() {
            (high, late) = (middle, there);
        } else {
            (low, early) = (middle, there);
        }
    }
    let (part, found) = if early.0 < late.0 { (low, early) } else { (high, late) };
    // the tip of a beam trembles, and is faster
    let (apart, slow) = if problem.name == "beam" { (2e-3, 2e-2) } else { (0.1, 2e-3) };
    ((early.0 - late.0).abs() > apart && found.1 < slow).then(|| between(part))
}
