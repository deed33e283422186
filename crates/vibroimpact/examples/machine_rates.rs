//! Events per second of four machines, from their first event on, without the building of the machine: the measure of
//! `benches/peers/machines.py`.
//!
//! `machine_rates [EVENTS [NAME]]`; with `--events` the events are printed instead.
#![allow(clippy::print_stdout)]

#[path = "../benches/speed/machine_problems.rs"]
mod machine_problems;

use std::time::Instant;
use vibroimpact::events::{MachineLimits, MachineMotion};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let list = arguments.iter().any(|word| word == "--events");
    let mut words = arguments.iter().filter(|word| *word != "--events");
    let count: usize = words.next().map_or(20_000, |word| word.parse().expect("a number of events"));
    let only = words.next();
    for problem in machine_problems::all() {
        if only.is_some_and(|only| only != problem.name) {
            continue;
        }
        let begin = Instant::now();
        let motion =
            MachineMotion::new(&problem.machine, &problem.start, MachineLimits::default()).expect("a legal start");
        let mut events = 0_u32;
        let mut time = 0.0;
        for event in motion.take(count) {
            events += 1;
            time = event.time;
            if list {
                println!("{} {} {:?} {:?} {:?}", event.kind.name(), event.place, event.time, event.phase, event.speed);
            }
        }
        let seconds = begin.elapsed().as_secs_f64();
        if !list {
            let rate = f64::from(events) / seconds;
            println!("{:16} {events:7} events to time {time:12.4}: {rate:10.0} per second", problem.name);
        }
    }
}
