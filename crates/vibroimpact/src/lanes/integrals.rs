//! Integrals over a flight, with the points of the quadrature side by side.
//!
//! The rule is that of [`FlightIntegrals::add`], which computes one point at a time and serves heavily damped flights,
//! short ones and very long ones. Each point of the rule has sums of its own, which are added to each
//! other last and in their order. So the results have the same bits for all widths.

use super::points::{PLACES, Panels, Points, suited};
use super::width::{Task, Width};
use crate::flight::{Flight, FlightIntegrals, PANEL};
use crate::math::{Lane, POINTS};

/// Adds the integrals over the first `duration` of a flight; the panels are those of its oscillator.
pub(crate) fn add_integrals(integrals: &mut FlightIntegrals, panels: &Panels, flight: &Flight, duration: f64) {
    add_with(Width::best(), integrals, panels, flight, duration);
}

fn add_with(width: Width, integrals: &mut FlightIntegrals, panels: &Panels, flight: &Flight, duration: f64) {
    if !suited(flight, duration) {
        return integrals.add(flight, duration);
    }
    let sums = width.run(Sums { flight, duration, panels });
    // in the order of the points, whatever the width
    let [x, x_squared, v_squared, work] = sums.map(|points| points.into_iter().sum::<f64>());
    integrals.x += x;
    integrals.x_squared += x_squared;
    integrals.v_squared += v_squared;
    integrals.work += work;
}

/// The sums over all panels.
struct Sums<'a> {
    flight: &'a Flight,
    duration: f64,
    panels: &'a Panels,
}

impl Task for Sums<'_> {
    /// The integrals of [`FlightIntegrals`], in their order, for each point of the rule.
    type Output = [[f64; POINTS]; 4];

    #[inline(always)]
    fn run<L: Lane>(self) -> Self::Output {
        let response = self.flight.response();
        let longest = PANEL / self.flight.fastest();
        let mut sums = Self::Output::default();
        let (mut here, mut left) = (Points::begin(self.flight), self.duration);
        while left > longest {
            let panel = self.panels.longest(self.flight);
            let mut k = 0;
            while k < POINTS {
                add(&mut sums, k, panel.half, here.then::<L>(response.beta(), &panel.places.load(k)));
                k += L::WIDTH;
            }
            here = here.then(response.beta(), &panel.end);
            left -= longest;
        }
        // the last panel is shorter, with points of its own
        let half = 0.5 * left;
        let mut k = 0;
        while k < POINTS {
            let after = response.nearby(half, L::splat(half) * L::load(&PLACES.0[k..]));
            add(&mut sums, k, half, here.then::<L>(response.beta(), &after));
            k += L::WIDTH;
        }
        sums
    }
}

/// Adds the points from number `k` on of a panel of this half length.
#[inline(always)]
fn add<L: Lane>(sums: &mut [[f64; POINTS]; 4], k: usize, half: f64, points: Points<L>) {
    let Points { x, v, sin: force, .. } = points;
    let weight = L::splat(half) * L::load(&PLACES.1[k..]);
    let (of_x, of_v) = (weight * x, weight * v);
    let terms = [of_x, of_x * x, of_v * v, of_v * force];
    let mut row = 0;
    while row < terms.len() {
        let sum = &mut sums[row][k..];
        (L::load(sum) + terms[row]).store(sum);
        row += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Oscillator, Start};

    fn bits(sums: &FlightIntegrals) -> [u64; 4] {
        [sums.x, sums.x_squared, sums.v_squared, sums.work].map(f64::to_bits)
    }

    /// The widths agree to the bit, and with one point at a time to rounding, at and near resonance and far from it.
    #[test]
    fn all_widths_agree_with_each_other_and_with_one_point_at_a_time() {
        for beta in [1e-3, 0.3, 0.5, 1.0, 1.0 + 1e-9, 2.0, 2.7, 40.0] {
            for zeta in [0.0, 1e-6, 0.02, 0.4, 0.7] {
                let osc = Oscillator::new(beta, 5.0, 0.5).unwrap().with_damping(zeta).unwrap();
                let panels = Panels::default();
                for (x, v, phase) in [(0.4, -1.3, 2.0), (5.0, -1e-3, 0.0), (-3.0, 7.0, 6.1), (0.0, 0.0, 1.0)] {
                    let flight = Flight::new(&osc, Start { x, v, phase });
                    for duration in [1e-9, 0.2, 0.3, 1.0, 7.7, 60.0, 2e3] {
                        let mut single = FlightIntegrals::default();
                        single.add(&flight, duration);
                        let mut portable = FlightIntegrals::default();
                        add_with(Width::Portable, &mut portable, &panels, &flight, duration);
                        // the size of the motion, whose rounding errors the closed forms have
                        let size = (1.0 + x.abs() + v.abs()).powi(2) + single.x_squared + single.v_squared;
                        let close = 1e-15 * (1.0 + duration) * (1.0 + duration * beta.max(1.0)) * size;
                        for (a, b) in [
                            (single.x, portable.x),
                            (single.x_squared, portable.x_squared),
                            (single.v_squared, portable.v_squared),
                            (single.work, portable.work),
                        ] {
                            assert!((a - b).abs() < close, "beta {beta} {x} {v} s {duration}: {a:e} {b:e} {:e}", a - b);
                        }
                        for width in Width::ALL.into_iter().filter(|width| width.available()) {
                            let mut other = FlightIntegrals::default();
                            add_with(width, &mut other, &panels, &flight, duration);
                            assert_eq!(bits(&other), bits(&portable), "{width:?} beta {beta} s {duration}");
                        }
                    }
                }
            }
        }
    }

    /// The energy changes by the work of the force less the loss in the damper.
    #[test]
    fn work_and_loss_are_the_change_of_energy() {
        for beta in [1e-3, 0.3, 1.0, 1.0 + 1e-9, 2.7, 40.0] {
            for zeta in [0.0, 1e-6, 0.02, 0.4] {
                let osc = Oscillator::new(beta, 5.0, 0.5).unwrap().with_damping(zeta).unwrap();
                let flight = Flight::new(&osc, Start { x: 0.4, v: -1.3, phase: 2.0 });
                let panels = Panels::default();
                for duration in [0.3, 1.0, 7.7, 60.0] {
                    let mut sums = FlightIntegrals::default();
                    add_integrals(&mut sums, &panels, &flight, duration);
                    let energy = |(x, v): (f64, f64)| 0.5 * (x * x + v * v);
                    let gained = energy(flight.state(duration)) - energy((flight.x, flight.v));
                    let scale = 1.0 + energy(flight.state(duration));
                    let balance = sums.work - 2.0 * zeta * sums.v_squared - gained;
                    assert!(balance.abs() < 4e-14 * scale, "beta {beta} zeta {zeta} s {duration}: {balance:e}");
                }
            }
        }
    }
}
