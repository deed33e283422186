//! Events and verdicts that do not depend on how a machine is written.
//!
//! Events at one time are compared as sets, and times as far as their own conditions allow: small changes of numbers that
//! keep all symmetries and contacts (of all masses, all springs, all forces, all speeds) say by how much a rounding error
//! may move an event, and the comparison ends where they change which events there are. Rounding errors keep no symmetry: where
//! motions differ, single numbers are changed by some roundings, and what differs as much then is no difference.
//!
//! Impacts that accumulate are summed at one time, before which it does not matter how many of them are told, and a contact
//! without a load may or may not be told to be left.

use crate::case::Case;
use crate::changes::{Changed, Rewriting, changed};
use crate::quantities::largest;
use crate::rules::Budget;
use std::collections::BTreeSet;
use vibroimpact::events::{EventKind, Limits, Motion, Start};
use vibroimpact::machine::{Machine, StopLaw};
use vibroimpact::math::Matrix;

/// Events at one time.
#[derive(Clone, Debug)]
struct Instant {
    time: f64,
    events: BTreeSet<(&'static str, usize)>,
    /// Coordinates after all of them.
    q: Vec<f64>,
}

impl Instant {
    /// Whether all its events can be those of impacts that accumulate.
    fn accumulates(&self) -> bool {
        self.events.iter().all(|(kind, _)| matches!(*kind, "impact" | "slip" | "hold"))
    }

    /// Its events without rests, which may begin and end without a load.
    fn loaded(&self) -> BTreeSet<(&'static str, usize)> {
        self.events.iter().filter(|(kind, _)| !matches!(*kind, "stick" | "release" | "collapse")).copied().collect()
    }
}

/// Events closer than this, relative to the time and to the time unit of the machine, are at one time.
const ONE_TIME: f64 = 1e-10;
/// The change of numbers that tells conditions.
const SMALL: f64 = 1e-8;
/// Rounding errors of the whole motion, as a relative change of its numbers.
const ROUNDING: f64 = 1e-12;
/// A change of single numbers that is as large as the rounding errors of some events, and how often it is drawn.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;
const DRAWS: u64 = 12;
/// Within this part of the time before a rest that ends accumulating impacts these are not compared.
const ACCUMULATING: f64 = 1e-3;
/// Times that a rounding error may move by more than this are not compared.
const WORST: f64 = 1e-6;

/// The instants of a motion, in the terms of the machine that was written again.
fn instants_of(machine: &Machine, start: &Start, back: Option<&Changed>, budget: Budget) -> Vec<Instant> {
    let mut all: Vec<Instant> = Vec::new();
    let Ok(motion) = Motion::new(machine, start, Limits::default()) else { return all };
    let copies = back.map_or(1, |back| if back.places.len() == 2 * original_places(back) { 2 } else { 1 });
    let most = copies * budget.stretches as usize;
    for event in motion.filter(|event| event.kind != EventKind::Graze).take(4 * most) {
        let time = event.time / back.map_or(1.0, |back| back.time);
        let place = |place: usize| back.map_or(place, |back| back.places[place]);
        let with = if event.kind == EventKind::Collapse { event.with.as_slice() } else { &[] };
        let own = [&[event.place], with].concat().into_iter().map(|at| (event.kind.name(), place(at)));
        let q = match back {
            None => event.q,
            Some(back) => {
                let mut q = vec![0.0; back.coordinates.iter().map(|(from, _)| from + 1).max().unwrap_or(0)];
                for ((from, factor), value) in back.coordinates.iter().zip(&event.q) {
                    q[*from] = value / factor;
                }
                q
            }
        };
        match all.last_mut() {
            Some(last) if time - last.time <= ONE_TIME * (1.0 + time) => {
                last.events.extend(own);
                last.q = q;
            }
            _ => {
                if time > budget.time || all.len() > budget.stretches as usize {
                    break;
                }
                let events: BTreeSet<_> = own.collect();
                if events.iter().any(|(kind, _)| matches!(*kind, "stick" | "collapse")) {
                    forget_accumulating(&mut all, time);
                }
                all.push(Instant { time, events, q });
            }
        }
    }
    // the last one may lack events, and those before it a rest that ends them
    if let Some(last) = all.pop() {
        forget_accumulating(&mut all, last.time);
    }
    all
}

/// Takes away the last instants that can be impacts which accumulate until this time.
fn forget_accumulating(all: &mut Vec<Instant>, until: f64) {
    let began = until - ACCUMULATING * (1.0 + until);
    let kept = all.iter().rposition(|last| last.time < began || !last.accumulates());
    all.truncate(kept.map_or(0, |last| last + 1));
}

/// The largest difference of two states.
fn distance(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The number of stops and joints before the machine was written again.
fn original_places(back: &Changed) -> usize {
    back.places.iter().map(|place| place + 1).max().unwrap_or(0)
}

/// The machine with a number of a kind changed everywhere by this factor.
fn scaled(case: &Case, kind: usize, factor: f64) -> (Machine, Start) {
    let (mut parts, mut start) = (case.machine.parts().clone(), case.start.clone());
    let times = |matrix: &Matrix| {
        let rows: Vec<Vec<f64>> =
            (0..matrix.rows()).map(|i| matrix.row(i).iter().map(|value| factor * value).collect()).collect();
        Matrix::from_rows(&rows).unwrap_or_default()
    };
    match kind {
        0 => parts.mass = times(&parts.mass),
        1 => parts.stiffness = times(&parts.stiffness),
        2 => {
            for force in &mut parts.forces {
                force.cos.iter_mut().chain(&mut force.sin).for_each(|value| *value *= factor);
            }
            parts.constant.iter_mut().for_each(|value| *value *= factor);
            for motion in parts.stops.iter_mut().flat_map(|stop| &mut stop.motion) {
                (motion.cos, motion.sin) = (motion.cos * factor, motion.sin * factor);
            }
        }
        3 => start.qdot.iter_mut().for_each(|value| *value *= factor),
        _ => {
            for stop in &mut parts.stops {
                match &mut stop.law {
                    StopLaw::Rigid { restitution } => *restitution = (*restitution / factor).min(1.0),
                    StopLaw::Compliant { stiffness, .. } => *stiffness *= factor,
                }
            }
        }
    }
    let machine = Machine::new(parts).unwrap_or_else(|_| case.machine.clone());
    (machine, start)
}

/// The machine and its start with all numbers that are not zero changed by some roundings, each by itself.
#[must_use]
pub fn rounded(case: &Case, seed: u64) -> (Machine, Start) {
    let (mut parts, mut start) = (case.machine.parts().clone(), case.start.clone());
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut change = |value: &mut f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *value *= 1.0 + if state >> 63 == 0 { ROUNDINGS } else { -ROUNDINGS };
    };
    let n = parts.n();
    for matrix in [&mut parts.mass, &mut parts.stiffness, &mut parts.damping] {
        (0..n).for_each(|i| change(&mut matrix[(i, i)]));
    }
    for force in &mut parts.forces {
        force.cos.iter_mut().chain(&mut force.sin).for_each(&mut change);
    }
    parts.constant.iter_mut().for_each(&mut change);
    for stop in &mut parts.stops {
        stop.motion.iter_mut().for_each(|motion| [&mut motion.cos, &mut motion.sin].into_iter().for_each(&mut change));
        change(&mut stop.gap);
    }
    start.q.iter_mut().chain(&mut start.qdot).for_each(&mut change);
    let machine = Machine::new(parts).unwrap_or_else(|_| case.machine.clone());
    (machine, start)
}

/// A motion as a standard for those of other machines that should be the same.
#[derive(Debug)]
pub struct Standard {
    case: Case,
    budget: Budget,
    instants: Vec<Instant>,
    /// For each, by how much a relative change of numbers moves the time and the coordinates.
    conditions: Vec<(f64, f64)>,
    size: f64,
    /// The largest velocity at the start.
    speed: f64,
}

impl Standard {
    /// The motion of a case, with its conditions.
    #[must_use]
    pub fn new(case: &Case, budget: Budget) -> Self {
        let instants = instants_of(&case.machine, &case.start, None, budget);
        let mut conditions = vec![(0.0_f64, 0.0_f64); instants.len()];
        let size = instants.iter().fold(largest(&case.start.q), |most, instant| most.max(largest(&instant.q)));
        for kind in 0..5 {
            let (machine, start) = scaled(case, kind, 1.0 + SMALL);
            let others = instants_of(&machine, &start, None, budget);
            let mut worst = (0.0_f64, 0.0_f64);
            for (k, instant) in instants.iter().enumerate() {
                match others.get(k) {
                    Some(other) if other.events == instant.events => {
                        let apart = distance(&instant.q, &other.q);
                        worst.0 = worst.0.max((instant.time - other.time).abs() / SMALL);
                        worst.1 = worst.1.max(apart / SMALL);
                    }
                    _ => worst = (f64::INFINITY, f64::INFINITY),
                }
                conditions[k] = (conditions[k].0.max(worst.0), conditions[k].1.max(worst.1));
            }
        }
        let speed = largest(&case.start.qdot);
        Self { case: case.clone(), budget, instants, conditions, size, speed }
    }

    /// Whether rounding errors can move an instant as far, in time and in coordinates, or change what happens there.
    fn is_rounding(&self, k: usize, (late, apart): (f64, f64)) -> bool {
        let instant = &self.instants[k];
        let (mut most_late, mut most_apart) = (0.0_f64, 0.0_f64);
        for seed in 0..DRAWS {
            let (machine, start) = rounded(&self.case, seed);
            let others = instants_of(&machine, &start, None, self.budget);
            let Some(other) = others.get(k).filter(|other| other.loaded() == instant.loaded()) else { return true };
            most_late = most_late.max((other.time - instant.time).abs());
            most_apart = most_apart.max(distance(&instant.q, &other.q));
        }
        late <= 2.0 * most_late && apart <= 2.0 * most_apart
    }

    /// The number of instants at which another machine of the same coordinates moves in the same way, whatever its stops
    /// and joints are named and how many there are of each.
    ///
    /// # Errors
    /// The first difference.
    pub fn same_motion(&self, machine: &Machine, start: &Start, budget: Budget) -> Result<usize, String> {
        self.same(machine, start, None, budget)
    }

    /// The number of instants at which another machine does the same, if it does as long as their conditions allow. Without
    /// a way back the events are not compared, only their times and the coordinates.
    fn same(&self, machine: &Machine, start: &Start, back: Option<&Changed>, budget: Budget) -> Result<usize, String> {
        let mut others = instants_of(machine, start, back, budget).into_iter().peekable();
        for (k, (instant, (of_time, of_q))) in self.instants.iter().zip(&self.conditions).enumerate() {
            let time = instant.time;
            let size = self.size.max(self.speed * time);
            let allowed = (ROUNDING * (1.0 + time + of_time), ROUNDING * (size + of_q));
            if allowed.0 > WORST * (1.0 + time) || allowed.1 > WORST * size {
                return Ok(k);
            }
            let told = instant.loaded();
            // rests that the other one does not tell, or that this one does not
            let before = |other: &Instant| other.loaded().is_empty() && other.time < time - allowed.0;
            while others.next_if(before).is_some() {}
            if told.is_empty() && others.peek().is_some_and(|other| other.time > time + allowed.0) {
                continue;
            }
            let Some(other) = others.next() else {
                // the number of events that are followed is limited
                return if 2 * k > self.instants.len() { Ok(k) } else { Err(format!("no event at {time}")) };
            };
            let (late, apart) = ((other.time - time).abs(), distance(&instant.q, &other.q));
            let differs = back.is_some() && other.loaded() != told;
            if (differs || late > allowed.0 || apart > allowed.1) && !self.is_rounding(k, (late, apart)) {
                return Err(format!(
                    "{:?} at {} instead of {:?} at {time}, coordinates {apart:e} apart; {:e} and {:e} allowed (event {k})",
                    other.events, other.time, instant.events, allowed.0, allowed.1
                ));
            }
        }
        Ok(self.instants.len())
    }

    /// The same for the case written again.
    ///
    /// # Errors
    /// The first difference.
    pub fn same_written(&self, case: &Case, change: Rewriting, budget: Budget) -> Result<usize, String> {
        let back = changed(case, change);
        self.same(&back.machine, &back.start, Some(&back), budget).map_err(|what| format!("{change:?}: {what}"))
    }
}
