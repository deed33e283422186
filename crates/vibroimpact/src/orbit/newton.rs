//! Newton's method on the equations of a cycle at fixed parameters.

use super::condense::correction;
use super::cycle::{Cycle, CyclePoint};
use super::cyclic::{Block, blocks, residual};
use super::floquet::Floquet;
use super::free;
use super::label::Label;
use super::ring::Ring;
use crate::motion::ImpactState;
use crate::system::{Oscillator, phase};

/// After a relative correction smaller than this only rounding errors are left, because convergence is quadratic.
const SETTLED: f64 = 1e-8;
/// The largest number of steps.
const MAX_STEPS: u32 = 30;
/// If a correction after [`PATIENCE`] steps is larger than this, the iteration is ended without a result.
const HOPELESS: f64 = 1.0;
const PATIENCE: u32 = 10;

/// The solution of the equations of a cycle near `ring`, with its linearised flights; `None` if Newton's method does
/// not converge.
pub(crate) fn solve(osc: &Oscillator, mut ring: Ring) -> Option<(Ring, Vec<Block>)> {
    if ring.len() == 0 {
        // the motion without impacts is known in closed form
        return (osc.damping() > 0.0).then(|| (ring, Vec::new()));
    }
    for step in 0..MAX_STEPS {
        let flights = blocks(osc, &ring)?;
        let change = correction(&flights)?;
        let size = change.iter().fold(0.0_f64, |size, c| size.max(c.abs()));
        if !size.is_finite() || (step >= PATIENCE && size > HOPELESS) {
            return None;
        }
        let share = admissible(&ring, &change);
        for (unknown, change) in ring.unknowns.iter_mut().zip(&change) {
            *unknown += share * change;
        }
        if share == 1.0 && size <= SETTLED {
            ring.wrap();
            let flights = blocks(osc, &ring)?;
            return Some((ring, flights));
        }
    }
    None
}

/// The fraction of a correction that is applied. It limits the change of a phase to half a radian, the change of a
/// speed to twice its value, and the decrease of a time of flight to three quarters.
fn admissible(ring: &Ring, change: &[f64]) -> f64 {
    let m = ring.len();
    let mut share = 1.0_f64;
    for k in 0..m {
        share = share.min(0.5 / change[2 * k].abs());
        let shrink = change[2 * k] - change[2 * ((k + 1) % m)];
        if shrink > 0.0 {
            share = share.min(0.75 * ring.turn(k) / shrink);
        }
        let speed = ring.speed(k).abs().max(0.1);
        share = share.min(2.0 * speed / change[2 * k + 1].abs());
    }
    share
}

/// The cycle of a ring, with its multipliers; the fastest arrival is first.
pub(crate) fn cycle(osc: &Oscillator, ring: &Ring, flights: &[Block]) -> Cycle {
    let multipliers =
        if ring.len() == 0 { free::multipliers(osc) } else { Floquet::new(osc, ring, flights).multipliers() };
    let point = |k: usize| CyclePoint {
        state: ImpactState { phase: phase::wrap(ring.theta(k)), velocity: ring.speed(k), side: ring.side(k) },
        interval: ring.turn(k) / osc.beta(),
    };
    let mut cycle = Cycle {
        label: Label::new(u32::try_from(ring.len()).unwrap_or(u32::MAX), ring.periods),
        points: (0..ring.len()).map(point).collect(),
        rests: Vec::new(),
        multipliers,
        residual: residual(ring, flights),
    };
    cycle.rotate_to_fastest();
    cycle
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::one_impact;
    use crate::system::Side;

    /// From a distant guess, and to an inadmissible orbit.
    #[test]
    fn reaches_the_closed_form() {
        for (inverse, gap, zeta) in [(1.3, 0.75, 0.0), (1.11, 2.0, 0.0), (0.8, 0.4, 0.07), (1.0, 3.0, 0.05)] {
            let osc = Oscillator::from_inverse_beta(inverse, gap, 0.5).unwrap().with_damping(zeta).unwrap();
            for orbit in one_impact(&osc, 1) {
                let state = orbit.cycle.points[0].state;
                let unknowns = vec![state.phase + 0.05, state.velocity * 1.05];
                let ring = Ring { sides: vec![Side::Upper], unknowns, periods: 1 };
                let (ring, flights) = solve(&osc, ring).unwrap();
                let found = cycle(&osc, &ring, &flights);
                assert!(found.same_as(&orbit.cycle, 1e-12), "{found:?} {orbit:?}");
                assert!(found.residual < 2e-15 * (1.0 + state.velocity), "{}", found.residual);
                for (a, b) in found.multipliers.iter().zip(orbit.cycle.multipliers) {
                    assert!((a.re - b.re).abs() < 1e-11 && (a.im - b.im).abs() < 1e-11);
                }
            }
        }
    }
}
