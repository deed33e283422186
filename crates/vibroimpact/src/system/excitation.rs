//! What drives a machine besides a force: a moving base, a rotating unbalance, a moving stop, a constant force, gravity.
//!
//! The mass is tied by the spring and the damper to a base that moves as $`y`$, and strikes a stop that moves as
//! $`d + r`$:
//!
//! $$`m\ddot x + c(\dot x - \dot y) + k(x - y) = F\sin\omega t + m_u e\,\omega^2\sin\omega t + F_0 + mg, \qquad
//!   x - r \le d.`$$
//!
//! With $`y = Y\sin(\omega t + \varphi_y)`$ and $`r = R\sin(\omega t + \varphi_r)`$, the distance from the moving stop
//! obeys the equation of the plain machine. For $`z = x - r - x_0`$ with $`x_0 = (F_0 + mg)/k`$,
//!
//! $$`m\ddot z + c\dot z + kz = \operatorname{Im}\,\hat F e^{i\omega t}, \qquad z \le d - x_0,`$$
//! $$`\hat F = F + m_u e\,\omega^2 + (k + i\omega c)\,Y e^{i\varphi_y} - (k - m\omega^2 + i\omega c)\,R e^{i\varphi_r}.`$$
//!
//! The conversion is exact. A stop on the base has $`r = y`$, and then $`\hat F = m\omega^2 Y e^{i\varphi_y}`$.

use super::{PhysicalOscillator, PhysicalStop, SystemError};
use crate::math::{atan2, hypot, sin_cos};

/// The amplitude of a harmonic motion in one of three forms, not negative. The form that is given is held when the
/// frequency changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amplitude {
    /// Of the displacement, in m.
    DisplacementM(f64),
    /// Of the velocity, in m/s.
    VelocityMPerS(f64),
    /// Of the acceleration, in m/s^2.
    AccelerationMPerS2(f64),
}

impl Default for Amplitude {
    fn default() -> Self {
        Self::DisplacementM(0.0)
    }
}

impl Amplitude {
    /// The amplitude of the displacement in m at the angular frequency `omega` in rad/s.
    #[must_use]
    pub fn displacement_m(self, omega: f64) -> f64 {
        match self {
            Self::DisplacementM(y) => y,
            Self::VelocityMPerS(v) => v / omega,
            Self::AccelerationMPerS2(a) => a / (omega * omega),
        }
    }

    /// The value in its own form, and the unit of that form.
    pub(super) const fn value(self) -> (f64, &'static str) {
        match self {
            Self::DisplacementM(y) => (y, "m"),
            Self::VelocityMPerS(v) => (v, "m/s"),
            Self::AccelerationMPerS2(a) => (a, "m/s^2"),
        }
    }
}

/// The motion of a base or a stop, $`A\sin(\omega t + \varphi)`$.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shaking {
    /// The amplitude.
    pub amplitude: Amplitude,
    /// Phase relative to the force, in radians.
    pub phase: f64,
}

/// What acts on a machine besides its force. The default is nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Excitation {
    /// The motion of the base to which the spring and the damper are tied.
    pub base: Shaking,
    /// The motion of the stops; that of the base if they are on the base.
    pub stop: Shaking,
    /// Rotating unbalance $`m_u e`$ in kg m: its force is $`m_u e\,\omega^2\sin\omega t`$.
    pub unbalance_kg_m: f64,
    /// Constant force $`F_0`$ in N, towards the (first) stop if positive, such as a weight hung on the mass by a string.
    pub constant_force_n: f64,
    /// Acceleration of gravity $`g`$ in m/s^2, or its component along the motion, towards the (first) stop if positive.
    /// Its force $`mg`$ follows the mass.
    pub gravity_m_per_s2: f64,
}

/// The machine with a force alone that has the same motions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquivalentOscillator {
    /// The machine. Its positions are those relative to the stop's motion, from the equilibrium under the constant
    /// force.
    pub machine: PhysicalOscillator,
    /// Phase of its force relative to $`\sin\omega t`$: the phase of an event is $`\omega t`$ plus this.
    pub phase: f64,
    /// The position of the equilibrium, $`(F_0 + mg)/k`$ in m: add it to a position, and then the motion of the stop.
    pub offset_m: f64,
}

impl Excitation {
    /// The machine with a force alone that has the same motions. `machine.force_n` is the amplitude of its force
    /// $`F\sin\omega t`$, and may be 0.
    ///
    /// ```
    /// use vibroimpact::{Amplitude, Damping, Excitation, Frequency, PhysicalOscillator, Shaking};
    /// // a base that moves by 1 mm at 20 rad/s, with the stop on it
    /// let machine = PhysicalOscillator {
    ///     mass_kg: 2.0, damping: Damping::NsPerM(3.0), stiffness_n_per_m: 800.0, force_n: 0.0,
    ///     frequency: Frequency::RadPerS(20.0), gap_m: 0.002, restitution: 0.6, second_stop: None,
    /// };
    /// let shaking = Shaking { amplitude: Amplitude::DisplacementM(0.001), phase: 0.0 };
    /// let same = Excitation { base: shaking, stop: shaking, ..Excitation::default() }.equivalent(&machine)?;
    /// assert!((same.machine.force_n - 2.0 * 20.0 * 20.0 * 0.001).abs() < 1e-12 && same.phase.abs() < 1e-12);
    /// # Ok::<(), vibroimpact::SystemError>(())
    /// ```
    ///
    /// # Errors
    /// [`SystemError`] for an amplitude or unbalance that is negative or not finite, a constant force, gravity or phase
    /// that is not finite, or if the sum of all excitations is 0.
    pub fn equivalent(&self, machine: &PhysicalOscillator) -> Result<EquivalentOscillator, SystemError> {
        let (base, stop) = (self.base.amplitude.value(), self.stop.amplitude.value());
        for (name, value, unit) in [
            ("amplitude of the base", base.0, base.1),
            ("amplitude of the stop", stop.0, stop.1),
            ("unbalance", self.unbalance_kg_m, "kg m"),
            ("force F", machine.force_n, "N"),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                let hint = "it is an amplitude; a sign belongs in the phase";
                return Err(SystemError::Quantity { name, value, unit, range: "0 <= value < infinity", hint });
            }
        }
        for (name, value, unit) in [
            ("constant force", self.constant_force_n, "N"),
            ("gravity", self.gravity_m_per_s2, "m/s^2"),
            ("phase of the base", self.base.phase, "rad"),
            ("phase of the stop", self.stop.phase, "rad"),
        ] {
            if !value.is_finite() {
                return Err(SystemError::Quantity { name, value, unit, range: "finite", hint: "it is a plain number" });
            }
        }
        let (m, k) = (machine.mass_kg, machine.stiffness_n_per_m);
        let c = machine.damping.ns_per_m(m, k);
        let omega = machine.frequency.rad_per_s();
        // amplitudes of sine and cosine as one complex number
        let (mut re, mut im) = (machine.force_n + self.unbalance_kg_m * omega * omega, 0.0);
        let mut add = |(a, b): (f64, f64), shaking: &Shaking| {
            let (sin, cos) = sin_cos(shaking.phase);
            // (a + ib) times the turn of the phase
            let displacement_m = shaking.amplitude.displacement_m(omega);
            re += displacement_m * (a * cos - b * sin);
            im += displacement_m * (a * sin + b * cos);
        };
        if self.base == self.stop {
            // the terms of the spring and the damper cancel exactly
            add((m * omega * omega, 0.0), &self.base);
        } else {
            // the base acts through spring and damper; in the frame of the stop its acceleration acts on the mass, and
            // they are pulled back
            add((k, omega * c), &self.base);
            add((m * omega * omega - k, -omega * c), &self.stop);
        }
        let offset_m = (self.constant_force_n + m * self.gravity_m_per_s2) / k;
        // the equilibrium moves towards the first stop and away from the second
        let second_stop = machine.second_stop.map(|stop| PhysicalStop { gap_m: stop.gap_m + offset_m, ..stop });
        let machine =
            PhysicalOscillator { force_n: hypot(re, im), gap_m: machine.gap_m - offset_m, second_stop, ..*machine };
        if machine.force_n == 0.0 {
            return Err(SystemError::Quantity {
                name: "sum of all excitations",
                value: 0.0,
                unit: "N",
                range: "0 < value < infinity",
                hint: "give a force, a moving base, an unbalance or a moving stop",
            });
        }
        Ok(EquivalentOscillator { machine, phase: atan2(im, re), offset_m })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{EventKind, Motion};
    use crate::system::{Damping, Frequency, Start};

    const MACHINE: PhysicalOscillator = PhysicalOscillator {
        mass_kg: 0.7,
        damping: Damping::NsPerM(2.1),
        stiffness_n_per_m: 900.0,
        force_n: 3.0,
        frequency: Frequency::RadPerS(31.0),
        gap_m: 0.004,
        restitution: 0.7,
        second_stop: None,
    };

    /// The physical equations by Runge-Kutta steps of fourth order, with bisection for the impacts: independent of the
    /// conversion and of the closed form. The times and speeds of the first impacts agree.
    #[test]
    fn the_same_impacts_as_the_physical_equations() {
        let shake = |displacement_m, phase| Shaking { amplitude: Amplitude::DisplacementM(displacement_m), phase };
        let none = Excitation::default();
        for (name, force, excitation) in [
            ("force", 3.0, none),
            ("base, stop on it", 0.0, Excitation { base: shake(0.002, 0.4), stop: shake(0.002, 0.4), ..none }),
            ("base, stop in space", 0.0, Excitation { base: shake(0.003, 0.0), ..none }),
            ("moving stop", 3.0, Excitation { stop: shake(0.001, 1.1), ..none }),
            ("unbalance", 0.0, Excitation { unbalance_kg_m: 0.004, ..none }),
            ("constant force", 3.0, Excitation { constant_force_n: -1.3, ..none }),
            ("weight", 3.0, Excitation { gravity_m_per_s2: -9.81 / 5.0, ..none }),
            (
                "all",
                1.0,
                Excitation {
                    base: shake(0.002, 0.3),
                    stop: shake(0.0005, 2.0),
                    unbalance_kg_m: 0.001,
                    constant_force_n: 0.8,
                    gravity_m_per_s2: -0.5,
                },
            ),
        ] {
            let machine = PhysicalOscillator { force_n: force, ..MACHINE };
            let same = excitation.equivalent(&machine).unwrap();
            let (osc, scales) = same.machine.nondimensional().unwrap();
            // at rest in the equilibrium of the moving frame
            let start = Start { x: 0.0_f64.min(osc.gap()), v: 0.0, phase: same.phase };
            let mut own = Vec::new();
            for event in Motion::new(&osc, start).take(12) {
                if let EventKind::Impact { velocity_before, .. } = event.kind {
                    own.push((event.time * scales.time_s, velocity_before * scales.velocity_m_per_s()));
                }
            }
            let expected = physical(&machine, &excitation, start.x * scales.length_m + same.offset_m, own.len());
            assert!(own.len() >= 8, "{name}: {} impacts", own.len());
            for ((t, u), (at, speed)) in own.iter().zip(&expected) {
                assert!((t - at).abs() < 1e-8 && (u - speed).abs() < 1e-7, "{name}: {t} {at}, {u} {speed}");
            }
        }
    }

    /// Times and speeds, relative to the stop, of the first impacts, from the position `z` relative to it, at rest there.
    fn physical(machine: &PhysicalOscillator, excitation: &Excitation, z: f64, count: usize) -> Vec<(f64, f64)> {
        let (m, k) = (machine.mass_kg, machine.stiffness_n_per_m);
        let c = machine.damping.ns_per_m(m, k);
        let w = machine.frequency.rad_per_s();
        let wave = |s: &Shaking, t: f64| {
            let (sin, cos) = (w * t + s.phase).sin_cos();
            let y = s.amplitude.displacement_m(w);
            (y * sin, y * w * cos)
        };
        let rate = |t: f64, (x, v): (f64, f64)| {
            let (y, dy) = wave(&excitation.base, t);
            let force = (machine.force_n + excitation.unbalance_kg_m * w * w) * (w * t).sin();
            (v, excitation.gravity_m_per_s2 + (force + excitation.constant_force_n - c * (v - dy) - k * (x - y)) / m)
        };
        let step = |t: f64, (x, v): (f64, f64), h: f64| {
            let a = rate(t, (x, v));
            let b = rate(t + 0.5 * h, (x + 0.5 * h * a.0, v + 0.5 * h * a.1));
            let d = rate(t + 0.5 * h, (x + 0.5 * h * b.0, v + 0.5 * h * b.1));
            let e = rate(t + h, (x + h * d.0, v + h * d.1));
            (x + h / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * d.0 + e.0), v + h / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * d.1 + e.1))
        };
        let beyond = |t: f64, (x, _): (f64, f64)| x - wave(&excitation.stop, t).0 - machine.gap_m;
        let (r, dr) = wave(&excitation.stop, 0.0);
        let (mut t, mut state, h) = (0.0, (z + r, dr), 2e-5);
        let mut impacts = Vec::new();
        while impacts.len() < count {
            let next = step(t, state, h);
            if beyond(t + h, next) <= 0.0 {
                (t, state) = (t + h, next);
                continue;
            }
            let (mut low, mut high) = (0.0, h);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if beyond(t + middle, step(t, state, middle)) <= 0.0 { low = middle } else { high = middle }
            }
            let (x, v) = step(t, state, low);
            t += low;
            let (_, dr) = wave(&excitation.stop, t);
            impacts.push((t, v - dr));
            state = (x, dr - machine.restitution * (v - dr));
        }
        impacts
    }

    #[test]
    fn nonsense_is_named() {
        let nothing = Excitation::default().equivalent(&PhysicalOscillator { force_n: 0.0, ..MACHINE }).unwrap_err();
        assert!(nothing.to_string().contains("sum of all excitations = 0 N"), "{nothing}");
        let negative = Excitation { unbalance_kg_m: -1.0, ..Excitation::default() }.equivalent(&MACHINE).unwrap_err();
        assert!(negative.to_string().contains("unbalance = -1 kg m"), "{negative}");
    }
}
