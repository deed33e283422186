//! Conversion from physical units to the nondimensional system, and back.
//!
//! $$`x_{st} = \frac{F}{k},\quad \omega_n = \sqrt{k/m},\quad \xi = \frac{x}{x_{st}},\quad \tau = \omega_n t,\quad
//!   \beta = \frac{\omega}{\omega_n},\quad \delta = \frac{d}{x_{st}},\quad \zeta = \frac{c}{2\sqrt{km}}`$$
//!
//! Every length is measured in static deflections $`x_{st}`$. So a force $`F = 0`$ is an error, because there would be
//! no unit of length.

use super::{Oscillator, Side, SystemError};
use crate::math::hypot;
use core::f64::consts::TAU;

/// A forcing frequency in one of two units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Frequency {
    /// Angular frequency $`\omega`$ in rad/s.
    RadPerS(f64),
    /// Frequency $`\omega/2\pi`$ in Hz.
    Hz(f64),
}

impl Frequency {
    /// $`\omega`$ in rad/s.
    #[must_use]
    pub fn rad_per_s(self) -> f64 {
        match self {
            Self::RadPerS(omega) => omega,
            Self::Hz(hertz) => TAU * hertz,
        }
    }
}

/// A viscous damper in one of three forms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// The coefficient $`c`$ in N s/m.
    NsPerM(f64),
    /// The damping ratio $`\zeta = c/(2\sqrt{km})`$.
    Ratio(f64),
    /// The logarithmic decrement of free vibrations, $`\Lambda = 2\pi\zeta/\sqrt{1-\zeta^2}`$: two successive maxima
    /// have the ratio $`e^\Lambda`$. Only dampers below the critical one have it.
    LogDecrement(f64),
}

impl Damping {
    /// The damping ratio of a machine with this mass and stiffness.
    #[must_use]
    pub fn ratio(self, mass_kg: f64, stiffness_n_per_m: f64) -> f64 {
        match self {
            // not the root of the product, which can overflow or underflow although both numbers are valid
            Self::NsPerM(c) => c / (2.0 * (stiffness_n_per_m.sqrt() * mass_kg.sqrt())),
            Self::Ratio(zeta) => zeta,
            // the definition solved for the ratio
            Self::LogDecrement(decrement) => decrement / hypot(TAU, decrement),
        }
    }

    /// The coefficient $`c`$ in N s/m of a machine with this mass and stiffness.
    #[must_use]
    pub fn ns_per_m(self, mass_kg: f64, stiffness_n_per_m: f64) -> f64 {
        match self {
            Self::NsPerM(c) => c,
            _ => 2.0 * self.ratio(mass_kg, stiffness_n_per_m) * (stiffness_n_per_m.sqrt() * mass_kg.sqrt()),
        }
    }

    /// The value in its own form, with the name and unit of that form.
    const fn named(self) -> (&'static str, f64, &'static str) {
        match self {
            Self::NsPerM(c) => ("damping c", c, "N s/m"),
            Self::Ratio(zeta) => ("damping ratio", zeta, ""),
            Self::LogDecrement(decrement) => ("logarithmic decrement", decrement, ""),
        }
    }
}

/// A second stop of a machine, on the side opposite to the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhysicalStop {
    /// Its distance from the rest position in m, negative for preload.
    pub gap_m: f64,
    /// Its restitution in [0, 1].
    pub restitution: f64,
}

/// A machine in physical units: a mass on a spring near a stop, driven by a harmonic force.
///
/// ```
/// use vibroimpact::{Damping, Frequency, PhysicalOscillator};
/// let machine = PhysicalOscillator {
///     mass_kg: 2.0, damping: Damping::NsPerM(0.0), stiffness_n_per_m: 800.0, force_n: 4.0,
///     frequency: Frequency::RadPerS(25.0), gap_m: 0.010, restitution: 0.5, second_stop: None,
/// };
/// let (osc, scales) = machine.nondimensional()?;
/// assert_eq!(osc.beta(), 1.25);                       // 25 rad/s over sqrt(800/2) = 20 rad/s
/// assert_eq!(osc.gap(), 2.0);                         // 10 mm over 4/800 m = 5 mm
/// assert_eq!(scales.length_m, 0.005);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhysicalOscillator {
    /// Mass $`m`$ in kg, positive.
    pub mass_kg: f64,
    /// The damper.
    pub damping: Damping,
    /// Stiffness $`k`$ in N/m, positive.
    pub stiffness_n_per_m: f64,
    /// Force amplitude $`F`$ in N, positive.
    pub force_n: f64,
    /// Forcing frequency.
    pub frequency: Frequency,
    /// Distance $`d`$ of the stop from the rest position in m, negative for preload.
    pub gap_m: f64,
    /// Restitution in [0, 1].
    pub restitution: f64,
    /// A second stop on the other side.
    pub second_stop: Option<PhysicalStop>,
}

/// The nondimensional units in physical units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// One unit of length, $`F/k`$, in m.
    pub length_m: f64,
    /// One unit of time, $`1/\omega_n`$, in s.
    pub time_s: f64,
    /// One unit of mass, the moving mass, in kg.
    pub mass_kg: f64,
}

impl Scales {
    /// One unit of velocity, in m/s.
    #[must_use]
    pub fn velocity_m_per_s(&self) -> f64 {
        self.length_m / self.time_s
    }
}

impl PhysicalOscillator {
    /// The nondimensional oscillator, and the scales for the conversion back.
    ///
    /// # Errors
    /// [`SystemError`] for a mass or stiffness that is not positive, a force of zero (without which there is no unit of
    /// length), a frequency that is not positive, a negative damping, or values whose ratios overflow.
    pub fn nondimensional(&self) -> Result<(Oscillator, Scales), SystemError> {
        let omega = self.frequency.rad_per_s();
        positive("mass m", self.mass_kg, "kg", "the mass moves, so it must weigh something")?;
        positive("stiffness k", self.stiffness_n_per_m, "N/m", "without a spring there is no natural frequency")?;
        positive(
            "force F",
            self.force_n,
            "N",
            "lengths are measured in F/k; a force of 0 leaves no scale, and a sign belongs in the phase",
        )?;
        positive("frequency omega", omega, "rad/s", "give omega in rad/s or the frequency in Hz")?;
        let (name, value, unit) = self.damping.named();
        if !(value >= 0.0 && value.is_finite()) {
            let (range, hint) = ("0 <= value < infinity", "negative damping would feed energy in");
            return Err(SystemError::Quantity { name, value, unit, range, hint });
        }
        let natural = (self.stiffness_n_per_m / self.mass_kg).sqrt();
        let scales =
            Scales { length_m: self.force_n / self.stiffness_n_per_m, time_s: 1.0 / natural, mass_kg: self.mass_kg };
        // quotients of valid numbers can still overflow or underflow
        for (name, value) in [("F/k", scales.length_m), ("omega_n", natural), ("1/omega_n", scales.time_s)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SystemError::Scaling { name, value });
            }
        }
        let zeta = self.damping.ratio(self.mass_kg, self.stiffness_n_per_m);
        let osc =
            Oscillator::new(omega / natural, self.gap_m / scales.length_m, self.restitution)?.with_damping(zeta)?;
        let osc = match self.second_stop {
            Some(stop) => osc.with_second_stop(stop.gap_m / scales.length_m, stop.restitution)?,
            None => osc,
        };
        Ok((osc, scales))
    }

    /// The machine that `osc` describes in the units `scales`.
    ///
    /// # Errors
    /// [`SystemError`] for scales that are not positive and finite.
    pub fn from_nondimensional(osc: &Oscillator, scales: Scales) -> Result<Self, SystemError> {
        let mass_kg = scales.mass_kg;
        positive("mass m", mass_kg, "kg", "the mass moves, so it must weigh something")?;
        positive("unit of length", scales.length_m, "m", "it is F/k")?;
        positive("unit of time", scales.time_s, "s", "it is 1/omega_n")?;
        let natural = 1.0 / scales.time_s;
        let stiffness_n_per_m = mass_kg * natural * natural;
        Ok(Self {
            mass_kg,
            damping: Damping::NsPerM(2.0 * osc.damping() * mass_kg * natural),
            stiffness_n_per_m,
            force_n: stiffness_n_per_m * scales.length_m,
            frequency: Frequency::RadPerS(osc.beta() * natural),
            gap_m: osc.gap() * scales.length_m,
            restitution: osc.restitution(),
            second_stop: osc
                .stop(Side::Lower)
                .map(|stop| PhysicalStop { gap_m: stop.gap * scales.length_m, restitution: stop.restitution }),
        })
    }
}

fn positive(name: &'static str, value: f64, unit: &'static str, hint: &'static str) -> Result<(), SystemError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(SystemError::Quantity { name, value, unit, range: "0 < value < infinity", hint })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MACHINE: PhysicalOscillator = PhysicalOscillator {
        mass_kg: 0.35,
        damping: Damping::NsPerM(1.2),
        stiffness_n_per_m: 5600.0,
        force_n: 17.0,
        frequency: Frequency::Hz(21.0),
        gap_m: 0.0042,
        restitution: 0.6,
        second_stop: Some(PhysicalStop { gap_m: 0.003, restitution: 0.5 }),
    };

    #[test]
    fn there_and_back() {
        let (osc, scales) = MACHINE.nondimensional().unwrap();
        let back = PhysicalOscillator::from_nondimensional(&osc, scales).unwrap();
        for (a, b) in [
            (back.stiffness_n_per_m, MACHINE.stiffness_n_per_m),
            (back.damping.ns_per_m(1.0, 1.0), 1.2),
            (back.second_stop.unwrap().gap_m, 0.003),
            (back.force_n, MACHINE.force_n),
            (back.frequency.rad_per_s(), MACHINE.frequency.rad_per_s()),
            (back.gap_m, MACHINE.gap_m),
        ] {
            assert!((a / b - 1.0).abs() < 1e-14, "{a} {b}");
        }
    }

    #[test]
    fn impossible_machines_are_named() {
        let no_force = PhysicalOscillator { force_n: 0.0, ..MACHINE }.nondimensional().unwrap_err();
        assert!(no_force.to_string().contains("force F = 0 N"), "{no_force}");
        for bad in [
            PhysicalOscillator { mass_kg: 0.0, ..MACHINE },
            PhysicalOscillator { stiffness_n_per_m: -1.0, ..MACHINE },
            PhysicalOscillator { frequency: Frequency::Hz(f64::NAN), ..MACHINE },
            PhysicalOscillator { damping: Damping::NsPerM(-0.1), ..MACHINE },
            PhysicalOscillator { force_n: 1e-300, stiffness_n_per_m: 1e300, ..MACHINE },
            PhysicalOscillator { gap_m: f64::INFINITY, ..MACHINE },
        ] {
            assert!(bad.nondimensional().is_err());
        }
    }
}
