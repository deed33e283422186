//! A machine with everything that drives it, and its numbers by name.

use super::{
    Amplitude, Damping, Excitation, Frequency, Oscillator, PhysicalOscillator, PhysicalStop, Scales, Shaking,
    SystemError,
};
use core::f64::consts::TAU;

/// A machine with all that drives it: its force, and a moving base or stop, an unbalance, a constant force, gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivenOscillator {
    /// The machine.
    pub machine: PhysicalOscillator,
    /// What drives it besides the force.
    pub excitation: Excitation,
}

/// The oscillator with the motions of a machine, and how its numbers are converted to those of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduced {
    /// The oscillator.
    pub oscillator: Oscillator,
    /// Its units.
    pub scales: Scales,
    /// Phase of its force relative to $`\sin\omega t`$, in radians: the phase of an event is $`\omega t`$ plus this.
    pub phase: f64,
    /// The position of the equilibrium under the constant force in m, to be added to positions.
    pub offset_m: f64,
}

/// A number of a machine, by name and in SI units.
///
/// ```
/// use vibroimpact::{Damping, DrivenOscillator, Excitation, Frequency, PhysicalOscillator, PhysicalParameter};
/// let machine = PhysicalOscillator {
///     mass_kg: 2.0, damping: Damping::Ratio(0.02), stiffness_n_per_m: 800.0, force_n: 4.0,
///     frequency: Frequency::RadPerS(25.0), gap_m: 0.010, restitution: 0.5, second_stop: None,
/// };
/// let driven = DrivenOscillator { machine, excitation: Excitation::default() };
/// // twice the force halves the gap in units of F/k, and leaves all else
/// let harder = PhysicalParameter::Force.set(&driven, 8.0)?.reduced()?.oscillator;
/// assert_eq!((harder.gap(), harder.beta(), harder.damping()), (1.0, 1.25, 0.02));
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PhysicalParameter {
    /// Mass in kg.
    Mass,
    /// Stiffness in N/m.
    Stiffness,
    /// Damping coefficient in N s/m.
    DampingCoefficient,
    /// Damping ratio.
    DampingRatio,
    /// Amplitude of the force in N.
    Force,
    /// Frequency of the force in Hz.
    Frequency,
    /// Distance of the (first) stop in m.
    Gap,
    /// Distance of the second stop in m.
    SecondGap,
    /// Distance of both stops in m: the stops are symmetric.
    Gaps,
    /// Restitution of both stops.
    Restitutions,
    /// Amplitude of the displacement of the base in m.
    BaseDisplacement,
    /// Amplitude of the velocity of the base in m/s.
    BaseVelocity,
    /// Amplitude of the acceleration of the base in m/s^2.
    BaseAcceleration,
    /// Amplitude of the displacement of the stop in m.
    StopDisplacement,
    /// Rotating unbalance in kg m.
    Unbalance,
    /// Constant force in N.
    ConstantForce,
    /// Acceleration of gravity in m/s^2.
    Gravity,
}

impl DrivenOscillator {
    /// The oscillator with the same motions, and its units.
    ///
    /// # Errors
    /// [`SystemError`] for an invalid number of the machine, or if nothing drives it.
    pub fn reduced(&self) -> Result<Reduced, SystemError> {
        if self.excitation == Excitation::default() {
            let (oscillator, scales) = self.machine.nondimensional()?;
            return Ok(Reduced { oscillator, scales, phase: 0.0, offset_m: 0.0 });
        }
        let same = self.excitation.equivalent(&self.machine)?;
        let (oscillator, scales) = same.machine.nondimensional()?;
        Ok(Reduced { oscillator, scales, phase: same.phase, offset_m: same.offset_m })
    }

    /// Whether the stop moves otherwise than the base. Then the loss in the damper and the work of the equivalent force
    /// are not those of the machine.
    #[must_use]
    pub fn stop_apart(&self) -> bool {
        self.excitation.base != self.excitation.stop
    }

    /// The same with another motion of the base; a stop that is on the base moves with it.
    fn with_base(mut self, amplitude: Amplitude) -> Self {
        let base = Shaking { amplitude, ..self.excitation.base };
        if self.excitation.stop == self.excitation.base {
            self.excitation.stop = base;
        }
        self.excitation.base = base;
        self
    }
}

impl PhysicalParameter {
    /// All of them.
    pub const ALL: [Self; 17] = [
        Self::Mass,
        Self::Stiffness,
        Self::DampingCoefficient,
        Self::DampingRatio,
        Self::Force,
        Self::Frequency,
        Self::Gap,
        Self::SecondGap,
        Self::Gaps,
        Self::Restitutions,
        Self::BaseDisplacement,
        Self::BaseVelocity,
        Self::BaseAcceleration,
        Self::StopDisplacement,
        Self::Unbalance,
        Self::ConstantForce,
        Self::Gravity,
    ];

    /// Its name in plans and tables, which ends in its unit.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mass => "mass_kg",
            Self::Stiffness => "stiffness_n_per_m",
            Self::DampingCoefficient => "damping_ns_per_m",
            Self::DampingRatio => "damping_ratio",
            Self::Force => "force_n",
            Self::Frequency => "frequency_hz",
            Self::Gap => "gap_m",
            Self::SecondGap => "second_gap_m",
            Self::Gaps => "gaps_m",
            Self::Restitutions => "restitutions",
            Self::BaseDisplacement => "base_displacement_m",
            Self::BaseVelocity => "base_velocity_m_per_s",
            Self::BaseAcceleration => "base_acceleration_m_per_s2",
            Self::StopDisplacement => "stop_displacement_m",
            Self::Unbalance => "unbalance_kg_m",
            Self::ConstantForce => "constant_force_n",
            Self::Gravity => "gravity_m_per_s2",
        }
    }

    /// The parameter with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|parameter| parameter.name() == name)
    }

    /// What it is, in words.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::Mass => "mass",
            Self::Stiffness => "stiffness",
            Self::DampingCoefficient => "damping coefficient",
            Self::DampingRatio => "damping ratio",
            Self::Force => "force",
            Self::Frequency => "frequency",
            Self::Gap => "gap",
            Self::SecondGap => "second gap",
            Self::Gaps => "gap of both stops",
            Self::Restitutions => "restitution of both stops",
            Self::BaseDisplacement => "base displacement",
            Self::BaseVelocity => "base velocity",
            Self::BaseAcceleration => "base acceleration",
            Self::StopDisplacement => "stop displacement",
            Self::Unbalance => "rotating unbalance",
            Self::ConstantForce => "constant force",
            Self::Gravity => "gravity",
        }
    }

    /// Its unit; empty for a pure number.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Mass => "kg",
            Self::Stiffness => "N/m",
            Self::DampingCoefficient => "N s/m",
            Self::Force | Self::ConstantForce => "N",
            Self::Frequency => "Hz",
            Self::Gap | Self::SecondGap | Self::Gaps | Self::BaseDisplacement | Self::StopDisplacement => "m",
            Self::BaseVelocity => "m/s",
            Self::BaseAcceleration | Self::Gravity => "m/s²",
            Self::Unbalance => "kg m",
            Self::DampingRatio | Self::Restitutions => "",
        }
    }

    /// Its unit in the notation of UDUNITS; `1` for a number.
    #[must_use]
    pub const fn udunits(self) -> &'static str {
        match self {
            Self::Mass => "kg",
            Self::Stiffness => "N m-1",
            Self::DampingCoefficient => "N s m-1",
            Self::Force | Self::ConstantForce => "N",
            Self::Frequency => "Hz",
            Self::Gap | Self::SecondGap | Self::Gaps | Self::BaseDisplacement | Self::StopDisplacement => "m",
            Self::BaseVelocity => "m s-1",
            Self::BaseAcceleration | Self::Gravity => "m s-2",
            Self::Unbalance => "kg m",
            Self::DampingRatio | Self::Restitutions => "1",
        }
    }

    /// Whether two parameters determine the same number, so that only one of them can vary.
    #[must_use]
    pub fn same_number(self, other: Self) -> bool {
        let group = |parameter| match parameter {
            Self::DampingCoefficient | Self::DampingRatio => Self::DampingRatio,
            Self::BaseDisplacement | Self::BaseVelocity | Self::BaseAcceleration => Self::BaseDisplacement,
            other => other,
        };
        // the gap of both stops determines each of them
        let both = |a, b| a == Self::Gaps && matches!(b, Self::Gap | Self::SecondGap);
        group(self) == group(other) || both(self, other) || both(other, self)
    }

    /// Its value; `None` for a second stop, or for symmetric stops, that the machine does not have.
    #[must_use]
    pub fn get(self, driven: &DrivenOscillator) -> Option<f64> {
        let DrivenOscillator { machine, excitation } = driven;
        let (m, k, omega) = (machine.mass_kg, machine.stiffness_n_per_m, machine.frequency.rad_per_s());
        let base = excitation.base.amplitude;
        Some(match self {
            Self::Mass => m,
            Self::Stiffness => k,
            Self::DampingCoefficient => machine.damping.ns_per_m(m, k),
            Self::DampingRatio => machine.damping.ratio(m, k),
            Self::Force => machine.force_n,
            // in the unit in which it was given, so that no digit changes
            Self::Frequency => match machine.frequency {
                Frequency::Hz(hertz) => hertz,
                Frequency::RadPerS(omega) => omega / TAU,
            },
            Self::Gap => machine.gap_m,
            Self::SecondGap => machine.second_stop?.gap_m,
            // stops that differ have no such number
            Self::Gaps => Some(machine.gap_m).filter(|gap| machine.second_stop.is_some_and(|s| s.gap_m == *gap))?,
            Self::Restitutions => {
                Some(machine.restitution).filter(|e| machine.second_stop.is_none_or(|s| s.restitution == *e))?
            }
            Self::BaseDisplacement => base.displacement_m(omega),
            Self::BaseVelocity => match base {
                // as it was given, so that no digit changes
                Amplitude::VelocityMPerS(v) => v,
                other => other.displacement_m(omega) * omega,
            },
            Self::BaseAcceleration => match base {
                Amplitude::AccelerationMPerS2(a) => a,
                other => other.displacement_m(omega) * omega * omega,
            },
            Self::StopDisplacement => excitation.stop.amplitude.displacement_m(omega),
            Self::Unbalance => excitation.unbalance_kg_m,
            Self::ConstantForce => excitation.constant_force_n,
            Self::Gravity => excitation.gravity_m_per_s2,
        })
    }

    /// The machine with another value of this parameter, and all others as they were given. Ranges are checked by
    /// [`DrivenOscillator::reduced`].
    ///
    /// # Errors
    /// [`SystemError::NoSecondStop`] for a parameter of a second stop if there is only one stop.
    pub fn set(self, driven: &DrivenOscillator, value: f64) -> Result<DrivenOscillator, SystemError> {
        let mut changed = *driven;
        let machine = &mut changed.machine;
        let second = |stop: Option<PhysicalStop>| stop.ok_or(SystemError::NoSecondStop(self.name()));
        match self {
            Self::Mass => machine.mass_kg = value,
            Self::Stiffness => machine.stiffness_n_per_m = value,
            Self::DampingCoefficient => machine.damping = Damping::NsPerM(value),
            Self::DampingRatio => machine.damping = Damping::Ratio(value),
            Self::Force => machine.force_n = value,
            Self::Frequency => machine.frequency = Frequency::Hz(value),
            Self::Gap => machine.gap_m = value,
            Self::SecondGap => {
                machine.second_stop = Some(PhysicalStop { gap_m: value, ..second(machine.second_stop)? });
            }
            Self::Gaps => {
                machine.second_stop = Some(PhysicalStop { gap_m: value, ..second(machine.second_stop)? });
                machine.gap_m = value;
            }
            Self::Restitutions => {
                machine.second_stop = machine.second_stop.map(|stop| PhysicalStop { restitution: value, ..stop });
                machine.restitution = value;
            }
            Self::BaseDisplacement => return Ok(changed.with_base(Amplitude::DisplacementM(value))),
            Self::BaseVelocity => return Ok(changed.with_base(Amplitude::VelocityMPerS(value))),
            Self::BaseAcceleration => return Ok(changed.with_base(Amplitude::AccelerationMPerS2(value))),
            Self::StopDisplacement => changed.excitation.stop.amplitude = Amplitude::DisplacementM(value),
            Self::Unbalance => changed.excitation.unbalance_kg_m = value,
            Self::ConstantForce => changed.excitation.constant_force_n = value,
            Self::Gravity => changed.excitation.gravity_m_per_s2 = value,
        }
        Ok(changed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Parameter;

    const DRIVEN: DrivenOscillator = DrivenOscillator {
        machine: PhysicalOscillator {
            mass_kg: 0.7,
            damping: Damping::NsPerM(2.1),
            stiffness_n_per_m: 900.0,
            force_n: 3.0,
            frequency: Frequency::Hz(5.0),
            gap_m: 0.004,
            restitution: 0.7,
            second_stop: Some(PhysicalStop { gap_m: 0.006, restitution: 0.6 }),
        },
        excitation: Excitation {
            base: Shaking { amplitude: Amplitude::AccelerationMPerS2(1.5), phase: 0.3 },
            stop: Shaking { amplitude: Amplitude::DisplacementM(0.0), phase: 0.0 },
            unbalance_kg_m: 0.002,
            constant_force_n: 0.5,
            gravity_m_per_s2: -0.3,
        },
    };

    #[test]
    fn each_is_set_and_read() {
        for parameter in PhysicalParameter::ALL {
            let changed = parameter.set(&DRIVEN, 0.5).unwrap();
            assert_eq!(parameter.get(&changed), Some(0.5), "{}", parameter.name());
            assert_eq!(PhysicalParameter::from_name(parameter.name()), Some(parameter));
            let alone =
                DrivenOscillator { machine: PhysicalOscillator { second_stop: None, ..DRIVEN.machine }, ..DRIVEN };
            let second = matches!(parameter, PhysicalParameter::SecondGap | PhysicalParameter::Gaps);
            assert_eq!(parameter.set(&alone, 0.5).is_err(), second, "{}", parameter.name());
        }
        assert!(
            PhysicalParameter::Gaps.get(&DRIVEN).is_none() && PhysicalParameter::Restitutions.get(&DRIVEN).is_none()
        );
    }

    /// The powers with which the numbers of the oscillator change, by hand.
    #[test]
    fn what_each_changes() {
        let plain = DrivenOscillator { excitation: Excitation::default(), ..DRIVEN };
        use Parameter::{Beta, Damping, Gap, Restitution, SecondGap, SecondRestitution};
        let all = [Beta, Gap, Restitution, Damping, SecondGap, SecondRestitution];
        let numbers = |osc: &Oscillator| all.map(|parameter| parameter.get(osc).unwrap());
        let of = |driven: &DrivenOscillator| numbers(&driven.reduced().unwrap().oscillator);
        let before = of(&plain);
        for (parameter, powers) in [
            (PhysicalParameter::Mass, [0.5, 0.0, 0.0, -0.5, 0.0, 0.0]),
            (PhysicalParameter::Stiffness, [-0.5, 1.0, 0.0, -0.5, 1.0, 0.0]),
            (PhysicalParameter::Force, [0.0, -1.0, 0.0, 0.0, -1.0, 0.0]),
            (PhysicalParameter::Frequency, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
            (PhysicalParameter::DampingCoefficient, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]),
        ] {
            let value = parameter.get(&plain).unwrap();
            let after = of(&parameter.set(&plain, 1.7 * value).unwrap());
            let rates = plain.line(Parameter::Physical(parameter), None).unwrap().rates(value).unwrap();
            let rate = |of| rates.iter().find(|(own, _)| *own == of).map_or(0.0, |(_, rate)| *rate);
            let rates = all.map(rate);
            for k in 0..6 {
                let expected = before[k] * 1.7_f64.powf(powers[k]);
                assert!((after[k] - expected).abs() < 1e-14 * expected.abs(), "{} {k}", parameter.name());
                let slope = powers[k] * before[k] / value;
                assert!(
                    (rates[k] - slope).abs() <= 1e-9 * slope.abs(),
                    "{} {k}: {} {slope}",
                    parameter.name(),
                    rates[k]
                );
            }
        }
        // a force of an unbalance grows as the square of the frequency, that of a base with given acceleration does not
        let only = |excitation| DrivenOscillator {
            machine: PhysicalOscillator { force_n: 0.0, ..DRIVEN.machine },
            excitation,
        };
        let unbalance = only(Excitation { unbalance_kg_m: 0.002, ..Excitation::default() });
        let on_base =
            only(Excitation { base: DRIVEN.excitation.base, stop: DRIVEN.excitation.base, ..Excitation::default() });
        for (driven, power) in [(unbalance, -2.0), (on_base, 0.0)] {
            let gap = |driven: &DrivenOscillator| driven.reduced().unwrap().oscillator.gap();
            let faster = PhysicalParameter::Frequency.set(&driven, 10.0).unwrap();
            assert!((gap(&faster) / gap(&driven) - 2.0_f64.powf(power)).abs() < 1e-14);
        }
    }

    #[test]
    fn decrement_and_ratio_are_the_same_damper() {
        let zeta = 0.02_f64;
        let decrement = TAU * zeta / (1.0 - zeta * zeta).sqrt();
        assert!((Damping::LogDecrement(decrement).ratio(1.0, 1.0) - zeta).abs() < 1e-17);
        let c = Damping::Ratio(zeta).ns_per_m(0.8, 12_000.0);
        assert!((c - 2.0 * zeta * (0.8_f64 * 12_000.0).sqrt()).abs() < 1e-14);
    }
}
