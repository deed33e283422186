//! The guards of a flight as polynomials over a window from one time on, by the series of its structure.

use super::flight::{MachineFlight, Modes};
use super::guard_polynomial::{GuardPolynomial, ORDER};
use crate::regime::Window;
use crate::system::decay;

/// The state at one time: displacement, velocity and force of each mode, cosine and sine of each harmonic, time, one.
#[derive(Clone, Debug, Default)]
pub(super) struct Expansion {
    z: Vec<f64>,
    /// The energy of each mode.
    energies: Vec<f64>,
}

impl Expansion {
    /// Sets the state to that of the modes at their time.
    pub(super) fn settle(&mut self, flight: &MachineFlight, modes: &Modes) {
        self.z.clear();
        for i in 0..modes.moved.len() {
            // the harmonics stand at the end of the state, so the force here is the constant and the ramp only
            self.z.extend([modes.moved[i], modes.v[i], flight.drive.steady[i] + flight.drive.ramp[i] * modes.s]);
        }
        for ((sin, cos), turned) in flight.turns.iter().zip(&modes.turned) {
            // by the addition theorems from the phase of the beginning: no angle is added up
            self.z.extend([cos * turned.cos - sin * turned.sin, sin * turned.cos + cos * turned.sin]);
        }
        // time and one make the equations of the state linear and homogeneous, with ramps too
        self.z.extend([modes.s, 1.0]);
        self.energies.clear();
        // of each mode about the equilibrium under the constant force, \sqrt{\dot y^2 + k(y - q/k)^2}
        self.energies.extend(flight.structure.modes.iter().zip(self.z.chunks_exact(3)).map(|(mode, z)| {
            if mode.k <= 0.0 {
                return z[1].abs();
            }
            let shifted = z[0] - z[2] / mode.k;
            (z[1] * z[1] + mode.k * shifted * shifted).sqrt()
        }));
    }

    /// The polynomial of a guard over a time `length` from this state, which is that of these modes, with a window of the
    /// structure. Of what is faint there its lower bound is taken: of a mode that of its free part, and of a fast decay
    /// $`-|F|(\lambda t)^n/n!`$ where the first $`n`$ derivatives of the guard are zero.
    pub(super) fn polynomial(
        &self,
        flight: &MachineFlight,
        g: usize,
        window: &Window,
        length: f64,
        known: usize,
        modes: &Modes,
    ) -> GuardPolynomial {
        let (series, start) = (&window.guards[g], &flight.guards[g]);
        let mut p = series.at(&self.z);
        let part = length / window.length;
        let (value, _, error) = flight.guard(g, modes);
        // a guard on which the flight begins is exactly zero, and so are its derivatives up to `known`
        p[0] = if known > 0 { 0.0 } else { value - series.lowered_by_modes(&window.faint, &self.z) };
        p[ORDER] = series.remainder(&self.energies, &self.z);
        let lowest = known.min(ORDER - 1);
        p[..lowest].fill(0.0);
        p[lowest] -= series.lowered_by_decays(&window.faint, &self.z, (lowest, window.length));
        let mut power = 1.0;
        for c in &mut p {
            // in a window without end there are zeros times infinity
            if *c != 0.0 {
                *c *= power;
            }
            power *= part;
        }
        // what rounding errors are relative to: a guard that begins at zero is as large as its first terms
        let mut size = p[0].abs();
        if known > 0 {
            size += (series.size(&self.z, 1) * part).max(series.size(&self.z, 2) * part * part);
        }
        if let Some(surface) = start.recovery {
            let mut term = surface.size * decay(surface.rate * modes.s).0;
            size += term;
            let (mut bound, mut k) = (term, 1.0);
            // a(-kappa t)^k/k!; the series alternates, so the next term bounds the rest
            for c in &mut p[1..ORDER] {
                term *= -surface.rate * length / k;
                bound *= surface.rate * length / k;
                *c += term;
                k += 1.0;
            }
            p[ORDER] += bound * surface.rate * length / k;
        }
        GuardPolynomial::new(p, known, error, size)
    }

    /// The length of the longest window from these modes on in which something is faint and all guards are positive, also
    /// guards that are zero here and those of stops with a surface that recovers.
    pub(super) fn long_window(&self, flight: &MachineFlight, modes: &Modes, until: f64) -> Option<f64> {
        let positive = |window: &&Window| {
            let mut guards = flight.guards.iter().enumerate();
            guards.all(|(g, guard)| {
                // only the beginning lies on a guard; later its derivatives are not known to vanish
                let known = if modes.s == 0.0 { guard.known } else { 0 };
                // of a mode that is faint no derivative is known
                let is_known = known > 0 && !window.leaves_out_decays();
                !is_known && self.polynomial(flight, g, window, window.length, known, modes).is_positive()
            })
        };
        let useful = |window: &&Window| !window.faint.is_empty() && window.length <= until;
        // windows are sorted from short to long: the last that is positive is the longest
        flight.structure.windows().iter().rev().filter(useful).find(positive).map(|window| window.length)
    }
}
