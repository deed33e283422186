//! The end of a collapse: impacts on several stops in turn that accumulate, as those of a heavy body on a light one on a
//! table.
//!
//! When the same stops are struck in the same order again and again and all speeds fall by one factor in each round, so do
//! the rounds themselves last shorter by a factor. The rest of the time is the geometric sum, and the structure is then at
//! rest on all of these stops, if all of them push. Velocities of the gaps that are left are taken away as by impacts
//! without rebound.

use super::event::MachineEventKind;
use super::motion::MachineMotion;
use crate::arc::{Found, first_event};
use crate::math::add_scaled;
use crate::regime::{ContactState, GuardKind};
use std::collections::VecDeque;

/// Impacts below this part of the largest one since the structure last came to rest are kept.
pub(super) const SLOW: f64 = 1e-3;
/// A collapse is summed when its impacts are below this part of the largest one.
const SLOWEST: f64 = 1e-8;
/// The longest round, and the number of rounds that are compared.
const LONGEST: usize = 8;
const ROUNDS: usize = 3;
/// Factors that differ by less than this part of them are equal.
const EQUAL: f64 = 1e-3;
/// A round that lasts less than this part of the time is not longer than its rounding error.
const ROUNDED: f64 = 16.0 * f64::EPSILON;
/// A sum is taken if the fastest mode moves by no more than this angle; what it leaves out is of the square.
const SHORT: f64 = 1e-7;

/// A slow impact.
#[derive(Clone, Copy, Debug)]
struct Slow {
    stop: usize,
    speed: f64,
    time: f64,
    /// The number of the event.
    count: u64,
}

/// The latest slow impacts.
#[derive(Clone, Debug, Default)]
pub(super) struct SlowImpacts(VecDeque<Slow>);

impl SlowImpacts {
    /// The stops of the shortest round of several stops that repeats at the end, and the time that is left.
    fn round(&self) -> Option<(Vec<usize>, f64)> {
        let all: Vec<&Slow> = self.0.iter().rev().collect();
        let of = |period: usize| {
            let last = all.get(..ROUNDS * period + 1)?;
            let consecutive = last.windows(2).all(|pair| pair[0].count == pair[1].count + 1);
            let again = (0..last.len() - period).all(|k| last[k].stop == last[k + period].stop);
            if !consecutive || !again {
                return None;
            }
            let mut stops: Vec<usize> = last[..period].iter().map(|slow| slow.stop).collect();
            stops.sort_unstable();
            stops.dedup();
            let factor = |k: usize| last[k].speed / last[k + period].speed;
            let first = factor(0);
            let one = (1..2 * period).all(|k| (factor(k) - first).abs() <= EQUAL * first);
            let rounds = (last[0].time - last[period].time, last[period].time - last[2 * period].time);
            let falls = |factor: f64| (0.0..1.0 - EQUAL).contains(&factor);
            if stops.len() < 2 || !one || !falls(first) {
                return None;
            }
            if rounds.0 <= ROUNDED * last[0].time.abs() {
                // what is left is below the rounding error of the time
                return Some((stops, 0.0));
            }
            let shorter = rounds.0 / rounds.1;
            falls(shorter).then(|| (stops, rounds.0 * shorter / (1.0 - shorter)))
        };
        (2..=LONGEST).find_map(of)
    }
}

impl MachineMotion<'_> {
    /// Notes a slow impact on a stop that has opened again, and sums the collapse that it belongs to, if there is one.
    pub(super) fn slow_impact(&mut self, stop: usize, speed: f64) {
        let slow = Slow { stop, speed, time: self.time(), count: self.count };
        self.slow.0.push_back(slow);
        if self.slow.0.len() > ROUNDS * LONGEST + 1 {
            self.slow.0.pop_front();
        }
        if speed > SLOWEST * self.largest_impact {
            return;
        }
        if let Some((stops, left)) = self.slow.round()
            && self.collapse(&stops, left).is_some()
        {
            self.slow.0.clear();
            self.largest_impact = 0.0;
        }
    }

    /// Brings the structure to rest on these stops after a time; `None` if it does not stay there.
    fn collapse(&mut self, stops: &[usize], left: f64) -> Option<()> {
        let mut there = self.place.clone();
        stops.iter().for_each(|j| there.states[*j] = ContactState::Resting);
        let structure = self.structures.get(self.machine, &self.normal, &there.states)?;
        if left * structure.fastest() > SHORT {
            return None;
        }
        let turns = there.turns(&self.normal);
        for j in stops {
            let held = structure.held.iter().position(|place| place == j)?;
            let (gap, rate) = self.place.gap_and_rate(&self.normal, &turns, *j);
            add_scaled(&mut there.x, gap, &structure.across[held]);
            add_scaled(&mut there.v, rate, &structure.across[held]);
        }
        there.known.retain(|(kind, _)| !matches!(kind, GuardKind::Gap(j) if stops.contains(j)));
        let flight = there.flight(&self.normal, structure.clone());
        let mut held = structure.held.iter().zip(&structure.reactions);
        let all = self.machine.stops().len();
        if held.any(|(place, reaction)| *place < all && flight.first(reaction).0 <= 0.0) {
            return None;
        }
        let mut touches = Vec::new();
        let Found::NoneBefore(_) = first_event(&flight, left, self.limits.steps, &mut self.buffers, &mut touches)
        else {
            return None;
        };
        self.place = there;
        let pushed: Vec<(usize, f64)> = stops.iter().map(|j| (*j, 0.0)).collect();
        self.record(&pushed);
        if let Some(passage) = &mut self.passage {
            passage.rest = Some((structure, left));
        }
        self.move_to(&flight, left);
        self.announce(MachineEventKind::Collapse, stops[0], 0.0, stops[1..].to_vec());
        Some(())
    }
}
