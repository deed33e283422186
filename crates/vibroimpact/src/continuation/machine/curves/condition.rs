//! The condition that holds along a curve, as the zero of a function of the events and of the machine.

use super::borders::Borders;
use super::moment::Moment;
use crate::continuation::machine::branches::{CompleteChatter, Limit, limits, touches};
use crate::math::{Matrix, Multiplier, general_eigenvalues, hypot, sort_by};
use crate::orbit::{MachineFrame, MachineRing};

/// A condition.
#[derive(Clone, Debug)]
pub(super) enum Condition {
    /// A multiplier is `turn`: +1 or -1.
    Singular { turn: f64, borders: Borders },
    /// The product of two multipliers is 1; `cosine` is half their sum at the last solution.
    Pair { cosine: f64 },
    /// The guard of this event, which is a touch, has the rate zero; rates are divided by `size`.
    /// `contact` is that of a curve of sticking or holding, and `speed` the largest velocity.
    Touch { at: usize, size: f64, contact: Option<usize>, speed: f64 },
    /// A limit of a contact is zero, at which a rest would take no time; values are divided by `size`.
    Limit { limit: Limit, contact: usize, size: f64 },
    /// A chatter is complete exactly at its release.
    Chatter(CompleteChatter),
    /// This event and the next one have the same phase.
    Together { at: usize },
}

/// Half the width of a difference by a term, relative to it.
const PART: f64 = 1e-5;

/// A limit that is smaller, relative to its terms, is reached but for rounding.
const AT_LIMIT: f64 = 1e-8;

/// The matrix of the linear equations of a cycle whose changes return multiplied by `turn`.
pub(super) fn turned(frame: &MachineFrame<'_>, ring: &MachineRing, turn: f64) -> Option<Matrix> {
    let blocks = ring.blocks(frame)?;
    let size = ring.len() * (frame.shape.size() + 1);
    let mut rows = vec![0.0; size * size];
    ring.fill(&mut rows, size, &blocks, turn);
    Matrix::from_rows(&rows.chunks_exact(size).map(<[f64]>::to_vec).collect::<Vec<_>>())
}

/// The multipliers of a ring, and the derivative that has them; `None` where one is infinite.
pub(super) fn multipliers(frame: &MachineFrame<'_>, ring: &MachineRing) -> Option<(Matrix, Vec<Multiplier>)> {
    let turn = ring.monodromy(frame, &ring.blocks(frame)?)?;
    let mut all = general_eigenvalues(&turn)?;
    all.truncate(frame.multipliers());
    Some((turn, all))
}

/// The two multipliers whose product is nearest to 1 and half whose sum is nearest to `cosine`: their places, their product
/// less 1, and half their sum.
pub(super) fn pair(all: &[Multiplier], cosine: f64) -> Option<((usize, usize), f64, f64)> {
    let pairs = (0..all.len()).flat_map(|i| (i + 1..all.len()).map(move |j| (i, j)));
    pairs
        .filter_map(|(i, j)| {
            let (a, b) = (all[i], all[j]);
            // the product of any other two is not real
            let real = a.im == 0.0 && b.im == 0.0;
            let conjugate = a.re == b.re && a.im == -b.im;
            (real || conjugate).then_some(((i, j), a.re * b.re - a.im * b.im - 1.0, 0.5 * (a.re + b.re)))
        })
        .min_by(|a, b| (a.1.abs() + (a.2 - cosine).abs()).total_cmp(&(b.1.abs() + (b.2 - cosine).abs())))
}

impl Condition {
    /// The value of the function that is zero.
    pub(super) fn value(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Option<f64> {
        match self {
            Self::Singular { turn, borders } => Some(borders.test(&turned(frame, ring, *turn)?)?.0),
            Self::Pair { cosine } => Some(pair(&multipliers(frame, ring)?.1, *cosine)?.1),
            Self::Touch { at, size, .. } => {
                let before = (at + ring.len() - 1) % ring.len();
                // the rate of the guard by the phase, times that of the phase
                Some(ring.block(frame, before)?.late[0] * ring.frequency(frame.machine) / size)
            }
            Self::Limit { limit, size, .. } => Some(limit.of(frame, ring)?.value / size),
            Self::Chatter(chatter) => chatter.value(frame, ring),
            Self::Together { at } => Some(ring.theta(at + 1) - ring.theta(*at)),
        }
    }

    /// The condition adapted to a solution: borders at it, and half the sum of the pair.
    pub(super) fn renewed(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Option<Self> {
        Some(match self {
            Self::Singular { turn, borders } => {
                let matrix = turned(frame, ring, *turn)?;
                Self::Singular { turn: *turn, borders: borders.renewed(&matrix)? }
            }
            Self::Pair { cosine } => Self::Pair { cosine: pair(&multipliers(frame, ring)?.1, *cosine)?.2 },
            other => other.clone(),
        })
    }

    /// By how much the condition fails in a quantity with a meaning; see [`residual`](super::CurvePoint::residual).
    pub(super) fn residual(&self, frame: &MachineFrame<'_>, ring: &MachineRing, all: &[Multiplier]) -> f64 {
        let nearest = |to: f64| all.iter().map(|m| hypot(m.re - to, m.im)).fold(f64::INFINITY, f64::min);
        match self {
            Self::Singular { turn, .. } => nearest(*turn),
            Self::Pair { cosine } => pair(all, *cosine).map_or(f64::INFINITY, |(_, product, _)| 0.5 * product.abs()),
            _ => self.value(frame, ring).map_or(f64::INFINITY, f64::abs),
        }
    }

    /// The moments at which rounding decides what happens, in order: the touch, both events of a corner, or each event at which
    /// the contact is at its limit. A symmetric cycle reaches a limit, or touches it, in both halves.
    pub(super) fn moments(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Vec<Moment> {
        let m = ring.len();
        match self {
            Self::Touch { at, contact, speed, .. } => {
                let mut moments = vec![Moment::Events(*at, *at)];
                if let Some(contact) = contact {
                    // not the flights that end and begin at the touch itself
                    let other = |leg: usize| leg != *at && (leg + 1) % m != *at;
                    let also = touches(frame, ring, *contact, *speed).into_iter();
                    let also = also.filter(|(value, touch)| value.abs() < AT_LIMIT && other(touch.leg));
                    moments.extend(also.map(|(_, touch)| Moment::Flight(touch.leg, touch.phase)));
                    sort_by(&mut moments, |a, b| a.phase(ring).total_cmp(&b.phase(ring)));
                }
                moments
            }
            Self::Limit { contact, .. } => {
                let at_limit = limits(frame, ring, *contact).into_iter().filter(|(value, _)| value.abs() < AT_LIMIT);
                let mut moments: Vec<Moment> = at_limit.map(|(_, limit)| Moment::Events(limit.at, limit.at)).collect();
                moments.dedup();
                moments
            }
            Self::Chatter(chatter) => {
                let ends = chatter.ends(frame, ring).into_iter();
                ends.map(|(first, last)| Moment::Events(first, last)).collect()
            }
            Self::Together { at } => vec![Moment::Events(*at, (at + 1) % m)],
            _ => Vec::new(),
        }
    }

    /// Quantities of which the value is a function that is nowhere steep in relation to them.
    pub(super) fn terms(&self, frame: &MachineFrame<'_>, ring: &MachineRing) -> Option<Vec<f64>> {
        match self {
            Self::Chatter(chatter) => chatter.terms(frame, ring),
            _ => Some(vec![self.value(frame, ring)?]),
        }
    }

    /// The derivatives of the value by these.
    pub(super) fn by_terms(&self, terms: &[f64]) -> Vec<f64> {
        let Self::Chatter(_) = self else { return vec![1.0] };
        let mut moved = terms.to_vec();
        // a central difference, relative to the term
        let mut at = |i: usize, part: f64| {
            moved[i] = terms[i] * (1.0 + part);
            let value = CompleteChatter::of_terms(&moved);
            moved[i] = terms[i];
            value
        };
        (0..terms.len()).map(|i| (at(i, PART) - at(i, -PART)) / (2.0 * PART * terms[i])).collect()
    }

    /// The events after which the flights begin that the value depends on; `None` if it can depend on all.
    pub(super) fn events(&self, ring: &MachineRing) -> Option<Vec<usize>> {
        match self {
            Self::Touch { at, .. } => Some(vec![(at + ring.len() - 1) % ring.len(), *at]),
            Self::Limit { limit, .. } => Some(vec![limit.at]),
            Self::Chatter(chatter) => chatter.last(ring),
            Self::Together { at } => Some(vec![*at, (at + 1) % ring.len()]),
            Self::Singular { .. } | Self::Pair { .. } => None,
        }
    }

    /// The event that is a touch.
    pub(super) const fn touch(&self) -> Option<usize> {
        match self {
            Self::Touch { at, .. } => Some(*at),
            _ => None,
        }
    }
}
