//! Whether a flight ends at all.
//!
//! After a time each guard consists of its steady part, a sum of harmonics of the forcing about a constant, and of a transient
//! whose energy does not grow. So it lies above the smallest value of its steady part less a bound of the transient. If this is
//! positive for every guard, there is no event for ever. A direction without stiffness drifts, and without damping a constant
//! force accelerates it; this must not close a guard.
//!
//! Modes without damping do not decay. If all frequencies of these and of the forcing are commensurable, the flight repeats
//! after their common period, as soon as the other modes have decayed. So one such period without an event means that there is
//! none for ever.

use super::flight::{MachineFlight, Modes};
use super::harmonic_sum::{Harmonic, stays_above};
use super::steady::{Outlook, Steady};
use crate::math::dot;
use crate::regime::{Mode, Normal};

/// Decay times after which a transient is a rounding error of a rounding error: $`e^{-75} = 2^{-108}`$.
const DECAYED: f64 = 75.0;

impl MachineFlight {
    /// Whether no guard becomes zero after the time `s`, for ever. `false` if this is not proven.
    pub(crate) fn never_after(&self, s: f64, normal: &Normal, modes: &mut Modes) -> bool {
        self.at(s, modes);
        let Some(steady) = Steady::of(self, modes) else { return false };
        // a whole period without an event has passed, and all repeats
        if self.has_shown_all(s) {
            return true;
        }
        (0..self.guards.len()).all(|g| self.stays_open(g, &steady, normal))
    }

    /// Whether a guard stays positive for ever.
    fn stays_open(&self, g: usize, steady: &Steady, normal: &Normal) -> bool {
        let (function, start) = (&self.structure.guards[g].function, &self.guards[g]);
        if function.signal.ramp != 0.0 {
            return false;
        }
        let orders = normal.orders.iter();
        let waves = function.signal.turned(&self.turns).zip(orders);
        let mut outlook = Outlook {
            constant: start.value,
            size: start.size,
            harmonics: waves.map(|((cos, sin), order)| Harmonic { order: *order, cos, sin }).collect(),
            ..Outlook::default()
        };
        // at the beginning each cosine is its amplitude: without these, and without the velocities below, the constant
        // is left
        for wave in &outlook.harmonics {
            outlook.constant -= wave.cos;
        }
        // a surface that stands back comes back
        outlook.constant -= start.recovery.map_or(0.0, |surface| surface.size);
        for (factor, v) in function.velocity.iter().zip(&self.v) {
            outlook.constant -= factor * v;
            outlook.size += (factor * v).abs();
        }
        let factors = (&function.position[..], &function.velocity[..]);
        steady.add_to(factors, &self.sizes_of_free(g, normal), &self.structure.rates, &mut outlook);
        let Outlook { mut constant, size, harmonics, transient, mut drift, acceleration } = outlook;
        let swing: f64 = harmonics.iter().map(Harmonic::amplitude).sum();
        let error = 64.0 * f64::EPSILON * (size + swing + transient);
        // nothing changes: a contact that is only touched
        if swing + transient + drift.abs() + acceleration.abs() <= error && constant >= -error {
            return true;
        }
        if drift < 0.0 && acceleration > 0.0 {
            // where it turns
            constant -= 0.5 * drift * drift / acceleration;
            drift = 0.0;
        }
        drift >= 0.0 && acceleration >= 0.0 && stays_above(&harmonics, transient + error - constant)
    }

    /// The sizes of the factors of a guard for modes without stiffness: what their rounding errors are relative to.
    fn sizes_of_free(&self, g: usize, normal: &Normal) -> Vec<f64> {
        let structure = &self.structure;
        let mut sizes = vec![0.0; structure.modes.len()];
        if structure.dense.is_some() || structure.modes.iter().all(|mode| mode.k > 0.0) {
            return sizes;
        }
        let gradient = structure.gradient(normal, &structure.guards[g].function);
        let (by_place, by_rate) = gradient.split_at(normal.n);
        let length = |of: &[f64]| dot(of, of).sqrt();
        for (i, size) in sizes.iter_mut().enumerate().filter(|(i, _)| structure.modes[*i].k == 0.0) {
            let shape: Vec<f64> = structure.x.iter().map(|x| x.position[i]).collect();
            *size = (length(by_place) + structure.fastest() * length(by_rate)) * length(&shape);
        }
        sizes
    }

    /// Whether a flight only repeats after the time `s` what it has shown: the modes with damping and the surfaces of stops have
    /// decayed, and a period of the other modes and of the forcing has passed.
    fn has_shown_all(&self, s: f64) -> bool {
        let modes = &self.structure.modes;
        let of_guards = self.structure.guards.iter().map(|guard| guard.function.signal.ramp);
        let ramps = self.drive.ramp.iter().copied().chain(of_guards).any(|ramp| ramp != 0.0);
        if self.structure.dense.is_some() || ramps || modes.iter().any(|mode| mode.k == 0.0) {
            return false;
        }
        let damped = modes.iter().filter(|mode| mode.d > 0.0).map(Mode::slowest_decay);
        let surfaces = self.guards.iter().filter_map(|guard| guard.recovery).map(|surface| surface.rate);
        let decayed = damped.chain(surfaces).map(|rate| DECAYED / rate).fold(0.0, f64::max);
        // most flights with damping end before, and need no period
        if s < decayed {
            return false;
        }
        let lasting = modes.iter().filter(|mode| mode.d == 0.0).map(|mode| mode.omega);
        let rates = || lasting.clone().chain(self.structure.rates.iter().copied());
        let Some(first) = rates().next() else { return true };
        // in units of the first rate, whose turns are then whole numbers where all rates are commensurable
        crate::system::common_period(rates().map(|rate| rate / first))
            .is_some_and(|periods| s >= (decayed + periods * core::f64::consts::TAU / first) * (1.0 + 1e-9))
    }
}
