//! Rounds of slow impacts: the same stops struck in the same order again and again, ever more gently.

use std::collections::VecDeque;

/// Impacts below this part of the largest one since the structure last came to rest are kept.
pub(super) const SLOW: f64 = 1e-3;
/// The longest round, and the number of rounds that are compared.
const LONGEST: usize = 8;
const ROUNDS: usize = 3;
/// Factors that differ by less than this part of them are equal.
const EQUAL: f64 = 1e-3;
/// A round that lasts less than this part of the time is not longer than its rounding error.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// A slow impact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slow {
    pub(super) stop: usize,
    pub(super) speed: f64,
    pub(super) time: f64,
    /// The number of the event.
    pub(super) count: u64,
}

/// The latest slow impacts.
#[derive(Clone, Debug, Default)]
pub(super) struct SlowImpacts(VecDeque<Slow>);

impl SlowImpacts {
    /// Keeps an impact.
    pub(super) fn push(&mut self, slow: Slow) {
        self.0.push_back(slow);
        if self.0.len() > ROUNDS * LONGEST + 1 {
            self.0.pop_front();
        }
    }

    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// The stops of the shortest round of several stops that repeats at the end, and the time that is left.
    pub(super) fn round(&self) -> Option<(Vec<usize>, f64)> {
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
