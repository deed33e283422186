//! Whether a flight ends at all.
//!
//! After a time each mode consists of its steady response, which is known, and of a transient whose energy
//! $`\dot y^2 + ky^2`$ does not grow. So each guard lies above its steady part less bounds of the transients. If this is
//! positive for every guard, there is no event for ever. A mode without stiffness drifts, and without damping a constant force
//! accelerates it; this must not close a guard.
//!
//! Without damping the transients do not decay. If all frequencies are commensurable, the flight repeats after their common
//! period, so one such period without an event means that there is none for ever.

use super::flight::{MachineFlight, Modes};

impl MachineFlight {
    /// Whether no guard becomes zero after the time `s`, for ever. `false` if this is not proven.
    pub(crate) fn never_after(&self, s: f64, modes: &mut Modes) -> bool {
        if self.structure.dense.is_some() {
            return false;
        }
        self.at(s, modes);
        let rates = &self.structure.rates;
        let steady: Option<Vec<Steady>> = (0..self.v.len()).map(|i| self.steady(i, modes)).collect();
        let Some(steady) = steady else { return false };
        if self.repeats_after().is_some_and(|period| s >= period * (1.0 + 1e-9)) {
            return true;
        }
        (0..self.guards.len()).all(|g| {
            let (function, start) = (&self.structure.guards[g].function, &self.guards[g]);
            if function.signal.ramp != 0.0 {
                return false;
            }
            let mut constant = start.value;
            let mut size = start.size;
            let (mut drift, mut acceleration, mut transient) = (0.0, 0.0, 0.0);
            let harmonics: Vec<(f64, f64)> = function.signal.turned(&self.turns).collect();
            let mut waves = harmonics.clone();
            for (a, _) in &harmonics {
                constant -= a;
            }
            for (i, of) in steady.iter().enumerate() {
                let (alpha, beta) = (function.position[i], function.velocity[i]);
                constant += alpha * of.middle - beta * self.v[i];
                size += (alpha * of.middle).abs() + (beta * self.v[i]).abs();
                drift += alpha * of.drift + beta * of.acceleration;
                acceleration += alpha * of.acceleration;
                constant += beta * of.drift;
                transient += (alpha * of.swing).abs() + (beta * of.speed).abs();
                for ((wave, (a, b)), w) in waves.iter_mut().zip(&of.waves).zip(rates) {
                    wave.0 += alpha * a + beta * w * b;
                    wave.1 += alpha * b - beta * w * a;
                }
            }
            let swing: f64 = waves.iter().map(|(a, b)| (a * a + b * b).sqrt()).sum();
            let error = 64.0 * f64::EPSILON * (size + swing + transient);
            // nothing changes: a contact that is only touched
            let constant_for_ever = swing + transient + drift.abs() + acceleration.abs() <= error && constant >= -error;
            drift >= 0.0 && acceleration >= 0.0 && constant - swing - transient > error || constant_for_ever
        })
    }

    /// The time after which a flight without damping repeats.
    fn repeats_after(&self) -> Option<f64> {
        let modes = &self.structure.modes;
        let first = modes.first()?.omega;
        if modes.iter().any(|mode| mode.k == 0.0 || mode.d > 0.0) || self.drive.ramp.iter().any(|ramp| *ramp != 0.0) {
            return None;
        }
        let of = |w: f64| w / first;
        let rates = self.structure.rates.iter().copied().chain(modes.iter().map(|mode| mode.omega));
        let periods = crate::system::common_period(rates.map(of))?;
        Some(periods * core::f64::consts::TAU / first)
    }

    /// The steady response of a mode and the bounds of its transient at the time of `modes`; `None` if it grows.
    fn steady(&self, i: usize, modes: &Modes) -> Option<Steady> {
        let mode = &self.structure.modes[i];
        let push = self.drive.steady[i];
        if self.drive.ramp[i] != 0.0 {
            return None;
        }
        let mut middle = if mode.k > 0.0 { push / mode.k } else { 0.0 };
        let (mut y, mut v) = (modes.moved[i] - middle, modes.v[i]);
        let mut waves = Vec::with_capacity(self.structure.rates.len());
        for (((a, b), w), turned) in self.drive.of(i).iter().zip(&self.structure.rates).zip(&modes.turned) {
            if *a == 0.0 && *b == 0.0 {
                waves.push((0.0, 0.0));
                continue;
            }
            let (c, d) = mode.steady(*w, (*a, *b));
            // near a resonance without damping the response is no bound of anything
            let size = c.abs() + d.abs();
            if size.is_nan() || size >= 1e10 * (a.abs() + b.abs()) / (mode.k + w * w) {
                return None;
            }
            y -= c * turned.cos + d * turned.sin;
            v -= w * (d * turned.cos - c * turned.sin);
            waves.push((c, d));
        }
        let mut drift = 0.0;
        let (swing, speed) = if mode.k > 0.0 {
            let energy = (v * v + mode.k * y * y).sqrt();
            (energy / mode.omega, energy)
        } else if mode.d > 0.0 {
            // it comes within this distance of the motion in which the damper balances the constant force
            (middle, drift) = (y, push / (2.0 * mode.d));
            v -= drift;
            (v.abs() / (2.0 * mode.d), v.abs())
        } else {
            (middle, drift) = (y, v);
            (0.0, 0.0)
        };
        let acceleration = if mode.k == 0.0 && mode.d == 0.0 { push } else { 0.0 };
        Some(Steady { middle, waves, swing, speed, drift, acceleration })
    }
}

/// The steady response of a mode, and bounds of what remains of its transient: of the displacement and the velocity.
struct Steady {
    middle: f64,
    waves: Vec<(f64, f64)>,
    swing: f64,
    speed: f64,
    drift: f64,
    /// Of a free body under a constant force.
    acceleration: f64,
}
