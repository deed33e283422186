//! Guards as polynomials for structures without modes: the energy of all directions together bounds each.

use super::flight::{MachineFlight, Modes};
use super::guard_polynomial::{GuardPolynomial, ORDER};
use crate::math::dot;
use crate::regime::{TERMS, add_harmonic, derivative_bounds};

/// The Taylor coefficients of all directions at one time, with bounds of their ninth and tenth derivatives over a window,
/// times the powers of its length over the factorials.
#[derive(Clone, Debug, Default)]
pub(super) struct DenseSeries {
    terms: Vec<f64>,
    ninth: f64,
    tenth: f64,
}

impl DenseSeries {
    /// Expands all directions at the time of the modes.
    pub(super) fn expand(&mut self, flight: &MachineFlight, modes: &Modes, window: f64) {
        let Some(dense) = flight.dense() else { return };
        dense.coefficients(&modes.moved, &modes.v, modes.s, TERMS + 1, &mut self.terms);
        // twice the energy of all directions together
        let square = dot(&modes.v, &modes.v) + dot(&modes.moved, &dense.stiffness.apply(&modes.moved));
        // the forces on all directions together
        let drive = &flight.drive;
        let ramp: f64 = drive.ramp.iter().map(|ramp| ramp.abs()).sum();
        let mut push = drive.steady.iter().map(|steady| steady.abs()).sum::<f64>() + ramp * (modes.s + window);
        let mut pushed = [0.0; ORDER];
        for (h, w) in drive.rates.iter().enumerate() {
            let of = drive.harmonics.iter().skip(h).step_by(drive.rates.len());
            let size: f64 = of.map(|(a, b)| a.abs() + b.abs()).sum();
            push += size;
            add_harmonic(&mut pushed, size, w * window);
        }
        pushed[1] += ramp * window;
        // `modes` of such a structure are bounds, the same for all directions
        let Some(mode) = flight.structure.modes.first() else { return };
        (self.ninth, self.tenth) = derivative_bounds(mode, window, square.max(0.0).sqrt(), push, &pushed);
    }

    /// The polynomial of a guard over the window.
    pub(super) fn polynomial(
        &self,
        flight: &MachineFlight,
        g: usize,
        window: f64,
        known: usize,
        modes: &Modes,
    ) -> GuardPolynomial {
        let s = modes.s;
        let (function, start) = (&flight.structure.guards[g].function, &flight.guards[g]);
        let mut p = [0.0; TERMS];
        let mut remainder = 0.0;
        let mut size = 0.0;
        let real = |k: usize| f64::from(u32::try_from(k).unwrap_or(0));
        for i in 0..modes.v.len() {
            let c = &self.terms[i * (TERMS + 1)..(i + 1) * (TERMS + 1)];
            let (a, b) = (function.position[i], function.velocity[i]);
            if a != 0.0 {
                for (sum, c) in p.iter_mut().zip(c) {
                    *sum += a * c;
                }
                remainder += a.abs() * self.ninth;
                size += a.abs() * (c[1] * window).abs().max((c[2] * window * window).abs());
            }
            if b != 0.0 {
                // the velocity has the coefficients of the displacement one power higher
                for k in 0..ORDER {
                    p[k] += b * real(k + 1) * c[k + 1];
                }
                // the ninth coefficient of the velocity is ten times the tenth of the displacement, per length
                remainder += b.abs() * self.tenth * real(ORDER + 1) / window;
                size += b.abs() * c[1].abs().max((c[2] * window).abs());
            }
        }
        p[1] += function.signal.ramp;
        for ((a, b), (turned, w)) in flight.harmonics(g).iter().zip(modes.turned.iter().zip(&flight.structure.rates)) {
            if *a == 0.0 && *b == 0.0 {
                continue;
            }
            // the harmonic and its rate at the time of the modes
            let (mut now, mut next) = (a * turned.cos + b * turned.sin, w * (b * turned.cos - a * turned.sin));
            let mut bound = a.abs() + b.abs();
            size += bound;
            for (k, sum) in p.iter_mut().enumerate().take(ORDER) {
                *sum += now;
                (now, next) = (next, -w * w * now / (real(k + 1) * real(k + 2)));
                bound *= w * window / real(k + 1);
            }
            remainder += bound;
        }
        if let Some(surface) = start.recovery {
            let mut term = surface.size * crate::system::decay(surface.rate * s).0;
            // the series alternates: the first term that is left out bounds the rest
            size += term;
            let mut bound = term;
            for (k, sum) in p.iter_mut().enumerate().take(ORDER) {
                *sum += term;
                term *= -surface.rate / real(k + 1);
                bound *= surface.rate * window / real(k + 1);
            }
            remainder += bound;
        }
        let (value, _, error) = flight.guard(g, modes);
        p[0] = if known > 0 { 0.0 } else { value };
        let mut power = 1.0;
        for c in p.iter_mut().take(ORDER) {
            *c *= power;
            power *= window;
        }
        p[ORDER] = remainder;
        GuardPolynomial::new(p, known, error, size + p[0].abs())
    }
}
