//! Newton's method on the m-fold impact map with its exact derivative.
//!
//! The motion from a guess $`(\theta, U)`$ is followed over m impacts. With $`J`$ the product of the derivatives of
//! [`derivative`](crate::motion::derivative), the correction solves $`(J - I)\,\Delta z = z - P^m(z)`$; the phase must
//! advance by exactly $`2\pi n`$. The flights end at their first contact, so a converged solution is admissible. The
//! multipliers are computed from the trace of $`J`$ and the exact determinant
//! $`\varepsilon^{2m}e^{-4\pi\zeta n/\beta}`$, so a small multiplier keeps its digits.

use super::cycle::{Cycle, CyclePoint, distance};
use super::label::Label;
use crate::flight::SearchLimits;
use crate::math::{Matrix2, eigenvalues, exp};
use crate::motion::{ABREAST, ImpactMap, ImpactState, Mapped, derivatives};
use crate::system::{Oscillator, phase};
use core::f64::consts::TAU;
use thiserror::Error;

/// Why shooting from a guess gave no periodic orbit.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ShootingError {
    /// The motion from an iterate has fewer than m impacts, or its last impact is on the other stop.
    #[error("the motion stops striking, or sticks, before the period is complete")]
    Broken,
    /// The linear system is singular: a fold or a branch point.
    #[error("the correction is singular: a multiplier is +1 to rounding")]
    Singular,
    /// The iteration did not converge.
    #[error("Newton's method did not converge; the return misses by {0:e}")]
    NotConverged(f64),
}

/// The largest number of steps; from a good guess four or five are needed.
const MAX_STEPS: u32 = 40;
/// After this number of steps the iteration is ended if the residual exceeds [`HOPELESS`].
const PATIENCE: u32 = 8;
/// See [`PATIENCE`]: with quadratic convergence the residual would be far below this.
const HOPELESS: f64 = 1e-2;
/// A residual up to this is accepted; the rounding error is usually 1e-15.
const CLOSED: f64 = 1e-11;

/// The periodic orbit with `m` impacts in `n` forcing periods near `guess`, over its smallest period.
///
/// # Errors
/// [`ShootingError`] states why the iteration failed.
pub fn shoot(osc: &Oscillator, guess: ImpactState, m: u32, n: u32) -> Result<Cycle, ShootingError> {
    newton(osc, guess, (m, n), |_, _| false)
}

/// The same orbit if it may be stable. The iteration is ended when it is clear that it approaches an unstable one, as nearly
/// always in chaos.
pub(crate) fn shoot_stable(osc: &Oscillator, guess: ImpactState, m: u32, n: u32) -> Option<Cycle> {
    let unstable = |residual: f64, j: &Matrix2| {
        residual <= APPROACHED && eigenvalues(j.trace(), j.determinant())[0].modulus() > UNSTABLE
    };
    newton(osc, guess, (m, n), unstable).ok()
}

/// With this residual the multipliers are those of the orbit to a few digits, and above this modulus it is unstable.
const APPROACHED: f64 = 1e-7;
/// See [`APPROACHED`].
const UNSTABLE: f64 = 2.0;

/// Newton's method, which is ended where `abandon` returns true of a residual and a derivative.
fn newton(
    osc: &Oscillator,
    guess: ImpactState,
    (m, n): (u32, u32),
    abandon: impl Fn(f64, &Matrix2) -> bool,
) -> Result<Cycle, ShootingError> {
    let mut state = guess;
    let mut best: Option<(f64, Vec<(ImpactState, f64)>)> = None;
    let mut map = ImpactMap::new(osc, flight_limits(n));
    for step in 0..MAX_STEPS {
        let lap = Lap::by(osc, &mut map, state, m)?;
        let advance = lap.turned - TAU * f64::from(n);
        let miss = [advance, lap.last.velocity - state.velocity];
        let residual = miss[0].abs().max(miss[1].abs() / state.velocity);
        if lap.last.side != state.side {
            return Err(ShootingError::Broken);
        }
        let improves = best.as_ref().is_none_or(|(so_far, _)| residual < *so_far);
        // no better than before: what is left is rounding
        if !improves && best.as_ref().is_some_and(|(so_far, _)| *so_far <= CLOSED) {
            break;
        }
        let derivative = lap.derivative(osc);
        if abandon(residual, &derivative) {
            return Err(ShootingError::NotConverged(residual));
        }
        if improves {
            best = Some((residual, lap.points));
        }
        if residual == 0.0 || (step >= PATIENCE && residual > HOPELESS) {
            break;
        }
        let Matrix2([[a, b], [c, d]]) = derivative;
        // (J - I) step = -miss
        let step = Matrix2([[a - 1.0, b], [c, d - 1.0]]).solve([-miss[0], -miss[1]]).ok_or(ShootingError::Singular)?;
        // a step is shortened if it would reverse the velocity or change the phase by more than half a radian
        let shorten = (0.5 * state.velocity / step[1].abs()).min(0.5 / step[0].abs()).min(1.0);
        state.phase = phase::wrap(state.phase + shorten * step[0]);
        state.velocity += shorten * step[1];
    }
    match best {
        Some((residual, points)) if residual <= CLOSED => Ok(smallest_period(osc, points, n, residual)),
        Some((residual, _)) => Err(ShootingError::NotConverged(residual)),
        None => Err(ShootingError::Broken),
    }
}

/// The limits of the first-contact search for a cycle over `n` forcing periods: a little more than
/// twice its length.
pub(crate) fn flight_limits(n: u32) -> SearchLimits {
    SearchLimits { periods: 2.0 * f64::from(n) + 2.0, steps: 400 + n.saturating_mul(50).min(50_000) }
}

/// The motion over m impacts.
pub(crate) struct Lap {
    /// Each impact from the first on, and the time to the next one.
    pub(crate) points: Vec<(ImpactState, f64)>,
    /// The arrival after the last of them.
    pub(crate) last: ImpactState,
    /// The advance of the phase, not reduced to one forcing period.
    pub(crate) turned: f64,
}

impl Lap {
    /// Follows the motion from `start` over m impacts; an error if it has fewer.
    pub(crate) fn fly(
        osc: &Oscillator,
        start: ImpactState,
        m: u32,
        limits: SearchLimits,
    ) -> Result<Self, ShootingError> {
        Self::by(osc, &mut ImpactMap::new(osc, limits), start, m)
    }

    /// The same by an impact map of `osc`.
    fn by(osc: &Oscillator, map: &mut ImpactMap<'_>, start: ImpactState, m: u32) -> Result<Self, ShootingError> {
        let mut lap = Self { points: Vec::new(), last: start, turned: 0.0 };
        let mut turns = 0.0_f64;
        for _ in 0..m {
            let Mapped::Impact { state, interval } = map.after(&lap.last) else {
                return Err(ShootingError::Broken);
            };
            // whole periods are counted and the rest is taken from the phases, which are accurate to their last digit
            turns += ((osc.beta() * interval - (state.phase - lap.last.phase)) / TAU).round();
            lap.points.push((lap.last, interval));
            lap.last = state;
        }
        lap.turned = (lap.last.phase - start.phase) + turns * TAU;
        Ok(lap)
    }

    /// The derivative of the m-fold map.
    pub(crate) fn derivative(&self, osc: &Oscillator) -> Matrix2 {
        product(osc, &self.points, &self.last)
    }
}

/// The derivative over the impacts from the first of `points` to `last`; each point has the time to the next one.
fn product(osc: &Oscillator, points: &[(ImpactState, f64)], last: &ImpactState) -> Matrix2 {
    let mut product = Matrix2::IDENTITY;
    let mut next = points.iter().skip(1).map(|(state, _)| *state).chain([*last]);
    for part in points.chunks(ABREAST) {
        // each next impact with the time since the one before
        let mut others = [(*last, 0.0); ABREAST];
        for (other, (_, interval)) in others.iter_mut().zip(part) {
            *other = (next.next().unwrap_or(*last), *interval);
        }
        let all = derivatives(osc, &part[0].0, &others[..part.len()]);
        for derivative in &all[..part.len()] {
            product = derivative.times(product);
        }
    }
    product
}

/// The cycle through `points`, reduced if it repeats a shorter one.
fn smallest_period(osc: &Oscillator, points: Vec<(ImpactState, f64)>, n: u32, residual: f64) -> Cycle {
    let m = points.len();
    let same = |a: &(ImpactState, f64), b: &(ImpactState, f64)| distance(&a.0, &b.0) <= 1e-7;
    let shorter = (1..m).find(|d| {
        m.is_multiple_of(*d)
            && (n as usize * d).is_multiple_of(m)
            && (0..m).all(|k| same(&points[k], &points[(k + d) % m]))
    });
    match shorter {
        #[allow(clippy::cast_possible_truncation)] // a divisor of n
        Some(d) => {
            let n = (n as usize * d / m) as u32;
            assemble(osc, points.into_iter().take(d).collect(), n, residual)
        }
        None => assemble(osc, points, n, residual),
    }
}

/// The cycle of these impacts and intervals, with its multipliers.
pub(crate) fn assemble(osc: &Oscillator, points: Vec<(ImpactState, f64)>, n: u32, residual: f64) -> Cycle {
    let m = points.len();
    let (mut det, mut length) = (1.0, 0.0);
    for (state, interval) in &points {
        let eps = osc.stop(state.side).map_or(0.0, |stop| stop.restitution);
        // the determinants of impacts are exact, as is that of the flights below
        det *= eps * eps;
        length += interval;
    }
    let product = points.first().map_or(Matrix2::IDENTITY, |(first, _)| product(osc, &points, first));
    let multipliers = eigenvalues(product.trace(), det * exp(-2.0 * osc.damping() * length));
    let label = Label::new(u32::try_from(m).unwrap_or(u32::MAX), n);
    let points = points.into_iter().map(|(state, interval)| CyclePoint { state, interval }).collect();
    let mut cycle = Cycle { label, points, rests: Vec::new(), multipliers, residual };
    cycle.rotate_to_fastest();
    cycle
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Side;

    #[test]
    fn damping_enters_the_determinant() {
        let osc = Oscillator::from_inverse_beta(1.3, 0.75, 0.5).unwrap().with_damping(0.05).unwrap();
        let guess = ImpactState { phase: 1.19, velocity: 2.5, side: Side::Upper };
        let cycle = shoot(&osc, guess, 1, 1).unwrap();
        let lap = Lap::fly(&osc, cycle.points[0].state, 1, flight_limits(1)).unwrap();
        let [one, two] = cycle.multipliers;
        let det = one.re * two.re - one.im * two.im;
        assert!((lap.derivative(&osc).determinant() - det).abs() < 1e-12);
    }
}
