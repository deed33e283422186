//! Events and verdicts that do not depend on how a machine is written.
//!
//! Events at one time are compared as sets, and times as far as their own conditions allow: small changes of numbers that
//! keep all symmetries and contacts (of all masses, all springs, all forces, all speeds) say by how much a rounding error
//! may move an event, and the comparison ends where they change which events there are.

use crate::case::Case;
use crate::changes::{Changed, Rewriting, changed};
use crate::quantities::largest;
use crate::rules::Budget;
use std::collections::BTreeSet;
use vibroimpact::events::{MachineEventKind, MachineLimits, MachineMotion, MachineStart};
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

/// Events closer than this, relative to the time and to the time unit of the machine, are at one time.
const ONE_TIME: f64 = 1e-10;
/// The change of numbers that tells conditions.
const SMALL: f64 = 1e-8;
/// Rounding errors of the whole motion, as a relative change of its numbers.
const ROUNDING: f64 = 1e-12;
/// Times that a rounding error may move by more than this are not compared.
const WORST: f64 = 1e-6;

/// The instants of a motion, in the terms of the machine that was written again.
fn instants_of(machine: &Machine, start: &MachineStart, back: Option<&Changed>, budget: Budget) -> Vec<Instant> {
    let mut all: Vec<Instant> = Vec::new();
    let Ok(motion) = MachineMotion::new(machine, start, MachineLimits::default()) else { return all };
    let copies = back.map_or(1, |back| if back.places.len() == 2 * original_places(back) { 2 } else { 1 });
    let most = copies * budget.stretches as usize;
    for event in motion.filter(|event| event.kind != MachineEventKind::Graze).take(2 * most) {
        let time = event.time / back.map_or(1.0, |back| back.time);
        let place = back.map_or(event.place, |back| back.places[event.place]);
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
                last.events.insert((event.kind.name(), place));
                last.q = q;
            }
            _ => {
                if time > budget.time || all.len() > budget.stretches as usize {
                    break;
                }
                all.push(Instant { time, events: BTreeSet::from([(event.kind.name(), place)]), q });
            }
        }
    }
    // the last one may lack events
    all.pop();
    all
}

/// The number of stops and joints before the machine was written again.
fn original_places(back: &Changed) -> usize {
    back.places.iter().map(|place| place + 1).max().unwrap_or(0)
}

/// The machine with a number of a kind changed everywhere by this factor.
fn scaled(case: &Case, kind: usize, factor: f64) -> (Machine, MachineStart) {
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

/// A motion as a standard for those of other machines that should be the same.
#[derive(Debug)]
pub struct Standard {
    instants: Vec<Instant>,
    /// For each, by how much a relative change of numbers moves the time and the coordinates.
    conditions: Vec<(f64, f64)>,
    size: f64,
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
                        let apart = instant.q.iter().zip(&other.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                        worst.0 = worst.0.max((instant.time - other.time).abs() / SMALL);
                        worst.1 = worst.1.max(apart / SMALL);
                    }
                    _ => worst = (f64::INFINITY, f64::INFINITY),
                }
                conditions[k] = (conditions[k].0.max(worst.0), conditions[k].1.max(worst.1));
            }
        }
        Self { instants, conditions, size }
    }

    /// The number of instants at which another machine of the same coordinates moves in the same way, whatever its stops
    /// and joints are named and how many there are of each.
    ///
    /// # Errors
    /// The first difference.
    pub fn same_motion(&self, machine: &Machine, start: &MachineStart, budget: Budget) -> Result<usize, String> {
        self.same(machine, start, None, budget)
    }

    /// The number of instants at which another machine does the same, if it does as long as their conditions allow. Without
    /// a way back the events are not compared, only their times and the coordinates.
    fn same(
        &self,
        machine: &Machine,
        start: &MachineStart,
        back: Option<&Changed>,
        budget: Budget,
    ) -> Result<usize, String> {
        let others = instants_of(machine, start, back, budget);
        for (k, (instant, (of_time, of_q))) in self.instants.iter().zip(&self.conditions).enumerate() {
            let allowed = (ROUNDING * (1.0 + instant.time + of_time), ROUNDING * (self.size + of_q));
            if allowed.0 > WORST * (1.0 + instant.time) || allowed.1 > WORST * self.size {
                return Ok(k);
            }
            let time = instant.time;
            let Some(other) = others.get(k) else {
                // the number of events that are followed is limited
                return if others.len() * 2 > self.instants.len() { Ok(k) } else { Err(format!("no event at {time}")) };
            };
            if back.is_some() && other.events != instant.events {
                return Err(format!(
                    "{:?} at {} instead of {:?} at {time} (event {k})",
                    other.events, other.time, instant.events
                ));
            }
            let late = other.time - time;
            if late.abs() > allowed.0 {
                return Err(format!(
                    "{:?} at {time} is {late:e} late, {:e} allowed (event {k})",
                    instant.events, allowed.0
                ));
            }
            let apart = instant.q.iter().zip(&other.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if apart > allowed.1 {
                return Err(format!("coordinates at {time} differ by {apart:e}, {:e} allowed (event {k})", allowed.1));
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
