//! All periodic orbits of a label: Newton's method on the equations of the whole cycle, from many seeds.

use super::grazing::grazes;
use super::label::{Count, Label};
use super::physical::Orbit;
use super::ring::Ring;
use super::{DEFAULT_EVENTS, flight_limits, from_release, newton, one_impact, without_impacts};
use crate::motion::{ImpactState, Mapped, impact_map};
use crate::system::{Oscillator, Side};
use core::f64::consts::TAU;

/// How hard to look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FindOptions {
    /// Seeds for Newton's method: phases times velocities.
    pub seeds: (u32, u32),
    /// Two orbits closer than this in phase and relative velocity are one.
    pub tolerance: f64,
}

impl Default for FindOptions {
    /// 48 phases times 24 velocities.
    fn default() -> Self {
        Self { seeds: (48, 24), tolerance: 1e-7 }
    }
}

/// The orbits of `osc` that are called `label`, stable or not, the fastest last; solutions of the equations that are no
/// possible motions are among them, marked.
///
/// Each seed is flown through m impacts, and where that takes something like n periods, Newton's method closes the
/// whole chain of impacts at once ([equations](super)). Orbits with a rest in them - all `inf/n`, and m/n with
/// restitution 0 - come from their release, and none can be missed; those with one impact a period come from their
/// closed form, and none can be missed; 0 is the steady motion [without impacts](without_impacts). The search for the others is deterministic but not exhaustive: an orbit that no
/// seed leads to is not found. Of the inadmissible solutions only some come up. A solution with an impact whose speed is
/// zero to within rounding is the orbit without that impact, which touches the stop there, and is not listed.
#[must_use]
pub fn find(osc: &Oscillator, label: Label, options: FindOptions) -> Vec<Orbit> {
    // nothing stops it
    find_while(osc, label, options, || true).unwrap_or_default()
}

/// The same as [`find`], as long as `go_on` says yes when asked, which it is at every seed; `None` once it said no.
#[must_use]
pub fn find_while(
    osc: &Oscillator,
    label: Label,
    options: FindOptions,
    go_on: impl Fn() -> bool,
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
    orbits.sort_by(|a, b| a.cycle.fastest().total_cmp(&b.cycle.fastest()));
    Some(orbits)
}

/// Adds the orbits with m impacts in n periods, m positive, that never rest; `None` once `go_on` said no.
pub(crate) fn struck(
    osc: &Oscillator,
    (m, n): (u32, u32),
    options: FindOptions,
    orbits: &mut Vec<Orbit>,
    go_on: impl Fn() -> bool,
) -> Option<()> {
    if m == 1 {
        orbits.extend(one_impact(osc, n).into_iter().map(|o| Orbit::judged(osc, o.cycle)));
        if osc.stop(Side::Lower).is_none() {
            return Some(()); // that was all of them
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
        // where the equations are singular (whole natural periods without damping) rest itself solves them
        if !known
            && cycle.fastest() > REST
            && cycle.residual <= CLOSED
            && !(0..ring.len()).any(|k| grazes(osc, &ring, k))
            && ring.smallest(options.tolerance).len() == m as usize
        {
            orbits.push(Orbit::judged(osc, cycle));
        }
    }
    Some(())
}

/// Flights that miss by no more than this close a cycle; what rounding leaves is usually 1e-15.
const CLOSED: f64 = 1e-11;

/// A cycle none of whose impacts is faster is no cycle.
const REST: f64 = 1e-9;

/// Arrivals spread over phase and velocity. Speeds go up to what n periods of forcing, the gap and the free response
/// could feed, geometrically towards small ones.
fn seeds(osc: &Oscillator, (phases, speeds): (u32, u32)) -> impl Iterator<Item = ImpactState> {
    let top = 4.0 * osc.size() / (1.0 - osc.restitution()).max(0.1);
    // down to a two-hundredth
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

/// Periods by which the time of m impacts may differ from n for a chain worth closing.
const OFF: f64 = 0.75;

/// The chain of m impacts that begins with `guess`, closed after n periods; `None` where it takes far more or less, or where it
/// settles into a shorter cycle for at least half of its impacts: Newton's method would close that one.
///
/// A motion that comes back to the same numbers goes on with the same numbers, so it is flown no further.
fn chain(osc: &Oscillator, guess: ImpactState, m: u32, n: u32) -> Option<Ring> {
    let m = m as usize;
    let (mut sides, mut unknowns, mut turns) = (Vec::new(), Vec::new(), Vec::new());
    let (mut state, mut theta) = (guess, guess.phase);
    let full = TAU * f64::from(n);
    // the impact that later ones are compared with: twice as far on every time, so that every period is met
    // (R. P. Brent, BIT 20 (1980) 176-184, doi:10.1007/BF01933190)
    let (mut marked, mut mark) = (guess, 0);
    let mut period = None;
    for k in 0..m {
        sides.push(state.side);
        unknowns.extend([theta, state.velocity]);
        if let Some(period) = period {
            let before: usize = k - period;
            turns.push(turns[before]);
            let next = before + 1;
            state = ImpactState { velocity: unknowns[2 * next + 1], side: sides[next], ..state };
        } else {
            let Mapped::Impact { state: next, interval } = impact_map(osc, &state, flight_limits(n)) else {
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
    // the surplus is shared out, so that every flight keeps a positive time
    for theta in unknowns.iter_mut().step_by(2) {
        *theta = guess.phase + (*theta - guess.phase) * full / (full + off);
    }
    Some(Ring { sides, unknowns, periods: n })
}

/// A chain that goes round a shorter cycle this many times, and for [`LONG`] impacts, has settled into it.
const ROUNDS: usize = 8;
/// See [`ROUNDS`].
const LONG: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_motions_at_t_and_the_doubled_one() {
        let osc = Oscillator::from_inverse_beta(1.11, 2.0, 0.5).unwrap();
        let one = find(&osc, Label::new(1, 1), FindOptions::default());
        assert_eq!(one.iter().filter(|o| o.physical).count(), 1);
        assert!(!one.iter().any(|o| o.physical && o.cycle.stable()));
        let half = find(&osc, Label::new(1, 2), FindOptions::default());
        assert!(half.iter().any(|o| o.physical && o.cycle.stable()));
    }

    /// The chain flown to its end.
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

    /// What repeats itself to the last bit is not flown again, and says the same; what does so for long leads to no orbit.
    #[test]
    fn f12_a_chain_that_repeats_itself() {
        // fast settling, onto cycles of one, two and three impacts
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
