//! A body in SI units: a machine of one coordinate by other names, and the oscillator that it is.
//!
//! The mass is tied by the spring and the damper to a base that moves as $`y`$, and strikes a stop that moves as
//! $`d + r`$:
//!
//! $$`m\ddot x + c(\dot x - \dot y) + k(x - y) = F\sin\omega t + m_u e\,\omega^2\sin\omega t + F_0 + mg, \qquad
//!   x - r \le d.`$$
//!
//! With $`y = Y\sin(\omega t + \varphi_y)`$ and $`r = R\sin(\omega t + \varphi_r)`$, the distance $`z = x - r`$ from the moving stop
//! is the coordinate of a machine whose stops stand still,
//!
//! $$`m\ddot z + c\dot z + kz = F_0 + mg + \operatorname{Im}\,\hat F e^{i\omega t}, \qquad z \le d,`$$
//! $$`\hat F = F + m_u e\,\omega^2 + (k + i\omega c)\,Y e^{i\varphi_y} - (k - m\omega^2 + i\omega c)\,R e^{i\varphi_r}.`$$
//!
//! A stop on the base has $`r = y`$, and then $`\hat F = m\omega^2 Y e^{i\varphi_y}`$.

use super::BodyNumber;
use crate::plan_text::is_usual;
use crate::{Parameter, PlanError};
use core::f64::consts::TAU;
use serde::{Deserialize, Deserializer, Serialize};
use vibroimpact::machine::{MachineParts, OneCoordinate, Reduction, RigidStop};
use vibroimpact::math::{hypot, sin_cos};
use vibroimpact::{OscillatorFamily, ParameterPath, ParameterPlane, SystemError};

/// A body in SI units: a mass on a spring and a damper, one or two stops, and what drives it. What varies on an axis
/// need not be given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Body {
    /// Mass in kg, positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Stiffness in N/m, positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_n_per_m: Option<f64>,
    /// Damping coefficient in N s/m; one of the three forms of damping, or none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_ns_per_m: Option<f64>,
    /// Damping ratio.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_ratio: Option<f64>,
    /// Logarithmic decrement of free vibrations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log_decrement: Option<f64>,
    /// Amplitude of the force in N; 0 when absent, if something else drives the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// Frequency of the force in Hz; one of this and `omega_rad_per_s`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Angular frequency of the force in rad/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub omega_rad_per_s: Option<f64>,
    /// Distance of the stop from the rest position in m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap_m: Option<f64>,
    /// Restitution of the stop, 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Distance in m of a second stop on the other side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_gap_m: Option<f64>,
    /// Restitution of the second stop; that of the first when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_restitution: Option<f64>,
    /// Amplitude of the displacement of the base in m; at most one of the three forms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_displacement_m: Option<f64>,
    /// Amplitude of the velocity of the base in m/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_velocity_m_per_s: Option<f64>,
    /// Amplitude of the acceleration of the base in m/s^2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_acceleration_m_per_s2: Option<f64>,
    /// Phase of the base relative to the force, in radians.
    #[serde(skip_serializing_if = "is_usual")]
    pub base_phase: f64,
    /// Whether the stops are fixed in space and do not move with the base.
    #[serde(skip_serializing_if = "core::ops::Not::not")]
    pub stop_in_space: bool,
    /// Amplitude of the displacement of the stops in m, of a base at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop_displacement_m: Option<f64>,
    /// Phase of the stops relative to the force, in radians.
    #[serde(skip_serializing_if = "is_usual")]
    pub stop_phase: f64,
    /// Rotating unbalance in kg m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unbalance_kg_m: Option<f64>,
    /// Constant force in N towards the (first) stop.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub constant_force_n: Option<f64>,
    /// Acceleration of gravity in m/s^2 towards the (first) stop; negative away from it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity_m_per_s2: Option<f64>,
}

/// A motion $`A\sin(\omega t + \varphi)`$: its amplitude in m and its phase.
type Harmonic = (f64, f64);

/// A number for which there is no other way to be wrong.
fn checked(
    (name, value, unit): (&'static str, f64, &'static str),
    is_valid: bool,
    (range, hint): (&'static str, &'static str),
) -> Result<(), SystemError> {
    if is_valid && value.is_finite() { Ok(()) } else { Err(SystemError::Quantity { name, value, unit, range, hint }) }
}

impl Body {
    /// Gives a number this value, in whichever form it was given before; `None` removes it.
    pub fn set(&mut self, number: BodyNumber, value: impl Into<Option<f64>>) {
        let value = value.into();
        match number {
            BodyNumber::DampingCoefficient | BodyNumber::DampingRatio => {
                (self.damping_ns_per_m, self.damping_ratio, self.log_decrement) = (None, None, None);
            }
            BodyNumber::Frequency => self.omega_rad_per_s = None,
            BodyNumber::BaseDisplacement | BodyNumber::BaseVelocity | BodyNumber::BaseAcceleration => {
                (self.base_displacement_m, self.base_velocity_m_per_s) = (None, None);
                self.base_acceleration_m_per_s2 = None;
            }
            BodyNumber::Gaps => self.second_gap_m = value,
            BodyNumber::Restitutions => self.second_restitution = self.second_gap_m.and(value),
            _ => {}
        }
        *number.place(self) = value;
    }

    /// Whether something besides a force drives the body.
    #[must_use]
    pub const fn is_shaken(&self) -> bool {
        self.has_base() || self.stop_displacement_m.is_some() || self.unbalance_kg_m.is_some()
    }

    const fn has_base(&self) -> bool {
        self.base_displacement_m.is_some()
            || self.base_velocity_m_per_s.is_some()
            || self.base_acceleration_m_per_s2.is_some()
    }

    /// Whether only a force acts on the body.
    pub(crate) const fn is_plain(&self) -> bool {
        !self.is_shaken() && self.constant_force_n.is_none() && self.gravity_m_per_s2.is_none()
    }

    /// Whether the stop moves otherwise than the base. Then the loss in the damper and the work of the force in the frame of the
    /// stop are not those of the body.
    #[must_use]
    pub const fn stop_apart(&self) -> bool {
        self.stop_displacement_m.is_some() || self.stop_in_space
    }

    /// The same in the one form in which it is stored.
    pub(crate) fn complete(&self) -> Result<Self, PlanError> {
        let force_n = self.driving_force();
        let needed = [
            ("mass_kg", self.mass_kg),
            ("stiffness_n_per_m", self.stiffness_n_per_m),
            ("force_n", force_n),
            ("frequency_hz", self.frequency_hz.or(self.omega_rad_per_s)),
            ("gap_m", self.gap_m),
            ("restitution", self.restitution),
        ];
        let missing: Vec<_> = needed.iter().filter(|(_, value)| value.is_none()).map(|(name, _)| *name).collect();
        if !missing.is_empty() {
            return Err(PlanError::Missing(missing));
        }
        one_of(&[
            ("damping_ns_per_m", self.damping_ns_per_m),
            ("damping_ratio", self.damping_ratio),
            ("log_decrement", self.log_decrement),
        ])?;
        one_of(&[("frequency_hz", self.frequency_hz), ("omega_rad_per_s", self.omega_rad_per_s)])?;
        if self.second_restitution.is_some() && self.second_gap_m.is_none() {
            return Err(PlanError::Missing(vec!["second_gap_m"]));
        }
        one_of(&[
            ("base_displacement_m", self.base_displacement_m),
            ("base_velocity_m_per_s", self.base_velocity_m_per_s),
            ("base_acceleration_m_per_s2", self.base_acceleration_m_per_s2),
        ])?;
        if self.stop_displacement_m.is_some() && (self.has_base() || self.stop_in_space) {
            return Err(PlanError::StopAndBase);
        }
        Ok(self.stored())
    }

    /// The amplitude of the force; 0 when absent, if something else drives the body.
    fn driving_force(&self) -> Option<f64> {
        self.force_n.or(self.is_shaken().then_some(0.0))
    }

    /// The same in the one form in which it is stored: a force, a damper and the restitution of a second stop are given, and nothing
    /// is that has no effect.
    pub(crate) fn stored(&self) -> Self {
        let moves =
            |amplitude: Option<f64>, phase: f64| amplitude.filter(|amplitude| *amplitude != 0.0 || phase != 0.0);
        let effective = |value: Option<f64>| value.filter(|value| *value != 0.0);
        let mut stored = Self {
            force_n: self.driving_force(),
            damping_ns_per_m: self.damping_ns_per_m.or(self.direct_ratio().is_none().then_some(0.0)),
            second_restitution: self.second_gap_m.and(self.second_restitution.or(self.restitution)),
            base_displacement_m: moves(self.base_displacement_m, self.base_phase),
            stop_displacement_m: moves(self.stop_displacement_m, self.stop_phase),
            unbalance_kg_m: effective(self.unbalance_kg_m),
            constant_force_n: effective(self.constant_force_n),
            gravity_m_per_s2: effective(self.gravity_m_per_s2),
            ..*self
        };
        if !stored.has_base() {
            (stored.base_phase, stored.stop_in_space) = (0.0, false);
        }
        if stored.stop_displacement_m.is_none() {
            stored.stop_phase = 0.0;
        }
        stored
    }

    /// The angular frequency of what drives the body, in rad/s.
    pub(crate) fn omega(&self) -> f64 {
        self.frequency_hz.map(|hertz| TAU * hertz).or(self.omega_rad_per_s).unwrap_or(f64::NAN)
    }

    /// $`\sqrt{km}`$, not as the root of the product, which can overflow or underflow although both numbers are valid.
    fn impedance(&self) -> f64 {
        self.stiffness_n_per_m.unwrap_or(f64::NAN).sqrt() * self.mass_kg.unwrap_or(f64::NAN).sqrt()
    }

    /// The damping ratio where it is not given as a coefficient. Two successive maxima of free vibrations have the ratio
    /// $`e^\Lambda`$, with the logarithmic decrement $`\Lambda = 2\pi\zeta/\sqrt{1-\zeta^2}`$; only dampers below the critical one
    /// have it.
    fn direct_ratio(&self) -> Option<f64> {
        self.damping_ratio.or(self.log_decrement.map(|decrement| decrement / hypot(TAU, decrement)))
    }

    /// The damping ratio.
    pub(crate) fn damping_ratio(&self) -> f64 {
        let by_coefficient = || self.damping_ns_per_m.unwrap_or(0.0) / (2.0 * self.impedance());
        self.direct_ratio().unwrap_or_else(by_coefficient)
    }

    /// The coefficient of the damper in N s/m.
    pub(crate) fn damping_coefficient(&self) -> f64 {
        self.damping_ns_per_m.unwrap_or_else(|| 2.0 * self.direct_ratio().unwrap_or(0.0) * self.impedance())
    }

    /// The motion of the base.
    fn base(&self) -> Harmonic {
        let omega = self.omega();
        let amplitude = (self.base_displacement_m)
            .or(self.base_velocity_m_per_s.map(|v| v / omega))
            .or(self.base_acceleration_m_per_s2.map(|a| a / (omega * omega)));
        amplitude.map_or((0.0, 0.0), |amplitude| (amplitude, self.base_phase))
    }

    /// The amplitude of the displacement of the base, in m.
    #[must_use]
    pub fn base_displacement(&self) -> f64 {
        self.base().0
    }

    /// The motion of the stop; `None` if it is on the base.
    fn stop(&self) -> Option<Harmonic> {
        let own = self.stop_displacement_m.map(|displacement| (displacement, self.stop_phase));
        own.or((self.stop_in_space || !self.has_base()).then_some((0.0, 0.0)))
    }

    /// The amplitude of the displacement of the stop, in m.
    #[must_use]
    pub fn stop_displacement(&self) -> f64 {
        self.stop().unwrap_or_else(|| self.base()).0
    }

    /// The amplitudes of sine and cosine of the force in the frame of the stop.
    fn drive(&self, (m, c, k): (f64, f64, f64)) -> (f64, f64) {
        let omega = self.omega();
        let unbalance = self.unbalance_kg_m.unwrap_or(0.0);
        let (mut re, mut im) = (self.force_n.unwrap_or(0.0) + unbalance * omega * omega, 0.0);
        let mut add = |(a, b): (f64, f64), (displacement, phase): Harmonic| {
            if displacement == 0.0 {
                return;
            }
            let (sin, cos) = sin_cos(phase);
            // (a + ib) times the turn of the phase
            re += displacement * (a * cos - b * sin);
            im += displacement * (a * sin + b * cos);
        };
        match self.stop() {
            // the terms of the spring and the damper cancel exactly
            None => add((m * omega * omega, 0.0), self.base()),
            // the base acts through spring and damper; in the frame of the stop its acceleration acts on the mass, and they are
            // pulled back
            Some(stop) => {
                add((k, omega * c), self.base());
                add((m * omega * omega - k, -omega * c), stop);
            }
        }
        (re, im)
    }

    /// The numbers of the machine that the body is, in the frame of its stop: the coordinate is the distance $`x - r`$ from its
    /// motion. They are not checked.
    pub(crate) fn one_coordinate(&self) -> OneCoordinate {
        let [m, k, gap, e] =
            [self.mass_kg, self.stiffness_n_per_m, self.gap_m, self.restitution].map(|value| value.unwrap_or(f64::NAN));
        let c = self.damping_coefficient();
        let at_rest =
            |direction: f64, gap: f64, restitution: f64| RigidStop { direction, gap, restitution, motion: (0.0, 0.0) };
        let second = |gap| at_rest(-1.0, gap, self.second_restitution.unwrap_or(e));
        OneCoordinate {
            mass: m,
            damping: c,
            stiffness: k,
            constant: self.constant_force_n.unwrap_or(0.0) + m * self.gravity_m_per_s2.unwrap_or(0.0),
            frequency: self.omega(),
            force: self.drive((m, c, k)),
            stops: [Some(at_rest(1.0, gap, e)), self.second_gap_m.map(second)],
        }
    }

    /// The same machine, with the coordinate `x` and the stops `upper` and `lower`.
    #[must_use]
    pub fn parts(&self) -> MachineParts {
        let OneCoordinate { mass, damping, stiffness, constant, frequency, force: (sin, cos), stops } =
            self.one_coordinate();
        let parts = MachineParts::new(["x"])
            .with_mass(0, mass)
            .with_link(&[1.0], stiffness, damping)
            .with_constant(0, constant)
            .with_frequency(frequency)
            .with_force(0, 1, cos, sin);
        let named = ["upper", "lower"].into_iter().zip(stops.into_iter().flatten());
        named.fold(parts, |parts, (name, stop)| {
            parts.with_rigid_stop(name, &[stop.direction], stop.gap, stop.restitution)
        })
    }

    /// The oscillator with the same motions, and its units.
    ///
    /// # Errors
    /// [`SystemError`] names the invalid number, or says that nothing drives the body.
    pub fn reduction(&self) -> Result<Reduction, SystemError> {
        self.check()?;
        let nothing = SystemError::Quantity {
            name: "sum of all excitations",
            value: 0.0,
            unit: "N",
            range: "0 < value < infinity",
            hint: "give a force, a moving base, an unbalance or a moving stop",
        };
        let numbers = self.one_coordinate();
        if numbers.force == (0.0, 0.0) {
            return Err(nothing);
        }
        let reduction = numbers.reduction()?.ok_or(nothing)?;
        // as it is given: its coefficient is rounded
        self.direct_ratio().map_or(Ok(reduction), |zeta| reduction.with_damping(zeta))
    }

    /// Checks all numbers that the oscillator does not have.
    fn check(&self) -> Result<(), SystemError> {
        let plain = self.is_plain();
        let force = ("force F", self.force_n.unwrap_or(0.0), "N");
        if !plain {
            let base = [
                (self.base_displacement_m, "m"),
                (self.base_velocity_m_per_s, "m/s"),
                (self.base_acceleration_m_per_s2, "m/s^2"),
            ];
            let base = base.into_iter().find_map(|(value, unit)| value.map(|value| (value, unit)));
            let (base, unit) = base.unwrap_or((0.0, "m"));
            let stop = (self.stop_displacement_m)
                .map_or(if self.stop_in_space { (0.0, "m") } else { (base, unit) }, |y| (y, "m"));
            for amplitude in [
                ("amplitude of the base", base, unit),
                ("amplitude of the stop", stop.0, stop.1),
                ("unbalance", self.unbalance_kg_m.unwrap_or(0.0), "kg m"),
                force,
            ] {
                let hint = "it is an amplitude; a sign belongs in the phase";
                checked(amplitude, amplitude.1 >= 0.0, ("0 <= value < infinity", hint))?;
            }
            for number in [
                ("constant force", self.constant_force_n.unwrap_or(0.0), "N"),
                ("gravity", self.gravity_m_per_s2.unwrap_or(0.0), "m/s^2"),
                ("phase of the base", self.base_phase, "rad"),
                ("phase of the stop", self.stop_phase, "rad"),
            ] {
                checked(number, true, ("finite", "it is a plain number"))?;
            }
        }
        let positive = "0 < value < infinity";
        let [m, k] = [self.mass_kg, self.stiffness_n_per_m].map(|value| value.unwrap_or(f64::NAN));
        checked(("mass m", m, "kg"), m > 0.0, (positive, "the mass moves, so it must weigh something"))?;
        let spring = "without a spring there is no natural frequency";
        checked(("stiffness k", k, "N/m"), k > 0.0, (positive, spring))?;
        let scale = "lengths are measured in F/k; a force of 0 leaves no scale, and a sign belongs in the phase";
        checked(force, !plain || force.1 > 0.0, (positive, scale))?;
        let omega = self.omega();
        let form = "give omega in rad/s or the frequency in Hz";
        checked(("frequency omega", omega, "rad/s"), omega > 0.0, (positive, form))?;
        let damper = if let Some(zeta) = self.damping_ratio {
            ("damping ratio", zeta, "")
        } else if let Some(decrement) = self.log_decrement {
            ("logarithmic decrement", decrement, "")
        } else {
            ("damping c", self.damping_ns_per_m.unwrap_or(0.0), "N s/m")
        };
        checked(damper, damper.1 >= 0.0, ("0 <= value < infinity", "negative damping would feed energy in"))
    }

    /// The same body with another value of a parameter, of its own or of its oscillator, and all its other numbers.
    ///
    /// # Errors
    /// [`SystemError::NoSecondStop`] for a parameter of a second stop if there is none; for a parameter of the oscillator
    /// that is measured in units of the body, the errors of [`Self::reduction`].
    pub fn with(&self, parameter: Parameter, value: f64) -> Result<Self, SystemError> {
        let of_second = matches!(
            parameter,
            Parameter::SecondGap
                | Parameter::SecondRestitution
                | Parameter::Body(BodyNumber::SecondGap | BodyNumber::Gaps)
        );
        if of_second && self.second_gap_m.is_none() {
            return Err(SystemError::NoSecondStop(parameter.name()));
        }
        let mut changed = *self;
        match parameter {
            Parameter::Body(number) => {
                // a stop that leaves its base keeps the phase
                if number == BodyNumber::StopDisplacement && self.stop().is_none() {
                    changed.stop_phase = self.base_phase;
                }
                changed.set(number, value);
            }
            Parameter::Beta | Parameter::InverseBeta => {
                let time = self.reduction()?.time();
                let omega = if parameter == Parameter::Beta { value / time } else { 1.0 / (value * time) };
                (changed.frequency_hz, changed.omega_rad_per_s) = (None, Some(omega));
            }
            Parameter::Damping => changed.set(BodyNumber::DampingRatio, value),
            // the gaps of the oscillator count from the equilibrium under the constant force
            Parameter::Gap => {
                let of = self.reduction()?;
                changed.gap_m = Some(value * of.length() + of.offset());
            }
            Parameter::SecondGap => {
                let of = self.reduction()?;
                changed.second_gap_m = Some(value * of.length() - of.offset());
            }
            Parameter::Restitution => changed.restitution = Some(value),
            Parameter::SecondRestitution => changed.second_restitution = Some(value),
        }
        Ok(changed)
    }

    /// The value of a parameter, of its own or of its oscillator; `None` if it does not have it.
    pub(crate) fn value(&self, parameter: Parameter) -> Option<f64> {
        match (parameter, parameter.of_oscillator()) {
            (Parameter::Body(number), _) => number.get(self),
            (_, of) => of?.get(&self.reduction().ok()?.oscillator),
        }
    }

    fn known(&self, parameter: Parameter) -> Result<f64, SystemError> {
        self.value(parameter).ok_or(SystemError::NoSecondStop(parameter.name()))
    }

    /// The line along which a parameter varies, and all other numbers of the body do not, but for one that changes by a
    /// rate when the parameter changes by 1. The numbers of the oscillator change together: with the mass, the frequency
    /// ratio and, for a given damping coefficient, the damping ratio.
    pub(crate) fn line(
        self,
        parameter: Parameter,
        also: Option<(Parameter, f64)>,
    ) -> Result<ParameterPath, SystemError> {
        let from = self.known(parameter)?;
        let also = match also {
            Some((other, _)) if parameter.same_number(other) => {
                return Err(SystemError::Together(parameter.name(), other.name()));
            }
            Some((other, rate)) if !rate.is_finite() => return Err(SystemError::Rate { name: other.name(), rate }),
            Some((other, rate)) => Some((other, rate, self.known(other)?)),
            None => None,
        };
        let at = move |[value]: [f64; 1]| {
            let changed = self.with(parameter, value)?;
            let changed = match also {
                Some((other, rate, second)) => changed.with(other, second + rate * (value - from))?,
                None => changed,
            };
            changed.reduction().map(|reduction| reduction.oscillator)
        };
        Ok(OscillatorFamily::new(at, [from]).into())
    }

    /// The plane in which two parameters vary, and all other numbers of the body do not.
    pub(crate) fn plane(self, (first, second): (Parameter, Parameter)) -> Result<ParameterPlane, SystemError> {
        let at = move |[p, q]: [f64; 2]| Ok(self.with(first, p)?.with(second, q)?.reduction()?.oscillator);
        Ok(OscillatorFamily::new(at, [self.known(first)?, self.known(second)?]).into())
    }
}

/// Checks that a number is given in one of its forms at most.
fn one_of(forms: &[(&'static str, Option<f64>)]) -> Result<(), PlanError> {
    let mut given = forms.iter().filter(|(_, value)| value.is_some());
    match (given.next(), given.next()) {
        (Some((first, _)), Some((second, _))) => Err(PlanError::TwoForms(first, second)),
        _ => Ok(()),
    }
}

/// A body of a system is complete.
pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Body>, D::Error> {
    let body = Option::<Body>::deserialize(from)?;
    body.map(|body| body.complete().map_err(serde::de::Error::custom)).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SystemPlan;
    use crate::machine::BodyNumber as B;
    use vibroimpact::machine::Machine;
    use vibroimpact::motion::{EventKind, Motion};
    use vibroimpact::{Oscillator, Start};

    fn plain() -> Body {
        Body {
            mass_kg: Some(0.7),
            damping_ns_per_m: Some(2.1),
            stiffness_n_per_m: Some(900.0),
            force_n: Some(3.0),
            frequency_hz: Some(5.0),
            gap_m: Some(0.004),
            restitution: Some(0.7),
            ..Body::default()
        }
    }

    fn two() -> Body {
        Body { second_gap_m: Some(0.006), second_restitution: Some(0.6), ..plain() }
    }

    fn shaken() -> Body {
        Body {
            base_acceleration_m_per_s2: Some(1.5),
            base_phase: 0.3,
            stop_in_space: true,
            unbalance_kg_m: Some(0.002),
            constant_force_n: Some(0.5),
            gravity_m_per_s2: Some(-0.3),
            ..two()
        }
    }

    /// A body with each number in each of its forms is read from its text as it was written.
    #[test]
    fn a_body_survives_its_text() {
        let base = Body { base_acceleration_m_per_s2: Some(3.0), base_phase: 0.5, ..plain() };
        for body in [
            plain(),
            Body { damping_ns_per_m: None, log_decrement: Some(0.1), second_gap_m: Some(0.002), ..plain() },
            Body { frequency_hz: None, omega_rad_per_s: Some(90.0), unbalance_kg_m: Some(1e-3), ..plain() },
            base,
            Body { stop_in_space: true, constant_force_n: Some(-2.0), gravity_m_per_s2: Some(-9.81), ..base },
            Body { stop_displacement_m: Some(1e-4), stop_phase: 1.0, ..plain() },
        ] {
            let complete = body.complete().unwrap();
            let text = serde_json::to_string(&complete).unwrap();
            let read: Body = serde_json::from_str(&text).unwrap();
            assert_eq!((read, read.complete().unwrap()), (complete, complete), "{text}");
        }
        let twice = Body { damping_ratio: Some(0.1), ..plain() }.complete().unwrap_err();
        assert_eq!(twice, PlanError::TwoForms("damping_ns_per_m", "damping_ratio"));
        let missing = Body { mass_kg: None, gap_m: None, ..plain() }.complete().unwrap_err();
        assert_eq!(missing, PlanError::Missing(vec!["mass_kg", "gap_m"]));
        assert_eq!(Body { stop_displacement_m: Some(1.0), ..base }.complete(), Err(PlanError::StopAndBase));
        // what has no effect is not stored
        let idle = Body { gravity_m_per_s2: Some(0.0), base_displacement_m: Some(0.0), stop_in_space: true, ..plain() };
        assert_eq!(idle.complete().unwrap(), plain());
    }

    /// Beside a stop that moves by itself a base may move, and a stop may leave its base: where the motion begins to vary, nothing
    /// jumps.
    #[test]
    fn a_motion_varies_beside_another() {
        let on_base = Body { base_displacement_m: Some(0.003), base_phase: 0.4, ..plain() };
        let alone = Body { stop_displacement_m: Some(3e-4), stop_phase: 0.7, ..plain() };
        for (body, number) in [(on_base, B::StopDisplacement), (alone, B::BaseDisplacement)] {
            let system = SystemPlan::of_body(&body).unwrap();
            let (parameter, from) = (Parameter::Body(number), number.get(&body).unwrap());
            let (same, other) = (system.with(parameter, from).unwrap(), system.with(parameter, from + 1e-4).unwrap());
            assert!((same.gap - system.gap).abs() < 1e-14 * system.gap, "{} {}", same.gap, system.gap);
            assert!((other.gap - system.gap).abs() > 1e-3 * system.gap, "{} {}", other.gap, system.gap);
        }
    }

    #[test]
    fn each_number_is_set_and_read() {
        for number in B::ALL {
            let changed = shaken().with(Parameter::Body(number), 0.5).unwrap();
            assert_eq!(number.get(&changed), Some(0.5), "{}", number.name());
            assert_eq!(B::from_name(number.name()), Some(number));
            let second = matches!(number, B::SecondGap | B::Gaps);
            assert_eq!(plain().with(Parameter::Body(number), 0.5).is_err(), second, "{}", number.name());
        }
        assert!(B::Gaps.get(&shaken()).is_none() && B::Restitutions.get(&shaken()).is_none());
    }

    #[test]
    fn parameters_of_the_oscillator_are_set_and_read() {
        let body = Body { constant_force_n: Some(0.5), ..two() };
        for parameter in Parameter::ALL {
            let changed = body.with(parameter, 0.45).unwrap();
            assert!((changed.value(parameter).unwrap() - 0.45).abs() < 1e-15, "{}", parameter.name());
            for other in B::ALL.map(Parameter::Body) {
                let moved = changed.value(other) != body.value(other);
                let expected = match parameter {
                    Parameter::Beta | Parameter::InverseBeta => "frequency_hz",
                    Parameter::Gap => "gap_m",
                    Parameter::SecondGap => "second_gap_m",
                    Parameter::Damping => "damping",
                    _ => "",
                };
                assert!(!moved || !expected.is_empty() && other.name().starts_with(expected), "{}", other.name());
            }
        }
        assert_eq!(plain().with(Parameter::SecondGap, 1.0), Err(SystemError::NoSecondStop("second_gap")));
    }

    /// The powers with which the numbers of the oscillator change, by hand.
    #[test]
    fn what_each_changes() {
        use vibroimpact::Parameter as P;
        let all = [P::Beta, P::Gap, P::Restitution, P::Damping, P::SecondGap, P::SecondRestitution];
        let numbers = |osc: &Oscillator| all.map(|parameter| parameter.get(osc).unwrap());
        let of = |body: &Body| numbers(&body.reduction().unwrap().oscillator);
        let before = of(&two());
        for (number, powers) in [
            (B::Mass, [0.5, 0.0, 0.0, -0.5, 0.0, 0.0]),
            (B::Stiffness, [-0.5, 1.0, 0.0, -0.5, 1.0, 0.0]),
            (B::Force, [0.0, -1.0, 0.0, 0.0, -1.0, 0.0]),
            (B::Frequency, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
            (B::DampingCoefficient, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]),
        ] {
            let (value, name) = (number.get(&two()).unwrap(), number.name());
            let after = of(&two().with(Parameter::Body(number), 1.7 * value).unwrap());
            let rates = two().line(Parameter::Body(number), None).unwrap().rates(value).unwrap();
            for (k, parameter) in all.into_iter().enumerate() {
                let expected = before[k] * 1.7_f64.powf(powers[k]);
                assert!((after[k] - expected).abs() < 1e-14 * expected.abs(), "{name} {k}");
                let rate = rates.iter().find(|(own, _)| *own == parameter).map_or(0.0, |(_, rate)| *rate);
                let slope = powers[k] * before[k] / value;
                assert!((rate - slope).abs() <= 1e-9 * slope.abs(), "{name} {k}: {rate} {slope}");
            }
        }
        // a force of an unbalance grows as the square of the frequency, that of a base with given acceleration does not
        let unbalance = Body { force_n: Some(0.0), unbalance_kg_m: Some(0.002), ..plain() };
        let on_base = Body { force_n: Some(0.0), base_acceleration_m_per_s2: Some(1.5), ..plain() };
        for (body, power) in [(unbalance, -2.0), (on_base, 0.0)] {
            let gap = |body: &Body| body.reduction().unwrap().oscillator.gap();
            let faster = body.with(Parameter::Body(B::Frequency), 10.0).unwrap();
            assert!((gap(&faster) / gap(&body) - 2.0_f64.powf(power)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_line_and_a_plane_as_by_hand() {
        let (mass, force) = (Parameter::Body(B::Mass), Parameter::Body(B::Force));
        let plane = plain().plane((mass, force)).unwrap();
        let osc = plane.set(&plain().reduction().unwrap().oscillator, (1.1, 40.0)).unwrap();
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-14 * b.abs();
        assert!(near(osc.beta(), TAU * 5.0 * (1.1_f64 / 900.0).sqrt()) && near(osc.gap(), 0.004 * 900.0 / 40.0));
        let frequency = Parameter::Body(B::Frequency);
        let line = plain().line(frequency, None).unwrap();
        let there = plain().with(frequency, 22.0).unwrap().reduction().unwrap().oscillator;
        assert_eq!(line.set(&osc, 22.0), Ok(there));
    }

    #[test]
    fn decrement_and_ratio_are_the_same_damper() {
        let zeta = 0.02_f64;
        let decrement = TAU * zeta / (1.0 - zeta * zeta).sqrt();
        let by_decrement = Body { damping_ns_per_m: None, log_decrement: Some(decrement), ..plain() };
        assert!((by_decrement.damping_ratio() - zeta).abs() < 1e-17);
        let c = Body { damping_ns_per_m: None, damping_ratio: Some(zeta), ..plain() }.damping_coefficient();
        assert!((c - 2.0 * zeta * (0.7_f64 * 900.0).sqrt()).abs() < 1e-14);
    }

    /// The machine that a body spells is the oscillator of the body, to the rounding of its damper.
    #[test]
    fn a_body_is_a_machine_of_one_coordinate() {
        for body in [plain(), two(), shaken(), Body { damping_ns_per_m: None, damping_ratio: Some(0.02), ..shaken() }] {
            let (of, own) = (Machine::new(body.parts()).unwrap().reduced().unwrap(), body.reduction().unwrap());
            assert!((of.oscillator.damping() - own.oscillator.damping()).abs() < 1e-16);
            assert_eq!(of.with_damping(own.oscillator.damping()), Ok(own));
        }
    }

    #[test]
    fn nonsense_is_named() {
        for (body, words) in [
            (Body { force_n: Some(0.0), ..plain() }, "force F = 0 N"),
            (Body { force_n: Some(0.0), gravity_m_per_s2: Some(1.0), ..plain() }, "sum of all excitations = 0 N"),
            (Body { unbalance_kg_m: Some(-1.0), ..plain() }, "unbalance = -1 kg m"),
            (Body { mass_kg: Some(0.0), ..plain() }, "mass m = 0 kg"),
            (Body { stiffness_n_per_m: Some(-1.0), ..plain() }, "stiffness k = -1 N/m"),
            (Body { frequency_hz: Some(f64::NAN), ..plain() }, "frequency omega = NaN"),
            (Body { damping_ns_per_m: Some(-0.1), ..plain() }, "damping c = -0.1 N s/m"),
            (
                Body { force_n: Some(1e-300), stiffness_n_per_m: Some(1e300), ..plain() },
                "these quantities give F/k = 0",
            ),
            (Body { gap_m: Some(f64::INFINITY), ..plain() }, "gap delta = inf"),
        ] {
            let message = SystemPlan::of_body(&body).unwrap_err().to_string();
            assert!(message.starts_with(words), "{message}");
        }
    }

    /// The physical equations by Runge-Kutta steps of fourth order, with bisection for the impacts: independent of the
    /// conversion and of the closed form. The times and speeds of the first impacts agree.
    #[test]
    fn the_same_impacts_as_the_physical_equations() {
        let plain = Body { frequency_hz: None, omega_rad_per_s: Some(31.0), ..plain() };
        let idle = Body { force_n: Some(0.0), ..plain };
        let base = |displacement| Body { base_displacement_m: Some(displacement), ..idle };
        for (name, body) in [
            ("force", plain),
            ("base, stop on it", Body { base_phase: 0.4, ..base(0.002) }),
            ("base, stop in space", Body { stop_in_space: true, ..base(0.003) }),
            ("moving stop", Body { stop_displacement_m: Some(0.001), stop_phase: 1.1, ..plain }),
            ("unbalance", Body { unbalance_kg_m: Some(0.004), ..idle }),
            ("constant force", Body { constant_force_n: Some(-1.3), ..plain }),
            ("weight", Body { gravity_m_per_s2: Some(-9.81 / 5.0), ..plain }),
            (
                "all",
                Body {
                    force_n: Some(1.0),
                    base_phase: 0.3,
                    stop_displacement_m: Some(0.0005),
                    stop_phase: 2.0,
                    unbalance_kg_m: Some(0.001),
                    constant_force_n: Some(0.8),
                    gravity_m_per_s2: Some(-0.5),
                    ..base(0.002)
                },
            ),
        ] {
            let same = body.reduction().unwrap();
            let (osc, scales) = (same.oscillator, same.scales());
            // at rest in the equilibrium of the moving frame
            let start = Start { x: 0.0_f64.min(osc.gap()), v: 0.0, phase: same.phase() };
            let mut own = Vec::new();
            for event in Motion::new(&osc, start).take(12) {
                if let EventKind::Impact { velocity_before, .. } = event.kind {
                    own.push((event.time * scales.time, velocity_before * scales.velocity()));
                }
            }
            let expected = physical(&body, start.x * scales.length + same.offset(), own.len());
            assert!(own.len() >= 8, "{name}: {} impacts", own.len());
            for ((t, u), (at, speed)) in own.iter().zip(&expected) {
                assert!((t - at).abs() < 1e-8 && (u - speed).abs() < 1e-7, "{name}: {t} {at}, {u} {speed}");
            }
        }
    }

    /// Times and speeds, relative to the stop, of the first impacts, from the position `z` relative to it, at rest there.
    fn physical(body: &Body, z: f64, count: usize) -> Vec<(f64, f64)> {
        let (m, k, c, w) =
            (body.mass_kg.unwrap(), body.stiffness_n_per_m.unwrap(), body.damping_ns_per_m.unwrap(), body.omega());
        let wave = |(y, phase): Harmonic, t: f64| {
            let (sin, cos) = (w * t + phase).sin_cos();
            (y * sin, y * w * cos)
        };
        let (base, stop) = (body.base(), body.stop().unwrap_or(body.base()));
        let constant = body.constant_force_n.unwrap_or(0.0);
        let rate = |t: f64, (x, v): (f64, f64)| {
            let (y, dy) = wave(base, t);
            let force = (body.force_n.unwrap() + body.unbalance_kg_m.unwrap_or(0.0) * w * w) * (w * t).sin();
            (v, body.gravity_m_per_s2.unwrap_or(0.0) + (force + constant - c * (v - dy) - k * (x - y)) / m)
        };
        let step = |t: f64, (x, v): (f64, f64), h: f64| {
            let a = rate(t, (x, v));
            let b = rate(t + 0.5 * h, (x + 0.5 * h * a.0, v + 0.5 * h * a.1));
            let d = rate(t + 0.5 * h, (x + 0.5 * h * b.0, v + 0.5 * h * b.1));
            let e = rate(t + h, (x + h * d.0, v + h * d.1));
            (x + h / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * d.0 + e.0), v + h / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * d.1 + e.1))
        };
        let beyond = |t: f64, (x, _): (f64, f64)| x - wave(stop, t).0 - body.gap_m.unwrap();
        let (r, dr) = wave(stop, 0.0);
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
            let (_, dr) = wave(stop, t);
            impacts.push((t, v - dr));
            state = (x, dr - body.restitution.unwrap() * (v - dr));
        }
        impacts
    }
}
