//! Numbers drawn from a seed, the same on every platform.

use core::ops::RangeInclusive;
use vibroimpact::machine::{ImpactLaw, Opening, StopLaw};

/// A sequence of numbers (splitmix64) that depends on a name and a seed.
#[derive(Clone, Debug)]
pub struct Draw {
    state: u64,
}

impl Draw {
    /// The sequence of a name and a seed.
    #[must_use]
    pub fn new(name: &str, seed: u64) -> Self {
        // FNV-1a of the name
        let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
        Self { state: hash ^ seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) }
    }

    fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.state ^ (self.state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number in [0, 1).
    #[allow(clippy::cast_precision_loss, reason = "53 bits are kept")]
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Whether something of this probability is so.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// One of these.
    pub fn pick<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.count(0..=all.len() - 1)].clone()
    }

    /// A whole number.
    #[allow(clippy::cast_possible_truncation, reason = "it is below the size of the range")]
    pub fn count(&mut self, range: RangeInclusive<usize>) -> usize {
        range.start() + (self.bits() % (range.end() - range.start() + 1) as u64) as usize
    }

    /// A number in a range: half of them have two decimals, as people write them, the others all digits.
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        let number = low + (high - low) * self.unit();
        if self.chance(0.5) { ((number * 100.0).round() / 100.0).clamp(low, high) } else { number }
    }

    /// Numbers in a range.
    pub fn numbers(&mut self, n: usize, low: f64, high: f64) -> Vec<f64> {
        (0..n).map(|_| self.number(low, high)).collect()
    }

    /// A restitution: 0, 1 and between.
    pub fn restitution(&mut self) -> f64 {
        if self.chance(0.4) { self.pick(&[0.0, 1.0]) } else { self.number(0.1, 0.9) }
    }

    /// A rigid stop.
    pub fn rigid(&mut self) -> StopLaw {
        StopLaw::Rigid { restitution: self.restitution() }
    }

    /// A compliant stop: undamped, damped, preloaded, with either opening.
    pub fn compliant(&mut self) -> StopLaw {
        let stiffness = self.number(5.0, 200.0);
        let damping = if self.chance(0.5) { self.number(0.05, 4.0) } else { 0.0 };
        let preload = if self.chance(0.3) { self.number(0.05, 1.0) } else { 0.0 };
        let opening = self.pick(&[Opening::Force, Opening::Force, Opening::Position]);
        StopLaw::Compliant { stiffness, damping, preload, opening }
    }

    /// The law of impacts on several stops at one time.
    pub fn impacts(&mut self) -> ImpactLaw {
        if self.chance(0.3) { ImpactLaw::InTurn } else { ImpactLaw::Together }
    }

    /// A rigid or a compliant stop.
    pub fn law(&mut self) -> StopLaw {
        if self.chance(0.5) { self.rigid() } else { self.compliant() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_follow_from_name_and_seed() {
        let first = |name, seed| Draw::new(name, seed).unit();
        assert_eq!(first("a", 1).to_bits(), first("a", 1).to_bits());
        assert!(first("a", 1) != first("a", 2) && first("a", 1) != first("b", 1));
    }

    #[test]
    fn numbers_lie_in_their_ranges_and_reach_the_ends() {
        let mut draw = Draw::new("ranges", 0);
        let counts: Vec<usize> = (0..200).map(|_| draw.count(2..=4)).collect();
        assert!((2..=4).all(|n| counts.contains(&n)) && counts.iter().all(|n| (2..=4).contains(n)));
        assert!((0..1000).all(|_| (0.3..=0.7).contains(&draw.number(0.3, 0.7))));
        let restitutions: Vec<f64> = (0..200).map(|_| draw.restitution()).collect();
        assert!(
            restitutions.contains(&0.0)
                && restitutions.contains(&1.0)
                && restitutions.iter().any(|e| (0.1..0.9).contains(e))
        );
    }
}
