//! A machine in SI units, as it is written in plans.

use crate::PlanError;
use core::f64::consts::TAU;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use vibroimpact::{
    Amplitude, Damping, DrivenOscillator, Excitation, Frequency, PhysicalOscillator, PhysicalParameter, PhysicalStop,
    Shaking,
};

/// A machine in SI units: a mass on a spring and a damper, one or two stops, and what drives it. What varies on an axis
/// need not be given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PhysicalPlan {
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
    /// Amplitude of the force in N; 0 when absent, if something else drives the machine.
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
    #[serde(skip_serializing_if = "is_zero")]
    pub base_phase: f64,
    /// Whether the stops are fixed in space and do not move with the base.
    #[serde(skip_serializing_if = "core::ops::Not::not")]
    pub stop_in_space: bool,
    /// Amplitude of the displacement of the stops in m, of a base at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stop_displacement_m: Option<f64>,
    /// Phase of the stops relative to the force, in radians.
    #[serde(skip_serializing_if = "is_zero")]
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

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl PhysicalPlan {
    /// Gives a number this value, in whichever form it was given before; `None` removes it.
    pub fn set(&mut self, parameter: PhysicalParameter, value: impl Into<Option<f64>>) {
        let value = value.into();
        match parameter {
            PhysicalParameter::Mass => self.mass_kg = value,
            PhysicalParameter::Stiffness => self.stiffness_n_per_m = value,
            PhysicalParameter::DampingCoefficient => {
                (self.damping_ns_per_m, self.damping_ratio, self.log_decrement) = (value, None, None);
            }
            PhysicalParameter::DampingRatio => {
                (self.damping_ns_per_m, self.damping_ratio, self.log_decrement) = (None, value, None);
            }
            PhysicalParameter::Force => self.force_n = value,
            PhysicalParameter::Frequency => (self.frequency_hz, self.omega_rad_per_s) = (value, None),
            PhysicalParameter::Gap => self.gap_m = value,
            PhysicalParameter::SecondGap => self.second_gap_m = value,
            PhysicalParameter::Gaps => (self.gap_m, self.second_gap_m) = (value, value),
            PhysicalParameter::Restitutions => {
                (self.restitution, self.second_restitution) = (value, self.second_gap_m.and(value));
            }
            PhysicalParameter::BaseDisplacement => self.set_base([value, None, None]),
            PhysicalParameter::BaseVelocity => self.set_base([None, value, None]),
            PhysicalParameter::BaseAcceleration => self.set_base([None, None, value]),
            PhysicalParameter::StopDisplacement => self.stop_displacement_m = value,
            PhysicalParameter::Unbalance => self.unbalance_kg_m = value,
            PhysicalParameter::ConstantForce => self.constant_force_n = value,
            PhysicalParameter::Gravity => self.gravity_m_per_s2 = value,
            // a parameter of a later version of the core cannot be written in a plan of this one
            _ => {}
        }
    }

    const fn set_base(&mut self, [displacement, velocity, acceleration]: [Option<f64>; 3]) {
        self.base_displacement_m = displacement;
        self.base_velocity_m_per_s = velocity;
        self.base_acceleration_m_per_s2 = acceleration;
    }

    /// Whether something besides a force drives the machine.
    #[must_use]
    pub const fn is_shaken(&self) -> bool {
        self.base_displacement_m.is_some()
            || self.base_velocity_m_per_s.is_some()
            || self.base_acceleration_m_per_s2.is_some()
            || self.stop_displacement_m.is_some()
            || self.unbalance_kg_m.is_some()
    }

    /// The machine.
    ///
    /// # Errors
    /// [`PlanError::Missing`] names all numbers that are absent; [`PlanError::PhysicalTwice`] names two forms of one
    /// number, and [`PlanError::StopAndBase`] a stop that moves beside a base that does.
    pub fn driven(&self) -> Result<DrivenOscillator, PlanError> {
        let force = self.force_n.or(self.is_shaken().then_some(0.0));
        let frequency = self.frequency_hz.or(self.omega_rad_per_s);
        let needed = [
            ("mass_kg", self.mass_kg),
            ("stiffness_n_per_m", self.stiffness_n_per_m),
            ("force_n", force),
            ("frequency_hz", frequency),
            ("gap_m", self.gap_m),
            ("restitution", self.restitution),
        ];
        let [Some(mass_kg), Some(stiffness_n_per_m), Some(force_n), Some(_), Some(gap_m), Some(restitution)] =
            needed.map(|(_, value)| value)
        else {
            return Err(PlanError::Missing(
                needed.iter().filter(|(_, v)| v.is_none()).map(|(name, _)| *name).collect(),
            ));
        };
        let machine = PhysicalOscillator {
            mass_kg,
            stiffness_n_per_m,
            damping: self.damping()?,
            force_n,
            frequency: one_of([
                ("frequency_hz", self.frequency_hz.map(Frequency::Hz)),
                ("omega_rad_per_s", self.omega_rad_per_s.map(Frequency::RadPerS)),
                ("", None),
            ])?
            .unwrap_or(Frequency::Hz(f64::NAN)),
            gap_m,
            restitution,
            second_stop: match (self.second_gap_m, self.second_restitution) {
                (Some(gap_m), own) => Some(PhysicalStop { gap_m, restitution: own.unwrap_or(restitution) }),
                (None, Some(_)) => return Err(PlanError::Missing(vec!["second_gap_m"])),
                (None, None) => None,
            },
        };
        Ok(DrivenOscillator { machine, excitation: self.excitation()? })
    }

    fn damping(&self) -> Result<Damping, PlanError> {
        let forms = [
            ("damping_ns_per_m", self.damping_ns_per_m.map(Damping::NsPerM)),
            ("damping_ratio", self.damping_ratio.map(Damping::Ratio)),
            ("log_decrement", self.log_decrement.map(Damping::LogDecrement)),
        ];
        Ok(one_of(forms)?.unwrap_or(Damping::NsPerM(0.0)))
    }

    fn excitation(&self) -> Result<Excitation, PlanError> {
        let amplitude = one_of([
            ("base_displacement_m", self.base_displacement_m.map(Amplitude::DisplacementM)),
            ("base_velocity_m_per_s", self.base_velocity_m_per_s.map(Amplitude::VelocityMPerS)),
            ("base_acceleration_m_per_s2", self.base_acceleration_m_per_s2.map(Amplitude::AccelerationMPerS2)),
        ])?;
        if self.stop_displacement_m.is_some() && (amplitude.is_some() || self.stop_in_space) {
            return Err(PlanError::StopAndBase);
        }
        let base = amplitude.map_or_else(Shaking::default, |amplitude| Shaking { amplitude, phase: self.base_phase });
        let stop = match self.stop_displacement_m {
            Some(y) => Shaking { amplitude: Amplitude::DisplacementM(y), phase: self.stop_phase },
            None if self.stop_in_space => Shaking::default(),
            None => base,
        };
        Ok(Excitation {
            base,
            stop,
            unbalance_kg_m: self.unbalance_kg_m.unwrap_or(0.0),
            constant_force_n: self.constant_force_n.unwrap_or(0.0),
            gravity_m_per_s2: self.gravity_m_per_s2.unwrap_or(0.0),
        })
    }
}

/// The form in which a number is given, if any.
///
/// # Errors
/// [`PlanError::PhysicalTwice`] if there are two.
fn one_of<T>(forms: [(&'static str, Option<T>); 3]) -> Result<Option<T>, PlanError> {
    let mut given: Option<(&'static str, T)> = None;
    for (name, form) in forms {
        let Some(form) = form else { continue };
        if let Some((other, _)) = given {
            return Err(PlanError::PhysicalTwice(other, name));
        }
        given = Some((name, form));
    }
    Ok(given.map(|(_, form)| form))
}

impl From<&DrivenOscillator> for PhysicalPlan {
    fn from(DrivenOscillator { machine, excitation }: &DrivenOscillator) -> Self {
        let mut plan = Self {
            mass_kg: Some(machine.mass_kg),
            stiffness_n_per_m: Some(machine.stiffness_n_per_m),
            force_n: Some(machine.force_n),
            gap_m: Some(machine.gap_m),
            restitution: Some(machine.restitution),
            second_gap_m: machine.second_stop.map(|stop| stop.gap_m),
            second_restitution: machine.second_stop.map(|stop| stop.restitution),
            ..Self::default()
        };
        match machine.damping {
            Damping::NsPerM(c) => plan.damping_ns_per_m = Some(c),
            Damping::Ratio(zeta) => plan.damping_ratio = Some(zeta),
            Damping::LogDecrement(decrement) => plan.log_decrement = Some(decrement),
        }
        match machine.frequency {
            Frequency::Hz(hertz) => plan.frequency_hz = Some(hertz),
            Frequency::RadPerS(omega) => plan.omega_rad_per_s = Some(omega),
        }
        let given = |value: f64| Some(value).filter(|value| *value != 0.0);
        let Excitation { base, stop, unbalance_kg_m, constant_force_n, gravity_m_per_s2 } = *excitation;
        if base != Shaking::default() {
            match base.amplitude {
                Amplitude::DisplacementM(y) => plan.base_displacement_m = Some(y),
                Amplitude::VelocityMPerS(v) => plan.base_velocity_m_per_s = Some(v),
                Amplitude::AccelerationMPerS2(a) => plan.base_acceleration_m_per_s2 = Some(a),
            }
            plan.base_phase = base.phase;
            plan.stop_in_space = stop != base;
        } else if stop != base {
            plan.stop_displacement_m = Some(stop.amplitude.displacement_m(TAU));
            plan.stop_phase = stop.phase;
        }
        plan.unbalance_kg_m = given(unbalance_kg_m);
        plan.constant_force_n = given(constant_force_n);
        plan.gravity_m_per_s2 = given(gravity_m_per_s2);
        plan
    }
}

/// In a plan a machine is written as a [`PhysicalPlan`].
pub(crate) fn serialize<S: Serializer>(machine: &Option<DrivenOscillator>, to: S) -> Result<S::Ok, S::Error> {
    machine.as_ref().map(PhysicalPlan::from).serialize(to)
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<DrivenOscillator>, D::Error> {
    let plan = Option::<PhysicalPlan>::deserialize(from)?;
    plan.map(|plan| plan.driven().map_err(serde::de::Error::custom)).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A machine with each number in each of its forms is read from its text as it was written.
    #[test]
    fn a_machine_survives_its_text() {
        let plain = PhysicalPlan {
            mass_kg: Some(0.8),
            stiffness_n_per_m: Some(12e3),
            force_n: Some(30.0),
            gap_m: Some(1.5e-3),
            restitution: Some(0.65),
            frequency_hz: Some(15.0),
            damping_ratio: Some(0.02),
            ..PhysicalPlan::default()
        };
        let base = PhysicalPlan { base_acceleration_m_per_s2: Some(3.0), base_phase: 0.5, ..plain };
        for plan in [
            plain,
            PhysicalPlan { damping_ratio: None, log_decrement: Some(0.1), second_gap_m: Some(0.002), ..plain },
            PhysicalPlan { frequency_hz: None, omega_rad_per_s: Some(90.0), unbalance_kg_m: Some(1e-3), ..plain },
            base,
            PhysicalPlan { stop_in_space: true, constant_force_n: Some(-2.0), gravity_m_per_s2: Some(-9.81), ..base },
            PhysicalPlan { stop_displacement_m: Some(1e-4), stop_phase: 1.0, ..plain },
        ] {
            let driven = plan.driven().unwrap();
            let text = serde_json::to_string(&PhysicalPlan::from(&driven)).unwrap();
            let read: PhysicalPlan = serde_json::from_str(&text).unwrap();
            assert_eq!(read.driven().unwrap(), driven, "{text}");
            let reduced = driven.reduced().unwrap();
            assert_eq!(read.driven().unwrap().reduced().unwrap(), reduced);
        }
        let twice = PhysicalPlan { damping_ns_per_m: Some(1.0), ..plain }.driven().unwrap_err();
        assert_eq!(twice, PlanError::PhysicalTwice("damping_ns_per_m", "damping_ratio"));
        let missing = PhysicalPlan { mass_kg: None, gap_m: None, ..plain }.driven().unwrap_err();
        assert_eq!(missing, PlanError::Missing(vec!["mass_kg", "gap_m"]));
        assert_eq!(PhysicalPlan { stop_displacement_m: Some(1.0), ..base }.driven(), Err(PlanError::StopAndBase));
        // a number that varies replaces each of its forms
        for parameter in PhysicalParameter::ALL {
            let mut plan = PhysicalPlan { second_gap_m: Some(0.002), ..plain };
            plan.set(parameter, 0.25);
            assert_eq!(parameter.get(&plan.driven().unwrap()), Some(0.25), "{}", parameter.name());
        }
    }
}
