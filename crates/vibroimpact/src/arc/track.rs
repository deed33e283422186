//! The state of a flight that goes on window by window: what is proven free of zeros is passed without the closed form.

use super::flight::{MachineFlight, Modes};
use super::guard_polynomial::{GuardPolynomial, ORDER};
use crate::regime::{ALL, Window};

/// The state at one time: displacement, velocity and force of each mode, cosine and sine of each harmonic, time, one.
#[derive(Clone, Debug, Default)]
pub(super) struct Track {
    pub(super) z: Vec<f64>,
    /// The time, and that at which the state was computed by the closed form.
    pub(super) s: f64,
    settled: f64,
    /// Windows since then.
    windows: f64,
    /// The energy of each mode, and a bound of its speed.
    energies: Vec<(f64, f64)>,
    faint: Vec<f64>,
}

/// The state is computed anew after so many windows.
const WINDOWS: f64 = 32.0;

impl Track {
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
        (self.s, self.settled, self.windows) = (modes.s, modes.s, 0.0);
    }

    /// The energies of all modes here, $`\sqrt{\dot y^2 + k(y - q/k)^2}`$, which bound their speeds; those of modes far beyond
    /// critical damping are much lower.
    pub(super) fn energies(&mut self, flight: &MachineFlight) {
        self.energies.clear();
        self.energies.extend(flight.structure.modes.iter().zip(self.z.chunks_exact(3)).map(|(mode, z)| {
            if mode.k <= 0.0 {
                return (z[1].abs(), z[1].abs());
            }
            // the energy about the equilibrium under the constant force
            let shifted = z[0] - z[2] / mode.k;
            let energy = (z[1] * z[1] + mode.k * shifted * shifted).sqrt();
            let decaying = || z[1].abs() + mode.k * mode.largest_response() * shifted.abs();
            (energy, if mode.decays.is_some() { decaying() } else { energy })
        }));
    }

    /// The polynomial of a guard over a time `length` from a state of the closed form, with a window of the structure; the
    /// energies are those here. From a fast decay that is faint its lower bound is taken, $`-|F|(\lambda t)^n/n!`$ where the first $`n`$
    /// derivatives of the guard are zero.
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
        p[0] = if known > 0 { 0.0 } else { value };
        p[ORDER] = series.bounds(&self.energies, &self.z, 0.0, 0.0).0;
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
            let mut term = surface.size * crate::system::decay(surface.rate * self.s).0;
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

    /// The length of the longest window from these modes on in which only fast decays are faint and all guards are positive, also
    /// guards that are zero here and those of stops with a surface that recovers.
    pub(super) fn long_window(&mut self, flight: &MachineFlight, modes: &Modes, until: f64) -> Option<f64> {
        self.settle(flight, modes);
        self.energies(flight);
        let positive = |window: &&Window| {
            let mut guards = flight.guards.iter().enumerate();
            guards.all(|(g, guard)| {
                // only the beginning lies on a guard; later its derivatives are not known to vanish
                let known = if modes.s == 0.0 { guard.known } else { 0 };
                self.polynomial(flight, g, window, window.length, known, modes).is_positive()
            })
        };
        let useful = |window: &&Window| window.leaves_out_decays() && window.length <= until;
        // windows are sorted from short to long: the last that is positive is the longest
        flight.structure.windows().iter().rev().filter(useful).find(positive).map(|window| window.length)
    }

    /// What the constant terms of a guard are here, lowered by its surface and by faint modes, and bounds of its remainder and
    /// of its rounding errors.
    fn constant(&self, flight: &MachineFlight, window: &Window, g: usize) -> (f64, f64, f64) {
        let (series, start) = (&window.guards[g], &flight.guards[g]);
        // a surface that stands back only adds to the gap
        let surface = start.recovery.map_or(0.0, |surface| surface.size);
        let faint: f64 = if window.faint.is_empty() { 0.0 } else { series.lowered(&self.faint) };
        // rounding errors have grown with each window since the state was computed by the closed form
        let (remainder, rounding) = series.bounds(&self.energies, &self.z, self.windows, self.s - self.settled);
        let error = rounding + 8.0 * f64::EPSILON * (start.size + start.constant.abs() + surface);
        (start.constant - surface - faint, remainder, error)
    }

    /// Whether all guards are positive in the whole window, by their hulls.
    fn clear(&mut self, flight: &MachineFlight, window: &Window) -> bool {
        self.faint.clear();
        self.faint.extend(window.faint.iter().map(|faint| faint.energy(&self.z)));
        window.guards.iter().enumerate().all(|(g, series)| {
            let (constant, remainder, error) = self.constant(flight, window, g);
            series.lowest(&self.z, constant - error, remainder) > 0.0
        })
    }

    /// The polynomials of all guards over a part of the shortest window from here.
    fn expand(&self, flight: &MachineFlight, window: &Window, part: f64, all: &mut Vec<GuardPolynomial>) {
        all.clear();
        for (g, (series, start)) in window.guards.iter().zip(&flight.guards).enumerate() {
            let mut p = series.at(&self.z);
            let (constant, remainder, bound) = self.constant(flight, window, g);
            let mut known = 0;
            let (mut error, mut size) = (0.0, 0.0);
            // exactly zero, as in `polynomial`
            if self.s == 0.0 && start.known > 0 {
                known = start.known;
                p[0] = 0.0;
                size = series.size(&self.z, 1).max(series.size(&self.z, 2)) * part;
            } else {
                p[0] += constant;
                error = bound;
            }
            p[ORDER] = remainder;
            // the powers of a part of the window; the remainder, in the last place, shrinks with them
            if part < 1.0 {
                let mut power = part;
                for c in &mut p[1..] {
                    *c *= power;
                    power *= part;
                }
            }
            all.push(GuardPolynomial::new(p, known, error, size));
        }
    }

    /// A zero of a guard near a part `t` of a window from here, by the series of all powers, and the second derivative there,
    /// both in time.
    pub(super) fn sharp(&self, flight: &MachineFlight, window: &Window, g: usize, t: f64) -> (f64, f64) {
        let mut c: [f64; ALL] = window.guards[g].all(&self.z);
        let start = &flight.guards[g];
        c[0] = if self.s == 0.0 && start.known > 0 { 0.0 } else { c[0] + start.constant };
        let (mut t, mut bend) = (t, 0.0);
        // Newton's method; one pass of Horner's scheme gives value, slope and half the second derivative
        for _ in 0..6 {
            let (mut value, mut slope) = (0.0, 0.0);
            bend = 0.0;
            for c in c.iter().rev() {
                bend = bend * t + slope;
                slope = slope * t + value;
                value = value * t + c;
            }
            let step = value / slope;
            t -= step;
            // the method is quadratic: the next step would be below rounding
            if step.abs() < 1e-8 || step.is_nan() {
                break;
            }
        }
        (self.s + t * window.length, 2.0 * bend.abs() / (window.length * window.length))
    }

    /// Goes on to the end of a window.
    pub(super) fn step(&mut self, window: &Window) {
        window.pass(&mut self.z);
        self.s += window.length;
        self.windows += 1.0;
    }

    /// Goes on over windows that are free of zeros, until `until` or up to a window that may have one. Of that, and of its
    /// part before `until`, `all` receives the polynomials; `false` if there is none.
    pub(super) fn pass(
        &mut self,
        flight: &MachineFlight,
        until: f64,
        steps: &mut u32,
        all: &mut Vec<GuardPolynomial>,
    ) -> Option<f64> {
        let windows = flight.structure.windows();
        // after a fall to a shorter window, `stay` windows of that length pass before a longer one is tried again
        let (mut level, mut stay) = (0, 0_u32);
        while *steps > 0 && self.s < until && self.windows < WINDOWS {
            // a window longer than what is left would prove more than is asked, and could fail for it
            let left = until - self.s;
            while level > 0 && left < windows[level].length {
                level -= 1;
            }
            let window = &windows[level];
            let part = if left < window.length { left / window.length } else { 1.0 };
            *steps -= 1;
            // bounds of the remainders for this window: the energies here, which forcing has changed
            self.energies(flight);
            // the hull is for whole windows away from guards; at the beginning and at the end the polynomial is needed
            let free = if self.s > 0.0 && part == 1.0 {
                self.clear(flight, window)
            } else {
                self.expand(flight, window, part, all);
                all.iter().all(GuardPolynomial::is_positive)
            };
            if free {
                if part < 1.0 {
                    self.s = until;
                    break;
                }
                self.step(window);
                if stay > 0 {
                    stay -= 1;
                } else if level + 1 < windows.len() {
                    level += 1;
                }
            } else if level > 0 {
                level -= 1;
                stay = 2;
            } else if self.s > 0.0
                && windows.get(1).is_some_and(|next| next.leaves_out_decays() && next.length <= left)
                && self.clear(flight, &windows[1])
            {
                // a fast decay that has passed has no part in the guards, but in the remainder of the shortest window
                self.step(&windows[1]);
                level = 1;
            } else {
                // the hull has failed, so the polynomials are not there yet
                if self.s > 0.0 && part == 1.0 {
                    self.expand(flight, window, part, all);
                }
                return Some(part);
            }
        }
        None
    }
}
