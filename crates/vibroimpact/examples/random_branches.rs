//! Random branches of machines: how they end, whether an event stands between motions that differ, and the time.
//!
//!     cargo run --release -p vibroimpact --example random_branches -- [COUNT [SEED [FIRST]]]
//!
//! COUNT is 8 if it is absent; 200 take some minutes. FIRST is the number of the first case.
//!
//! Machines of one to four coordinates with rigid and compliant stops, friction, chatter and rests are drawn from the seed; the
//! motion from a random start is followed in a random number of the machine. Between two neighbouring points the stability may
//! change at events only, and the list of the events of the motion only at events at which the motion is not smooth.
#![allow(clippy::print_stdout, reason = "an example for the terminal")]

use std::collections::BTreeMap;
use std::time::Instant;
use vibroimpact::continuation::{
    BranchEvent, BranchOptions, Direction,
    machine::{Branch, Family, SolutionPoint},
};
use vibroimpact::events::{EventKind, Start};
use vibroimpact::machine::{Machine, MachineParts, Opening, StopLaw};
use vibroimpact::orbit::machine::Cycle;
use vibroimpact::verdict::{SettleOptions, Verdict, settle_machine};

/// Points of a branch at most.
const POINTS: u32 = 150;
/// A cycle with more events is not followed: each of its steps takes long.
const LONGEST: usize = 24;
/// A multiplier whose modulus differs from 1 by less tells nothing of the stability.
const NEUTRAL: f64 = 1e-6;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number = |k: usize, otherwise: u64| words.get(k).map_or(otherwise, |word| word.parse().expect("a number"));
    let (count, seed) = (number(0, 8), number(1, 1));
    let (mut tally, mut done, mut case) = (Tally::default(), 0, number(2, 1) - 1);
    while done < count {
        case += 1;
        // what is drawn for one case does not depend on the others
        if tally.branch(case, &mut Draw(seed << 32 | case)) {
            done += 1;
        }
    }
    tally.print(count);
}

/// A sequence of numbers (splitmix64).
struct Draw(u64);

impl Draw {
    /// A number between two others.
    #[allow(clippy::cast_precision_loss, reason = "53 bits are kept")]
    fn number(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * (((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// One of so many.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "a few")]
    fn one_of(&mut self, count: usize) -> usize {
        self.number(0.0, count as f64) as usize
    }

    fn chance(&mut self, probability: f64) -> bool {
        self.number(0.0, 1.0) < probability
    }
}

/// A chain of masses between two springs, with one or two stops and sometimes a joint.
fn machine(draw: &mut Draw) -> Option<Machine> {
    let n = 1 + draw.one_of(4);
    let unit = |k: usize, other: Option<usize>| -> Vec<f64> {
        (0..n)
            .map(|i| {
                if i == k {
                    1.0
                } else if Some(i) == other {
                    -1.0
                } else {
                    0.0
                }
            })
            .collect()
    };
    let mut parts = MachineParts::new((0..n).map(|k| format!("x{k}"))).with_frequency(draw.number(0.4, 1.6));
    for k in 0..n {
        let spring = (draw.number(0.5, 1.5), draw.number(0.03, 0.25));
        parts = parts.with_mass(k, draw.number(0.5, 1.5)).with_link(&unit(k, k.checked_sub(1)), spring.0, spring.1);
    }
    parts = parts.with_force(draw.one_of(n), 1, draw.number(-0.5, 0.5), draw.number(0.5, 1.5));
    for name in ["stop", "other"].into_iter().take(1 + usize::from(draw.chance(0.3))) {
        let k = draw.one_of(n);
        let direction: Vec<f64> =
            unit(k, k.checked_sub(1)).iter().map(|x| if name == "other" { -x } else { *x }).collect();
        // a stop at rest, which the constant force presses, has chatters and rests
        let pressed = draw.chance(0.35);
        let gap = if pressed { draw.number(-0.3, 0.1) } else { draw.number(0.1, 0.9) };
        let law = match draw.one_of(if pressed { 5 } else { 8 }) {
            0 => StopLaw::Rigid { restitution: 0.0 },
            1 | 2 => StopLaw::Rigid { restitution: draw.number(0.1, 0.5) },
            3..=5 => StopLaw::Rigid { restitution: draw.number(0.5, 0.9) },
            _ => StopLaw::Compliant {
                stiffness: draw.number(10.0, 60.0),
                damping: if draw.chance(0.5) { draw.number(0.1, 2.0) } else { 0.0 },
                preload: if draw.chance(0.3) { draw.number(0.05, 0.4) } else { 0.0 },
                opening: if draw.chance(0.5) { Opening::Force } else { Opening::Position },
            },
        };
        parts = parts.with_stop(name, &direction, gap, law);
    }
    if draw.chance(0.3) {
        let sliding = draw.number(0.05, 0.4);
        let limit = if draw.chance(0.5) { sliding } else { sliding * draw.number(1.0, 1.6) };
        parts = parts.with_joint("floor", &unit(draw.one_of(n), None), sliding, limit, 0.0);
    }
    Machine::new(parts).ok()
}

/// The end of a range that is this part of a number away from it, or nearer by halves until the number is allowed.
fn legal(machine: &Machine, path: &str, value: f64, part: f64) -> f64 {
    let mut ends = (0..30).map(|k| value + part * value.abs() / f64::from(1_u32 << k));
    ends.find(|end| machine.with(path, *end).is_ok()).unwrap_or(value)
}

/// What is counted over all branches.
#[derive(Default)]
struct Tally {
    points: usize,
    events: BTreeMap<&'static str, usize>,
    ends: BTreeMap<&'static str, usize>,
    faults: BTreeMap<&'static str, usize>,
    labels: BTreeMap<&'static str, usize>,
    seconds: f64,
    refused: usize,
}

impl Tally {
    /// Follows the branch of a random machine; false if it has no cycle with events.
    fn branch(&mut self, case: u64, draw: &mut Draw) -> bool {
        let Some(machine) = machine(draw) else { return false };
        let options = SettleOptions { max_impacts: 1_000, chaos_over: 0, ..SettleOptions::default() };
        let Ok(settled) = settle_machine(&machine, &Start::default().within_stops(&machine), &options) else {
            return false;
        };
        let Verdict::Periodic(cycle) = settled.verdict else { return false };
        let numbers: Vec<_> = machine.numbers().into_iter().filter(|(_, value)| *value != 0.0).collect();
        let (path, value) = &numbers[draw.one_of(numbers.len())];
        let (up, down) = (draw.number(0.2, 0.6), draw.number(0.2, 0.6));
        let range = legal(&machine, path, *value, -down)..=legal(&machine, path, *value, up);
        let direction = if draw.chance(0.5) { Direction::Up } else { Direction::Down };
        let Ok((family, value)) = Family::of_path(&machine, path) else { return false };
        if cycle.events.is_empty() || cycle.events.len() > LONGEST {
            return false;
        }
        let options = BranchOptions { points: POINTS, ..BranchOptions::default() };
        let begin = Instant::now();
        let points: Vec<SolutionPoint> = match Branch::new((&family, value), &cycle, &range, direction, options) {
            Ok(branch) => branch.collect(),
            Err(_) => {
                self.refused += 1;
                return false;
            }
        };
        let seconds = begin.elapsed().as_secs_f64();
        self.seconds += seconds;
        self.points += points.len();
        *self.labels.entry(kind(&machine, &cycle)).or_default() += 1;
        let mut line = format!("{case} {path} {} {:.2}s:", cycle.label, seconds);
        for point in &points {
            let Some(event) = point.event else { continue };
            line += &format!(" {} {:.9}", event.name(), point.value);
            let of = if event.ends() { &mut self.ends } else { &mut self.events };
            *of.entry(event.name()).or_default() += 1;
        }
        for (fault, value) in faults(&points) {
            line += &format!(" !! {fault} {value}");
            *self.faults.entry(fault).or_default() += 1;
        }
        println!("{line}");
        true
    }

    fn print(&self, count: u64) {
        println!("{count} branches, {} points, {:.2} s in them, {} refused", self.points, self.seconds, self.refused);
        println!("motions {:?}", self.labels);
        println!("events {:?}", self.events);
        println!("ends {:?}", self.ends);
        println!("without their event {:?}", self.faults);
    }
}

/// What kind of motion a cycle is.
fn kind(machine: &Machine, cycle: &Cycle) -> &'static str {
    let has = |kind| cycle.events.iter().any(|event| event.kind == kind);
    if cycle.label.impacts == vibroimpact::orbit::Count::Infinite {
        "chatter"
    } else if has(EventKind::Stick) {
        "rest"
    } else if has(EventKind::Hold) || has(EventKind::Slip) {
        "friction"
    } else if machine.stops().iter().any(|stop| matches!(stop.law, StopLaw::Compliant { .. })) {
        "compliant"
    } else {
        "rigid"
    }
}

/// The changes between neighbouring ordinary points without an event between them that explains them.
fn faults(points: &[SolutionPoint]) -> Vec<(&'static str, f64)> {
    let (mut found, mut between): (Vec<_>, Vec<BranchEvent>) = Default::default();
    let mut last: Option<&SolutionPoint> = None;
    for point in points {
        if let Some(event) = point.event.filter(|event| !event.ends()) {
            between.push(event);
            continue;
        }
        if let Some(before) = last {
            let (a, b) = (&before.cycle, &point.cycle);
            if outside(a).zip(outside(b)).is_some_and(|(a, b)| a != b) && between.is_empty() {
                found.push(("stability", point.value));
            }
            if !same_list(a, b) && !between.iter().any(explains) {
                found.push(("list of events", point.value));
            } else if !same_list(a, b) && !between.iter().any(|event| names(*event, a, b)) {
                found.push(("name of the event", point.value));
            }
        }
        (last, between) = (Some(point), Vec::new());
    }
    found
}

/// The number of multipliers outside the unit circle; `None` where one is too near to it.
fn outside(cycle: &Cycle) -> Option<usize> {
    let moduli: Vec<f64> = cycle.multipliers.iter().map(|multiplier| multiplier.modulus()).collect();
    let near = moduli.iter().any(|modulus| (modulus - 1.0).abs() < NEUTRAL);
    (!near).then(|| moduli.iter().filter(|modulus| **modulus > 1.0).count())
}

/// The events of a cycle: kind and place, without touches and without what follows the first impact of a chatter: impacts, and
/// joints that turn back between them.
fn list(cycle: &Cycle) -> Vec<(EventKind, usize)> {
    let told: Vec<_> = cycle.events.iter().filter(|event| event.kind != EventKind::Graze).collect();
    let all: Vec<_> = told.iter().map(|event| (event.kind, event.place)).collect();
    let m = all.len();
    let turns = |k: &usize| all[k % m].0 == EventKind::Slip;
    let in_chatter = |k: usize, place: usize| {
        let struck = |k: usize| all[k % m] == (EventKind::Impact, place);
        let end = (k..k + m).find(|i| !struck(*i) && !turns(i));
        let before = (1..=m).map(|i| k + m - i).find(|i| !turns(i));
        end.is_some_and(|end| all[end % m] == (EventKind::Stick, place))
            && before
                .is_some_and(|before| struck(before) && (!struck(k) || told[k].speed < 2.0 * told[before % m].speed))
    };
    let stops: Vec<usize> = all.iter().filter(|(kind, _)| *kind == EventKind::Stick).map(|(_, place)| *place).collect();
    (0..m).filter(|k| !stops.iter().any(|place| in_chatter(*k, *place))).map(|k| all[k]).collect()
}

/// Whether two cycles have the same events in the same cyclic order.
fn same_list(a: &Cycle, b: &Cycle) -> bool {
    let (a, b) = (list(a), list(b));
    let m = a.len();
    m == b.len() && (m == 0 || (0..m).any(|shift| (0..m).all(|k| a[k] == b[(k + shift) % m])))
}

/// Whether the list of events can change at an event of this kind.
fn explains(event: &BranchEvent) -> bool {
    !matches!(event, BranchEvent::Fold | BranchEvent::BranchPoint | BranchEvent::Flip | BranchEvent::Torus)
}

/// Whether the change of the list is one of this event: of rests, of holds, of closings, or of their order.
fn names(event: BranchEvent, a: &Cycle, b: &Cycle) -> bool {
    let count = |cycle: &Cycle, of: fn(EventKind) -> bool| list(cycle).iter().filter(|(kind, _)| of(*kind)).count();
    let differ = |of: fn(EventKind) -> bool| count(a, of) != count(b, of);
    let rests = differ(|kind| matches!(kind, EventKind::Stick | EventKind::Release));
    let holds = differ(|kind| matches!(kind, EventKind::Hold | EventKind::Slip));
    let closings = differ(|kind| matches!(kind, EventKind::Impact | EventKind::Close));
    match event {
        BranchEvent::Grazing { .. } => closings,
        BranchEvent::Sticking { .. } => rests || closings,
        BranchEvent::Holding { .. } => holds,
        BranchEvent::Corner { .. } | BranchEvent::Jump => true,
        BranchEvent::Change { .. } => false,
        _ => true,
    }
}
