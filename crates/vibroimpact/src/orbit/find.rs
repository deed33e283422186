//! All periodic orbits with a label: Newton's method on the equations of the whole cycle, from many starting guesses.

use super::grazing::grazes;
use super::label::{Count, Label};
use super::physical::Orbit;
use super::ring::Ring;
use super::{DEFAULT_EVENTS, flight_limits, from_release, newton, one_impact, without_impacts};
use crate::math::sort_by;
use crate::motion::{ImpactMap, ImpactState, Mapped};
use crate::system::{Oscillator, Side};
use core::f64::consts::TAU;

/// The starting guesses of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FindOptions {
    /// The number of starting guesses for Newton's method: phases and velocities.
    pub seeds: (u32, u32),
    /// Two orbits that differ by less than this in phase and relative velocity are the same.
    pub tolerance: f64,
}

impl Default for FindOptions {
    /// 48 phases and 24 velocities.
    fn default() -> Self {
        Self { seeds: (48, 24), tolerance: 1e-7 }
    }
}

/// The orbits of `osc` with the label `label`, stable or not, the fastest last. Inadmissible solutions of the equations
/// are included and marked.
///
/// The motion from each starting guess is followed over m impacts. If this takes about n periods, Newton's method
/// solves the [equations](super) of all these impacts.
///
/// - Orbits that stick (all `inf/n`, and m/n with restitution 0) are computed from their release. None is missed.
/// - Orbits with one impact on the first stop are computed in closed form. None is missed.
/// - The orbit 0 is the steady motion [without impacts](without_impacts).
/// - The search for all others is deterministic but not exhaustive: an orbit to which no starting guess leads is not
///   found. Of the inadmissible solutions only some are found.
///
/// A solution with an impact whose speed is zero to within rounding is the orbit without that impact, which grazes the
/// stop there. It is not listed.
#[must_use]
pub fn find(osc: &Oscillator, label: Label, options: FindOptions) -> Vec<Orbit> {
    // it is never stopped
    find_while(osc, label, options, &|| true).unwrap_or_default()
}

/// The same as [`find`], but stopped when `go_on` returns false, and then `None`. `go_on` is called at every starting
/// guess.
#[must_use]
pub fn find_while(
    osc: &Oscillator,
    label: Label,
    options: FindOptions,
    go_on: &dyn Fn() -> bool,
) -> Option<Vec<Orbit>> {
    let mut orbits: Vec<Orbit> = osc
        .stops()
        .filter_map(|(side, _)| from_release(osc, side, DEFAULT_EVENTS))
        .filter(|cycle| cycle.label == label)
        .map(|cycle| Orbit::judged(osc, cycle))
        .collect();
    // with two stops one cycle may have a release from each
    orbits.dedup_by(|a, b| a.cycle.same_as(&b.cycle, options.tolerance));
    let Count::Finite(m) = label.impacts else { return Some(orbits) };
    if m == 0 {
        orbits.extend(without_impacts(osc).filter(|c| c.label == label).map(|cycle| Orbit::judged(osc, cycle)));
        return Some(orbits);
    }
    struck(osc, (m, label.periods), options, &mut orbits, go_on)?;
    sort_by(&mut orbits, |a, b| a.cycle.fastest().total_cmp(&b.cycle.fastest()));
    Some(orbits)
}

/// Adds the orbits with m impacts in n periods that do not stick; m must be positive. `None` once `go_on` has returned
/// false.
pub(crate) fn struck(
    osc: &Oscillator,
    (m, n): (u32, u32),
    options: FindOptions,
    orbits: &mut Vec<Orbit>,
    go_on: &dyn Fn() -> bool,
) -> Option<()> {
    if m == 1 {
        orbits.extend(one_impact(osc, n).into_iter().map(|o| Orbit::judged(osc, o.cycle)));
        if osc.stop(Side::Lower).is_none() {
            return Some(()); // the closed form gives all of them
        }
    }
    for guess in seeds(osc, options.seeds) {
        if !go_on() {
            return None;
        }
        let Some(ring) = chain(osc, guess, m, n) else {
            continue;
        };
        let Some((ring, flights)) = newton::solve(osc, ring) else {
            continue;
        };
        if !ring.sensible() {
            continue;
        }
        let cycle = newton::cycle(osc, &ring, &flights);
        let known = orbits.iter().any(|o| o.cycle.same_as(&cycle, options.tolerance));
        // where the equations are singular (whole natural periods without damping), all speeds zero is a solution too
        if !known
            && cycle.fastest() > REST
            && cycle.residual <= CLOSED
            // an orbit with a graze lies on the border between orbits with and without this impact
            && !(0..ring.len()).any(|k| grazes(osc, &ring, k))
            && ring.smallest(options.tolerance).len() == m as usize
        {
            orbits.push(Orbit::judged(osc, cycle));
        }
    }
    Some(())
}

/// A cycle with a larger residual is refused; the rounding error is usually 1e-15.
const CLOSED: f64 = 1e-11;

/// A solution with no impact faster than this is refused.
const REST: f64 = 1e-9;

/// Arrivals at many phases and velocities. The largest velocity is estimated from the force, the gap and the free
/// response; the others decrease geometrically.
fn seeds(osc: &Oscillator, (phases, speeds): (u32, u32)) -> impl Iterator<Item = ImpactState> {
    let top = 4.0 * osc.size() / (1.0 - osc.restitution()).max(0.1);
    // the smallest is 1/200 of the largest
    let ratio = libm::pow(5e-3, 1.0 / f64::from(speeds.max(2) - 1));
    let sides: Vec<Side> = osc.stops().map(|(side, _)| side).collect();
    sides.into_iter().flat_map(move |side| {
        (0..speeds).flat_map(move |k| {
            let velocity = top * libm::pow(ratio, f64::from(k));
            (0..phases).map(move |j| ImpactState {
                phase: TAU * (f64::from(j) + 0.5) / f64::from(phases),
                velocity,
                side,
            })
        })
    })
}

/// The largest deviation, in forcing periods, of the time of m impacts from n periods.
const OFF: f64 = 0.75;

/// The chain of m impacts that begins with `guess`, closed after n periods. `None` if it takes much more or less time,
/// or if it repeats a shorter cycle for at least half of its impacts, because Newton's method would converge to that
/// cycle.
///
/// If a state of the motion repeats to the last bit, the following impacts are copied.
fn chain(osc: &Oscillator, guess: ImpactState, m: u32, n: u32) -> Option<Ring> {
    let m = m as usize;
    let (mut sides, mut unknowns, mut turns) = (Vec::new(), Vec::new(), Vec::new());
    let (mut state, mut theta) = (guess, guess.phase);
    let full = TAU * f64::from(n);
    // later impacts are compared with this one; its index doubles each time, so every period is detected (R. P. Brent,
    // BIT 20 (1980) 176-184, doi:10.1007/BF01933190)
    let (mut marked, mut mark) = (guess, 0);
    let mut period = None;
    let mut map = ImpactMap::new(osc, flight_limits(n));
    for k in 0..m {
        sides.push(state.side);
        unknowns.extend([theta, state.velocity]);
        if let Some(period) = period {
            let before: usize = k - period;
            turns.push(turns[before]);
            let next = before + 1;
            state = ImpactState { velocity: unknowns[2 * next + 1], side: sides[next], ..state };
        } else {
            let Mapped::Impact { state: next, interval } = map.after(&state) else {
                return None;
            };
            turns.push(osc.beta() * interval);
            state = next;
            if state == marked && k + 1 < m {
                let length = k + 1 - mark;
                if m - mark >= (ROUNDS * length).max(m / 2).max(LONG) {
                    return None;
                }
                period = Some(length);
            } else if k + 1 == (2 * mark).max(1) {
                (marked, mark) = (state, k + 1);
            }
        }
        theta += turns[k];
        if theta - guess.phase > full + OFF * TAU {
            return None;
        }
    }
    let off = theta - guess.phase - full;
    if off < -OFF * TAU || state.side != guess.side {
        return None;
    }
    // the difference is distributed in proportion, so that every time of flight stays positive
    for theta in unknowns.iter_mut().step_by(2) {
        *theta = guess.phase + (*theta - guess.phase) * full / (full + off);
    }
    Some(Ring { sides, unknowns, periods: n })
}

/// A chain that repeats a shorter cycle this many times, and for [`LONG`] impacts, is refused.
const ROUNDS: usize = 8;
/// See [`ROUNDS`].
const LONG: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::impact_map;

    /// The chain computed to its end without copying.
    fn flown(osc: &Oscillator, guess: ImpactState, m: u32, n: u32) -> Option<Ring> {
        let (mut ring, mut state, mut theta) =
            (Ring { sides: Vec::new(), unknowns: Vec::new(), periods: n }, guess, guess.phase);
        for _ in 0..m {
            ring.sides.push(state.side);
            ring.unknowns.extend([theta, state.velocity]);
            let Mapped::Impact { state: next, interval } = impact_map(osc, &state, flight_limits(n)) else {
                return None;
            };
            theta += osc.beta() * interval;
            state = next;
        }
        let (full, off) = (TAU * f64::from(n), theta - guess.phase - TAU * f64::from(n));
        let close = off.abs() <= OFF * TAU && state.side == guess.side;
        ring.unknowns.iter_mut().step_by(2).for_each(|t| *t = guess.phase + (*t - guess.phase) * full / (full + off));
        close.then_some(ring)
    }

    /// Copied impacts equal computed ones, and a chain that repeats itself for long leads to no orbit.
    #[test]
    fn f12_a_chain_that_repeats_itself() {
        // rapid convergence to cycles of one, two and three impacts
        for (inverse, gap, eps) in [(1.3, 0.75, 0.1), (1.11, 2.2, 0.3), (1.5, 0.1, 0.2), (2.0, 0.0, 0.4)] {
            let osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap();
            for guess in seeds(&osc, (6, 4)) {
                for (m, n) in [(1, 1), (3, 3), (40, 40), (63, 63), (60, 30), (62, 31)] {
                    assert_eq!(chain(&osc, guess, m, n), flown(&osc, guess, m, n));
                }
                for (m, n) in [(10_000, 10_000), (10_000, 5_000), (10_000, 20_000)] {
                    assert_eq!(chain(&osc, guess, m, n), None);
                }
            }
        }
    }
}
