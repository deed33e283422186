//! Propagators of one oscillator that a long single motion needs again and again: each is computed once.

use super::stride::{Halvings, LEVELS, NODES, Pace, Propagators, Row, Stride};
use crate::system::UndampedForm;
use core::array::from_fn;
use core::cell::OnceCell;

/// The number of nodes that the flights in lanes reach.
const COUNT: usize = NODES as usize + 4;
/// The last of them.
pub(super) const LAST: u32 = NODES + 3;

/// The propagators over whole steps and the constants of halved steps, as far as they were needed. They have the bits of
/// those computed anew, so a motion does not depend on them.
#[derive(Clone, Debug)]
pub(crate) struct PropagatorCache {
    nodes: [OnceCell<Row<f64>>; COUNT],
    paces: [OnceCell<Pace<f64>>; LEVELS],
}

impl PropagatorCache {
    /// With nothing computed.
    pub(crate) fn new() -> Self {
        Self { nodes: from_fn(|_| OnceCell::new()), paces: from_fn(|_| OnceCell::new()) }
    }

    /// The propagator over `k` whole steps, at most [`LAST`].
    pub(super) fn node(&self, stride: &Stride, k: u32) -> &Row<f64> {
        self.nodes[k as usize].get_or_init(|| stride.node(f64::from(k)))
    }
}

/// A stride with the cache of its oscillator.
pub(super) struct Cached<'a>(pub(super) &'a Stride, pub(super) &'a PropagatorCache);

impl Propagators<f64> for Cached<'_> {
    #[inline]
    fn node(&self, k: f64) -> Row<f64> {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // saturates, and is compared
        let place = k as u32;
        match self.1.nodes.get(place as usize) {
            // an invalid guess of a contact is no number of steps
            Some(row) if f64::from(place).to_bits() == k.to_bits() => *row.get_or_init(|| self.0.node(k)),
            _ => self.0.node(k),
        }
    }
    #[inline]
    fn rest(&self, t: f64) -> Row<f64> {
        self.0.rest(t)
    }
    #[inline]
    fn form(&self) -> (UndampedForm<f64>, f64) {
        self.0.form()
    }
}

impl Halvings for Cached<'_> {
    #[inline]
    fn pace(&self, level: usize) -> Pace<f64> {
        *self.1.paces[level].get_or_init(|| self.0.pace(level))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Oscillator;

    #[test]
    fn the_bits_of_those_computed_anew() {
        let osc = Oscillator::new(0.8, 0.5, 0.7).unwrap().with_damping(0.03).unwrap();
        let (stride, cache) = (Stride::new(&osc).unwrap(), PropagatorCache::new());
        let cached = Cached(&stride, &cache);
        let bits = |row: Row<f64>| row.map(f64::to_bits);
        for k in [-0.0, 0.0, 3.0, 3.0, 67.0, 68.0, 0.5, -1.0, 3.0, 0.0, -0.0, 1e30] {
            assert_eq!(bits(cached.node(k)), bits(stride.node(k)), "{k}");
        }
        assert!(cached.node(f64::NAN)[0].is_nan());
        for level in [0, 5, 5, LEVELS - 1] {
            assert_eq!(cached.pace(level).h.to_bits(), stride.pace(level).h.to_bits());
        }
    }
}
