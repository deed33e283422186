//! The largest and smallest position, and the largest speed and acceleration of a flight.
//!
//! A function $`f`$ with $`|f'''| \le B`$ satisfies $`f(s+r) \le f + f'r + f''r^2/2 + Br^3/6`$. An interval over which
//! this bound does not exceed the largest value so far is left out; the others are halved. So no maximum is missed, and
//! only a few short intervals about each maximum remain.

use super::bounds::{Window, radius};
use super::{Flight, FlightPoint};

/// The extremes over a flight, or over several flights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// The smallest position.
    pub lowest: f64,
    /// The largest position.
    pub highest: f64,
    /// The largest speed.
    pub speed: f64,
    /// The largest absolute value of the acceleration.
    pub acceleration: f64,
}

impl Default for Extremes {
    /// Those of no flight: an empty range of positions, and zero.
    fn default() -> Self {
        Self { lowest: f64::INFINITY, highest: f64::NEG_INFINITY, speed: 0.0, acceleration: 0.0 }
    }
}

/// Accuracy of an extreme, relative to the size of the motion.
const ACCURACY: f64 = 4.0 * f64::EPSILON;

/// A function over an interval: its value and derivatives at the beginning, a bound of its third derivative, and a
/// difference in value that does not matter.
#[derive(Clone, Copy)]
struct Local {
    value: f64,
    first: f64,
    second: f64,
    bound: f64,
    small: f64,
}

impl Local {
    const fn mirrored(self) -> Self {
        Self { value: -self.value, first: -self.first, second: -self.second, ..self }
    }

    /// The largest value of the quadratic part over the first `h` of the interval, and where that is.
    fn highest(&self, h: f64) -> (f64, f64) {
        let at = |s: f64| self.value + s * (self.first + 0.5 * self.second * s);
        let peak = -self.first / self.second;
        let inside = self.second < 0.0 && peak > 0.0 && peak < h;
        let ends = if at(h) > self.value { (at(h), h) } else { (self.value, 0.0) };
        if inside { (at(peak), peak) } else { ends }
    }
}

impl Extremes {
    /// Includes the first `duration` of a flight.
    pub fn add(&mut self, flight: &Flight, duration: f64) {
        // over longer windows the bounds are too wide to leave anything out
        let most = 1.5 / (1.0 + flight.fastest);
        self.include_point(&flight.at(duration));
        let pieces = (duration / most).ceil().max(1.0);
        let step = duration / pieces;
        let mut k = 0.0;
        while k < pieces {
            self.search(flight, k * step, step);
            k += 1.0;
        }
    }

    /// Includes a position at which the mass rests.
    pub fn rest(&mut self, x: f64) {
        self.lowest = self.lowest.min(x);
        self.highest = self.highest.max(x);
    }

    fn include_point(&mut self, point: &FlightPoint) {
        self.rest(point.x);
        self.speed = self.speed.max(point.v.abs());
        self.acceleration = self.acceleration.max(point.a.abs());
    }

    /// Includes the interval of length `h` that begins at `s`.
    fn search(&mut self, flight: &Flight, s: f64, h: f64) {
        let (beta, zeta2) = (flight.response().beta(), 2.0 * flight.response().damping());
        let point = flight.at(s);
        self.include_point(&point);
        let force = point.a + point.x + zeta2 * point.v;
        let snap = -beta * beta * force - point.a - zeta2 * point.j;
        let r = radius(point.x, point.v);
        let window = Window::new(flight, r, point.v.abs(), h);
        // relative to the largest values so far: at rest in the middle the radius itself is 0
        let size = r.max(self.speed).max(self.highest.abs().min(f64::MAX)).max(self.lowest.abs().min(f64::MAX));
        let small = ACCURACY * size;
        let x = Local { value: point.x, first: point.v, second: point.a, bound: window.b3, small };
        let v = Local { value: point.v, first: point.a, second: point.j, bound: window.b4(flight), small };
        let small = ACCURACY * (1.0 + size + zeta2 * point.v.abs());
        let a = Local { value: point.a, first: point.j, second: snap, bound: window.b5(flight), small };
        let mut open = false;
        let targets = [
            (x.mirrored(), -self.lowest),
            (x, self.highest),
            (v.mirrored(), self.speed),
            (v, self.speed),
            (a.mirrored(), self.acceleration),
            (a, self.acceleration),
        ];
        for (local, best) in targets {
            let (most, place) = local.highest(h);
            let error = local.bound * h * h * h / 6.0;
            if most + error > best + local.small {
                // a value near the maximum lets most other intervals be left out
                self.include_point(&flight.at(s + place));
                // below this error the quadratic part has the maximum itself
                open |= error > local.small;
            }
        }
        if open {
            self.search(flight, s, 0.5 * h);
            self.search(flight, s + 0.5 * h, 0.5 * h);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{Oscillator, Start};

    /// Against the largest of very many points of the flight, from above, and to within their spacing.
    #[test]
    fn nothing_exceeds_the_extremes() {
        for (beta, zeta) in [(0.05, 0.0), (0.7, 0.02), (1.0, 0.0), (1.0, 0.5), (2.3, 0.1), (11.0, 0.0), (0.4, 20.0)] {
            let osc = Oscillator::new(beta, 9.0, 0.5).unwrap().with_damping(zeta).unwrap();
            for (x, v, phase) in [(0.0, 0.0, 0.0), (0.7, -1.1, 4.0), (-2.0, 0.3, 1.0), (1e-3, 1e-3, 6.0)] {
                let flight = Flight::new(&osc, Start { x, v, phase });
                for duration in [1e-6, 0.4, 3.0, 25.0] {
                    let mut found = Extremes::default();
                    found.add(&flight, duration);
                    let mut seen = Extremes::default();
                    for k in 0..=20_000 {
                        seen.include_point(&flight.at(duration * f64::from(k) / 20_000.0));
                    }
                    let spacing = (1.0 + flight.fastest) * duration / 20_000.0;
                    for (found, seen) in [
                        (-found.lowest, -seen.lowest),
                        (found.highest, seen.highest),
                        (found.speed, seen.speed),
                        (found.acceleration, seen.acceleration),
                    ] {
                        let scale = 1.0 + seen.abs();
                        assert!(found >= seen - 1e-14 * scale, "beta {beta} zeta {zeta} {duration}: {found} {seen}");
                        assert!(found <= seen + (1.0 + beta + zeta).powi(3) * spacing * spacing * scale + 1e-14);
                    }
                }
            }
        }
    }

    /// The steady response at resonance with damping 1/4 is -2 cos(s), which has all extremes inside the flight.
    #[test]
    fn extremes_of_a_sine_are_right_to_rounding() {
        let osc = Oscillator::new(1.0, 5.0, 0.5).unwrap().with_damping(0.25).unwrap();
        let (begin, pi) = (0.3_f64, core::f64::consts::PI);
        let start = Start { x: -2.0 * begin.cos(), v: 2.0 * begin.sin(), phase: begin };
        let mut found = Extremes::default();
        found.add(&Flight::new(&osc, start), 2.0 * pi);
        for value in [-found.lowest, found.highest, found.speed, found.acceleration] {
            assert!((value - 2.0).abs() < 4e-15, "{found:?}");
        }
    }
}
