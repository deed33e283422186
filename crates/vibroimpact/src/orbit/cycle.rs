//! A periodic motion: its impacts over the smallest period, its label and its Floquet multipliers.

use super::label::Label;
use super::stability::{Stability, rounding};
use crate::math::Multiplier;
use crate::motion::ImpactState;
use crate::system::{Side, phase};

/// An impact of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CyclePoint {
    /// The state at the arrival.
    pub state: ImpactState,
    /// Time to the next impact; after the last impact listed before the mass sticks, the time to the end of the
    /// chatter.
    pub interval: f64,
}

/// An interval within a cycle in which the mass sticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestSpan {
    /// The stop on which it sticks.
    pub side: Side,
    /// Whether it begins with a complete chatter.
    pub chatter: bool,
    /// Phase at which the mass begins to stick (the accumulation point of the chatter).
    pub begin: f64,
    /// Phase of the release.
    pub release: f64,
}

/// A periodic motion with impacts, over its smallest period.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// The label m/n.
    pub label: Label,
    /// Its impacts in order, beginning with the fastest arrival; for a cycle that sticks, beginning after a release.
    pub points: Vec<CyclePoint>,
    /// Its intervals of sticking; empty if it does not stick.
    pub rests: Vec<RestSpan>,
    /// Floquet multipliers, the larger first. Their product is computed from the exact formula
    /// $`\varepsilon^{2m} e^{-4\pi\zeta n/\beta}`$. Both are 0 for a cycle that sticks.
    pub multipliers: [Multiplier; 2],
    /// The residual: for a cycle from the impact map, the larger of the errors of phase and relative velocity after one
    /// period; for a cycle from the equations of all its impacts, the largest error of distance and velocity at the end
    /// of a flight, divided by the largest velocity if that exceeds 1.
    pub residual: f64,
}

impl Cycle {
    /// Whether neighbours approach the cycle. The product of its multipliers is exact, and their sum has the rounding error of
    /// the impacts.
    #[must_use]
    pub fn stability(&self) -> Stability {
        Stability::of(&self.multipliers, self.rounding())
    }

    /// The same for the direction of each multiplier.
    #[must_use]
    pub fn stabilities(&self) -> Vec<Stability> {
        Stability::each(&self.multipliers, self.rounding()).collect()
    }

    /// The rounding error of the sum of its multipliers.
    pub(crate) fn rounding(&self) -> f64 {
        let sum = self.multipliers[0].re + self.multipliers[1].re;
        rounding(self.points.len(), sum.abs())
    }

    /// Whether the cycle attracts its neighbourhood: both multipliers lie inside the unit circle.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.stability().is_stable()
    }

    /// Whether `other` is the same motion: the same label and the same impacts in the same cyclic order, with phases
    /// and relative velocities equal to within `tolerance`.
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

    /// Reorders the impacts cyclically, so that the fastest arrival is first.
    pub(crate) fn rotate_to_fastest(&mut self) {
        let first = (0..self.points.len())
            .max_by(|&a, &b| self.points[a].state.velocity.total_cmp(&self.points[b].state.velocity).then(b.cmp(&a)));
        if let Some(first) = first {
            self.points.rotate_left(first);
        }
    }
}

/// The distance between two arrivals: the larger of the difference in phase and the difference in velocity relative to
/// the larger velocity; infinite on different stops.
#[must_use]
pub(crate) fn distance(a: &ImpactState, b: &ImpactState) -> f64 {
    if a.side != b.side {
        return f64::INFINITY;
    }
    let speed = a.velocity.max(b.velocity).max(f64::MIN_POSITIVE);
    phase::difference(a.phase, b.phase).abs().max((a.velocity - b.velocity).abs() / speed)
}
