//! Integrals over a flight, by Gauss-Legendre quadrature of the closed form.
//!
//! Position and velocity of a flight are entire functions of time that change at most at the rate
//! $`\mu = \max(\beta, 1 + 2\zeta)`$. Over a panel of length $`h`$ the rule with 16 points has the relative error
//! $`(2\mu h)^{32}\,(16!)^4/(33\,(32!)^3)`$ for a product of two of them, which is below $`10^{-19}`$ for
//! $`\mu h \le 5`$. So the integrals are right to rounding.

use super::{Flight, FlightPoint};
use crate::math::RULE;

/// The longest panel, in units of the time in which a function changes.
pub(crate) const PANEL: f64 = 5.0;

/// Integrals over a flight, or sums of them over several flights.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlightIntegrals {
    /// $`\int x\,ds`$.
    pub x: f64,
    /// $`\int x^2\,ds`$.
    pub x_squared: f64,
    /// $`\int v^2\,ds`$.
    pub v_squared: f64,
    /// The work of the force, $`\int v\,\sin(\beta\tau + \varphi)\,ds`$.
    pub work: f64,
}

impl FlightIntegrals {
    /// Adds the integrals over the first `duration` of a flight.
    pub fn add(&mut self, flight: &Flight, duration: f64) {
        let zeta2 = 2.0 * flight.response().damping();
        integrate(flight, duration, 0.0, |_, weight, point| {
            // the force follows from the equation of motion
            let force = point.a + point.x + zeta2 * point.v;
            self.x += weight * point.x;
            self.x_squared += weight * point.x * point.x;
            self.v_squared += weight * point.v * point.v;
            self.work += weight * force * point.v;
        });
    }
}

/// Calls `sum` with the time, the weight and the point of the flight at each point of the quadrature over the first
/// `duration`. `rate` is the rate of a factor that `sum` adds to the integrand, such as the frequency of a harmonic.
pub fn integrate(flight: &Flight, duration: f64, rate: f64, mut sum: impl FnMut(f64, f64, &FlightPoint)) {
    for (middle, half) in panels(flight, duration, rate) {
        for (place, weight) in RULE {
            for s in [middle - half * place, middle + half * place] {
                sum(s, half * weight, &flight.at(s));
            }
        }
    }
}

/// The middles and half lengths of the panels of the quadrature over the first `duration` of a flight, for an integrand
/// with a factor of this rate.
fn panels(flight: &Flight, duration: f64, rate: f64) -> impl Iterator<Item = (f64, f64)> {
    let shortest = PANEL / flight.fastest;
    let slow = PANEL / (flight.response().beta().max(1.0) + rate);
    let mut begin = 0.0;
    core::iter::from_fn(move || {
        if begin >= duration {
            return None;
        }
        // With heavy damping the fast part of the flight decays, and later panels can be longer. What is left of this
        // part there is far below the error of the rule.
        let length = (shortest + 0.5 * begin).min(slow);
        // the rest is divided into two equal panels, rather than into a long and a very short one
        let rest = duration - begin;
        let length = if rest <= length {
            rest
        } else if rest < 2.0 * length {
            0.5 * rest
        } else {
            length
        };
        let panel = (begin + 0.5 * length, 0.5 * length);
        begin = if rest <= length { duration } else { begin + length };
        Some(panel)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Oscillator, Start};

    /// The energy changes by the work of the force less the loss in the damper. This tests two integrals against the
    /// closed form, for every frequency and damping.
    #[test]
    fn work_and_loss_are_the_change_of_energy() {
        for beta in [1e-3, 0.3, 1.0, 1.0 + 1e-9, 2.7, 40.0] {
            for zeta in [0.0, 1e-6, 0.1, 1.0, 3.0, 400.0] {
                let osc = Oscillator::new(beta, 5.0, 0.5).unwrap().with_damping(zeta).unwrap();
                let flight = Flight::new(&osc, Start { x: 0.4, v: -1.3, phase: 2.0 });
                for duration in [1e-9, 0.02, 1.0, 7.7, 60.0] {
                    let mut sums = FlightIntegrals::default();
                    sums.add(&flight, duration);
                    let energy = |(x, v): (f64, f64)| 0.5 * (x * x + v * v);
                    let (x, v) = flight.state(duration);
                    // the difference of the energies, without cancellation for a short flight
                    let point = flight.at(duration);
                    let gained = if duration < 0.1 {
                        0.5 * point.displacement * (x + flight.x) + 0.5 * (v - flight.v) * (v + flight.v)
                    } else {
                        energy((x, v)) - energy((flight.x, flight.v))
                    };
                    let balance = sums.work - 2.0 * zeta * sums.v_squared - gained;
                    let scale = 1.0 + energy((x, v));
                    assert!(balance.abs() < 4e-14 * scale, "beta {beta} zeta {zeta} s {duration}: {balance:e}");
                }
            }
        }
    }

    /// Integrals of the steady response, which is a sine.
    #[test]
    fn mean_squares_of_a_sine() {
        // resonance with zeta = 1/4: x = -2 cos(s) for the phase 0
        let osc = Oscillator::new(1.0, 5.0, 0.5).unwrap().with_damping(0.25).unwrap();
        let flight = Flight::new(&osc, Start { x: -2.0, v: 0.0, phase: 0.0 });
        let mut sums = FlightIntegrals::default();
        sums.add(&flight, osc.period());
        let pi = core::f64::consts::PI;
        assert!(sums.x.abs() < 1e-14);
        assert!((sums.x_squared - 4.0 * pi).abs() < 1e-13);
        assert!((sums.v_squared - 4.0 * pi).abs() < 1e-13);
        assert!((sums.work - 2.0 * pi).abs() < 1e-13);
    }
}
