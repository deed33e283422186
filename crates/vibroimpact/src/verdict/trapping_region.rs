//! Trapping regions: neighbourhoods of stable cycles that no motion leaves, so that a motion inside is decided.
//!
//! About an impact of the cycle the linearised m-fold impact map contracts in the norm $`\|d\|_P^2 = d^TPd`$,
//! $`P = \sum_k (J^k)^TQJ^k`$, by the factor $`\vartheta < 1`$; $`J`$ is its derivative. How far this holds is tested
//! on discs $`\|d\| \le r`$ of increasing radius. A disc is accepted if the motions from its whole rim make the m
//! impacts of the cycle on the stops of the cycle, in its n periods, and return inside $`\tfrac12(1+\vartheta)\,r`$.
//! Without a grazing event in the disc, at which the map is discontinuous, the map is one to one on the disc. So the
//! disc returns inside the image of its rim, and every motion in the disc stays there and tends to the cycle from disc
//! to disc.
//!
//! The rims are sampled in 32 directions, and the disc used is two sizes smaller than the last one that passed. A
//! decision by a trapping region is the same as that of [`settle`](super::settle()) with the same budget. A region is
//! used only if the remaining budget suffices to follow the motion until `settle` finds it captured by the cycle
//! ([`TrappingRegion::depth`]). So the set of known cycles changes the computing time and no verdict. Tests compare
//! both, and [`settle_many`](super::settle_many) checks the first start of every motion.

use super::recurrence;
use crate::flight::SearchLimits;
use crate::math::{Matrix2, sin_cos};
use crate::motion::{EventKind, ImpactState, Motion};
use crate::orbit::{Cycle, Lap, flight_limits};
use crate::system::Oscillator;
use core::f64::consts::{PI, TAU};

/// A disc about one impact of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TrappingRegion {
    center: ImpactState,
    /// $`P/r^2`$: its elements 11, 12, 22.
    form: [f64; 3],
    depth: Depth,
}

/// How long a motion stays in a trapping region until it is so close to the cycle that [`settle`](super::settle())
/// finds it captured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Depth {
    /// The largest number of impacts.
    pub(super) impacts: usize,
    /// The number of search steps; twice those of the cycle.
    pub(super) steps: u64,
}

/// The smallest and the largest radius that are tried (in radians and relative speed), and the ratio of successive
/// radii.
const SMALLEST: f64 = 1e-3;
const LARGEST: f64 = 1.0;
const RATIO: f64 = 1.4;
/// The number of sizes by which the disc used is smaller than the last one that passed.
const INSIDE: usize = 2;
/// Directions in which a rim is sampled.
const DIRECTIONS: u32 = 32;
/// Radii of discs, the largest first, for which it is tested whether motions from the rim count as captured by the
/// cycle.
const CAPTURED: [f64; 6] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
/// Cycles that contract more slowly than this get no trapping region.
const SLOWEST: f64 = 0.97;

impl TrappingRegion {
    /// The largest trapping region about the first impact of a stable `cycle` that does not stick; `None` if even small
    /// discs do not pass or the cycle contracts too slowly. The flights from its rims must end within half of the
    /// `steps` that a search may take, so that those from inside end within all of them.
    pub(super) fn around(osc: &Oscillator, cycle: &Cycle, steps: u32) -> Option<Self> {
        let center = cycle.points.first()?.state;
        if !cycle.rests.is_empty() || cycle.multipliers[0].modulus() > SLOWEST {
            return None;
        }
        let usual = flight_limits(cycle.label.periods);
        let limits = SearchLimits { steps: usual.steps.min(steps / 2), ..usual };
        let lap = lap(osc, cycle, center, limits)?;
        let p = norm(&lap.derivative(osc), center.velocity)?;
        let [a, b, c] = p;
        // theta^2 = 1 - 1 / the largest eigenvalue of Q^-1 P
        let (trace, det) =
            (a + c * center.velocity * center.velocity, (a * c - b * b) * center.velocity * center.velocity);
        let largest = 0.5 * trace + (0.25 * trace * trace - det).max(0.0).sqrt();
        let bound = 0.5 * (1.0 + (1.0 - 1.0 / largest).max(0.0).sqrt());
        let (mut r, mut passed) = (SMALLEST, 0);
        while r <= LARGEST && rim_returns(osc, cycle, (p, r, bound), limits) {
            passed += 1;
            r *= RATIO;
        }
        if passed <= INSIDE {
            return None;
        }
        for _ in 0..=INSIDE {
            r /= RATIO;
        }
        let captured = CAPTURED
            .into_iter()
            .find(|radius| rim(cycle, p, *radius).step_by(4).all(|from| recurrence::captured(osc, &from, cycle)))?;
        // the nonlinear part is proportional to the square of the radius, so half the radius suffices for directions
        // between the samples
        let captured = 0.5 * captured;
        let turns = (crate::math::ln(captured / r) / crate::math::ln(bound)).max(0.0).ceil() + 2.0;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few thousand
        let turns = turns as u32;
        let depth = Depth {
            impacts: turns as usize * cycle.points.len(),
            steps: 2 * u64::from(turns) * steps_of_turn(osc, cycle, center),
        };
        Some(Self { center, form: p.map(|x| x / (r * r)), depth })
    }

    /// How long a motion inside the region is followed until it is decided without the region.
    pub(super) const fn depth(&self) -> Depth {
        self.depth
    }

    /// Whether a motion with this arrival is inside the region.
    #[inline]
    pub(super) fn catches(&self, state: &ImpactState) -> bool {
        let mut turn = state.phase - self.center.phase;
        if turn > PI {
            turn -= TAU;
        } else if turn < -PI {
            turn += TAU;
        }
        let speed = state.velocity - self.center.velocity;
        let [a, b, c] = self.form;
        state.side == self.center.side && (a * turn + 2.0 * b * speed) * turn + c * speed * speed < 1.0
    }
}

/// The number of search steps of one period of the cycle.
fn steps_of_turn(osc: &Oscillator, cycle: &Cycle, from: ImpactState) -> u64 {
    let mut motion = Motion::after(osc, &from, flight_limits(cycle.label.periods));
    let _ = motion.by_ref().filter(|event| matches!(event.kind, EventKind::Impact { .. })).nth(cycle.points.len() - 1);
    motion.steps()
}

/// $`P`$ for $`Q = \mathrm{diag}(1, 1/U^2)`$; `None` if the series does not converge.
fn norm(j: &Matrix2, speed: f64) -> Option<[f64; 3]> {
    let mut p = [0.0; 3];
    let mut power = Matrix2::IDENTITY;
    let q = 1.0 / (speed * speed);
    for _ in 0..2000 {
        let Matrix2([[a, b], [c, d]]) = power;
        let term = [a * a + q * c * c, a * b + q * c * d, b * b + q * d * d];
        p = [p[0] + term[0], p[1] + term[1], p[2] + term[2]];
        if term[0] < 1e-15 * p[0] && term[2] < 1e-15 * p[2] {
            return p.iter().all(|x| x.is_finite()).then_some(p);
        }
        power = j.times(power);
    }
    None
}

/// The motion from a state over the impacts of the cycle; `None` if its impacts are on other stops, or it takes another
/// number of periods.
fn lap(osc: &Oscillator, cycle: &Cycle, from: ImpactState, limits: SearchLimits) -> Option<Lap> {
    let m = u32::try_from(cycle.points.len()).ok()?;
    let lap = Lap::fly(osc, from, m, limits).ok()?;
    let same = lap.points.iter().zip(&cycle.points).all(|((state, _), point)| state.side == point.state.side);
    let whole = (lap.turned - TAU * f64::from(cycle.label.periods)).abs() < PI;
    (same && whole && lap.last.side == from.side).then_some(lap)
}

/// States on the rim of the disc of radius `r` about the first impact of a cycle, in directions evenly spaced in the
/// norm.
fn rim(cycle: &Cycle, [a, b, c]: [f64; 3], r: f64) -> impl Iterator<Item = ImpactState> {
    let center = cycle.points[0].state;
    // P = L L^T, so |L^-T e| = 1 for unit vectors e
    let l11 = a.sqrt();
    let l21 = b / l11;
    let l22 = (c - l21 * l21).sqrt();
    (0..DIRECTIONS).map(move |k| {
        let (sin, cos) = sin_cos(TAU * f64::from(k) / f64::from(DIRECTIONS));
        let speed = r * sin / l22;
        let turn = (r * cos - l21 * speed) / l11;
        ImpactState {
            phase: crate::system::phase::wrap(center.phase + turn),
            velocity: center.velocity + speed,
            side: center.side,
        }
    })
}

/// Whether the motions from the whole rim of a disc return inside `bound` times its radius.
fn rim_returns(osc: &Oscillator, cycle: &Cycle, (p, r, bound): ([f64; 3], f64, f64), limits: SearchLimits) -> bool {
    let (center, [a, b, c]) = (cycle.points[0].state, p);
    rim(cycle, p, r).all(|from| {
        if from.velocity <= 0.0 {
            return false;
        }
        lap(osc, cycle, from, limits).is_some_and(|lap| {
            let turn = crate::system::phase::difference(lap.last.phase, center.phase);
            let speed = lap.last.velocity - center.velocity;
            let size = (a * turn + 2.0 * b * speed) * turn + c * speed * speed;
            size <= bound * bound * r * r
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Mapped, impact_map};
    use crate::orbit::{FindOptions, find};
    use crate::scenario;
    use crate::system::Side;

    /// The arrival after one turn of a cycle.
    fn turned(osc: &Oscillator, from: ImpactState, cycle: &Cycle) -> ImpactState {
        cycle.points.iter().fold(from, |state, _| match impact_map(osc, &state, SearchLimits::default()) {
            Mapped::Impact { state, .. } => state,
            other => panic!("{state:?}: {other:?}"),
        })
    }

    /// Motions started inside, also near the edge, stay inside from turn to turn and tend to that cycle.
    #[test]
    fn what_is_caught_settles_there() {
        let mut traps = 0;
        for point in [scenario::N, scenario::P, scenario::Q, scenario::R, scenario::S, scenario::T] {
            let osc = point.oscillator();
            let labels = point.motions.iter().filter_map(|label| label.parse().ok());
            let orbits = labels.flat_map(|label| find(&osc, label, FindOptions::default()));
            for orbit in orbits.filter(|orbit| orbit.physical && orbit.cycle.stable()) {
                let cycle = &orbit.cycle;
                let Some(trap) = TrappingRegion::around(&osc, cycle, SearchLimits::default().steps) else { continue };
                traps += 1;
                let [a, b, c] = trap.form;
                let mut inside = 0;
                for k in 0..400 {
                    // points of the box round the ellipse, evenly spaced
                    let unit = |step: f64| (0.5 + f64::from(k) * step) % 1.0 * 2.0 - 1.0;
                    let det = a * c - b * b;
                    let state = ImpactState {
                        phase: crate::system::phase::wrap(trap.center.phase + unit(0.754_877_666) * (c / det).sqrt()),
                        velocity: trap.center.velocity + unit(0.569_840_291) * (a / det).sqrt(),
                        side: Side::Upper,
                    };
                    if trap.catches(&state) {
                        inside += 1;
                        let apart = |at: &ImpactState| {
                            let turn = crate::system::phase::difference(at.phase, trap.center.phase);
                            turn.abs() + (at.velocity - trap.center.velocity).abs()
                        };
                        let (mut at, mut turns) = (state, 0);
                        while apart(&at) > 1e-9 {
                            at = turned(&osc, at, cycle);
                            turns += 1;
                            assert!(trap.catches(&at) && turns < 1000, "{} {state:?} {at:?}", point.name);
                        }
                    }
                }
                assert!(inside > 50, "{inside}");
            }
        }
        assert!(traps >= 6, "{traps}");
    }
}
