//! All periodic orbits of a label: the closed form where there is one, Newton's method from many seeds everywhere.

use super::{Cycle, DEFAULT_EVENTS, flight_limits, from_release, one_impact, shoot};
use crate::motion::{ImpactState, Mapped, impact_map};
use crate::system::{Oscillator, Side};
use crate::verdict::{Count, Label};
use core::f64::consts::TAU;

/// A periodic orbit, and whether it is a possible motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    /// The cycle.
    pub cycle: Cycle,
    /// False for an algebraic solution that passes through a stop on its way.
    pub physical: bool,
}

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

/// The orbits of `osc` that are called `label`, stable or not, the fastest last.
///
/// Orbits with a rest in them - all `inf/n`, and m/n with restitution 0 - come from their release, and none can be
/// missed. The search for the others is deterministic but not exhaustive: an orbit that no seed leads to is not found.
#[must_use]
pub fn find(osc: &Oscillator, label: Label, options: FindOptions) -> Vec<Orbit> {
    let mut orbits: Vec<Orbit> = osc
        .stops()
        .filter_map(|(side, _)| from_release(osc, side, DEFAULT_EVENTS))
        .filter(|cycle| cycle.label == label)
        .map(|cycle| Orbit { cycle, physical: true })
        .collect();
    // with two stops one cycle may have a release from each
    orbits.dedup_by(|a, b| a.cycle.same_as(&b.cycle, options.tolerance));
    let Count::Finite(m) = label.impacts else { return orbits };
    if m == 1 {
        orbits
            .extend(one_impact(osc, label.periods).into_iter().map(|o| Orbit { cycle: o.cycle, physical: o.physical }));
    }
    for guess in seeds(osc, options.seeds) {
        if !promising(osc, guess, m, label.periods) {
            continue;
        }
        let Ok(cycle) = shoot(osc, guess, m, label.periods) else {
            continue;
        };
        let known = orbits.iter().any(|o| o.cycle.same_as(&cycle, options.tolerance));
        if cycle.label == label && !known {
            orbits.push(Orbit { cycle, physical: true });
        }
    }
    orbits.sort_by(|a, b| a.cycle.fastest().total_cmp(&b.cycle.fastest()));
    orbits
}

/// Arrivals spread over phase and velocity. Speeds go up to what n periods of forcing, the gap and the free response
/// could feed, geometrically towards small ones.
fn seeds(osc: &Oscillator, (phases, speeds): (u32, u32)) -> impl Iterator<Item = ImpactState> {
    let top = 4.0 * osc.size() / (1.0 - osc.restitution()).max(0.1);
    let sides: Vec<Side> = osc.stops().map(|(side, _)| side).collect();
    sides.into_iter().flat_map(move |side| {
        (0..speeds).flat_map(move |k| {
            let velocity = top * libm::pow(0.8, f64::from(k));
            (0..phases).map(move |j| ImpactState {
                phase: TAU * (f64::from(j) + 0.5) / f64::from(phases),
                velocity,
                side,
            })
        })
    })
}

/// Whether m impacts from here take something like n periods: a seed that is far off rarely converges to this label.
fn promising(osc: &Oscillator, guess: ImpactState, m: u32, n: u32) -> bool {
    let (mut state, mut time) = (guess, 0.0);
    for _ in 0..m {
        match impact_map(osc, &state, flight_limits(n)) {
            Mapped::Impact { state: next, interval } => {
                state = next;
                time += interval;
            }
            _ => return false,
        }
    }
    (time / osc.period() - f64::from(n)).abs() < 0.75
}

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
}
