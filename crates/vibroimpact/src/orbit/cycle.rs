//! A periodic motion: its impacts over one smallest period, its label and its Floquet multipliers.

use super::label::Label;
use crate::math::Multiplier;
use crate::motion::ImpactState;
use crate::system::{Side, phase};

/// An impact of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CyclePoint {
    /// The arrival.
    pub state: ImpactState,
    /// Time to the next impact; after the last one listed before a rest, to the end of the chatter.
    pub interval: f64,
}

/// A rest on a stop within a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestSpan {
    /// Which stop.
    pub side: Side,
    /// Whether a complete chatter leads to it.
    pub chatter: bool,
    /// Phase at which the mass comes to rest (the accumulation point of the chatter).
    pub begin: f64,
    /// Phase of the release.
    pub release: f64,
}

/// A periodic motion with impacts, over its smallest period.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// m/n.
    pub label: Label,
    /// Its impacts in order, the fastest arrival first (from a release on, where there is one).
    pub points: Vec<CyclePoint>,
    /// Its rests, if it has any.
    pub rests: Vec<RestSpan>,
    /// Floquet multipliers, the larger first. Their product is known exactly,
    /// $`\varepsilon^{2m} e^{-4\pi\zeta n/\beta}`$, and used; both are 0 with a rest.
    pub multipliers: [Multiplier; 2],
    /// What it misses by: the return after one period in phase and relative velocity, the larger; for a cycle that was
    /// solved for as a whole each flight at its end, in distance and velocity over the largest velocity or 1.
    pub residual: f64,
}

impl Cycle {
    /// Whether it attracts its neighbourhood: both multipliers inside the unit circle.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.multipliers[0].modulus() < 1.0 && self.multipliers[1].modulus() < 1.0
    }

    /// Whether `other` is the same motion: the same label and the same impacts in the same cyclic order, phases and
    /// relative velocities to within `tolerance`.
    #[must_use]
    pub fn same_as(&self, other: &Self, tolerance: f64) -> bool {
        let (a, b) = (&self.points, &other.points);
        if self.label != other.label || a.len() != b.len() || self.rests.len() != other.rests.len() {
            return false;
        }
        let close = |p: &CyclePoint, q: &CyclePoint| distance(&p.state, &q.state) <= tolerance;
        (0..a.len()).any(|shift| (0..a.len()).all(|k| close(&a[k], &b[(k + shift) % b.len()])))
    }

    /// The largest arrival speed.
    #[must_use]
    pub fn fastest(&self) -> f64 {
        self.points.iter().map(|p| p.state.velocity).fold(0.0, f64::max)
    }

    /// Puts the fastest arrival first.
    pub(crate) fn rotate_to_fastest(&mut self) {
        let first = (0..self.points.len())
            .max_by(|&a, &b| self.points[a].state.velocity.total_cmp(&self.points[b].state.velocity).then(b.cmp(&a)));
        if let Some(first) = first {
            self.points.rotate_left(first);
        }
    }
}

/// How far apart two arrivals are: the larger of the difference in phase and of that in velocity, relative to the
/// larger one; infinite on different stops.
#[must_use]
pub(crate) fn distance(a: &ImpactState, b: &ImpactState) -> f64 {
    if a.side != b.side {
        return f64::INFINITY;
    }
    let speed = a.velocity.max(b.velocity).max(f64::MIN_POSITIVE);
    phase::difference(a.phase, b.phase).abs().max((a.velocity - b.velocity).abs() / speed)
}
