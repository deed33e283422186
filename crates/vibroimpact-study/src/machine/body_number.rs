//! The numbers of a body, by name and in SI units.

use super::Body;
use core::f64::consts::TAU;

/// The numbers from one list: where a body has each, its name, what it is, its unit, and its unit in the notation of UDUNITS.
macro_rules! body_numbers {
    ($count:literal; $($(#[$doc:meta])* $number:ident($field:ident, $($word:literal),*),)*) => {
        /// A number of a body, by name and in SI units.
        ///
        /// ```
        /// use vibroimpact_study::{Body, BodyNumber};
        /// let body = Body {
        ///     mass_kg: Some(2.0), stiffness_n_per_m: Some(800.0), damping_ratio: Some(0.02), force_n: Some(4.0),
        ///     omega_rad_per_s: Some(25.0), gap_m: Some(0.010), restitution: Some(0.5), ..Body::default()
        /// };
        /// // twice the force halves the gap in units of F/k, and leaves all else
        /// let mut harder = body;
        /// harder.set(BodyNumber::Force, 8.0);
        /// let osc = harder.reduction()?.oscillator;
        /// assert_eq!((osc.gap(), osc.beta(), osc.damping()), (1.0, 1.25, 0.02));
        /// # Ok::<(), vibroimpact::SystemError>(())
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum BodyNumber {
            $($(#[$doc])* $number,)*
        }

        impl BodyNumber {
            /// All of them.
            pub const ALL: [Self; $count] = [$(Self::$number),*];

            /// Its name, what it is, its unit, and its unit in the notation of UDUNITS.
            const fn words(self) -> [&'static str; 4] {
                match self {
                    $(Self::$number => [$($word),*],)*
                }
            }

            /// Where a body has it; of both stops, where the first has it.
            pub(super) const fn place(self, body: &mut Body) -> &mut Option<f64> {
                match self {
                    $(Self::$number => &mut body.$field,)*
                }
            }
        }
    };
}

body_numbers! { 17;
    /// Mass.
    Mass(mass_kg, "mass_kg", "mass", "kg", "kg"),
    /// Stiffness.
    Stiffness(stiffness_n_per_m, "stiffness_n_per_m", "stiffness", "N/m", "N m-1"),
    /// Damping coefficient.
    DampingCoefficient(damping_ns_per_m, "damping_ns_per_m", "damping coefficient", "N s/m", "N s m-1"),
    /// Damping ratio.
    DampingRatio(damping_ratio, "damping_ratio", "damping ratio", "", "1"),
    /// Amplitude of the force.
    Force(force_n, "force_n", "force", "N", "N"),
    /// Frequency of the force.
    Frequency(frequency_hz, "frequency_hz", "frequency", "Hz", "Hz"),
    /// Distance of the (first) stop.
    Gap(gap_m, "gap_m", "gap", "m", "m"),
    /// Distance of the second stop.
    SecondGap(second_gap_m, "second_gap_m", "second gap", "m", "m"),
    /// Distance of both stops: the stops are symmetric.
    Gaps(gap_m, "gaps_m", "gap of both stops", "m", "m"),
    /// Restitution of both stops.
    Restitutions(restitution, "restitutions", "restitution of both stops", "", "1"),
    /// Amplitude of the displacement of the base.
    BaseDisplacement(base_displacement_m, "base_displacement_m", "base displacement", "m", "m"),
    /// Amplitude of the velocity of the base.
    BaseVelocity(base_velocity_m_per_s, "base_velocity_m_per_s", "base velocity", "m/s", "m s-1"),
    /// Amplitude of the acceleration of the base.
    BaseAcceleration(base_acceleration_m_per_s2, "base_acceleration_m_per_s2", "base acceleration", "m/s²", "m s-2"),
    /// Amplitude of the displacement of the stop.
    StopDisplacement(stop_displacement_m, "stop_displacement_m", "stop displacement", "m", "m"),
    /// Rotating unbalance.
    Unbalance(unbalance_kg_m, "unbalance_kg_m", "rotating unbalance", "kg m", "kg m"),
    /// Constant force.
    ConstantForce(constant_force_n, "constant_force_n", "constant force", "N", "N"),
    /// Acceleration of gravity.
    Gravity(gravity_m_per_s2, "gravity_m_per_s2", "gravity", "m/s²", "m s-2"),
}

impl BodyNumber {
    /// Its name in plans and tables, which ends in its unit.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.words()[0]
    }

    /// The number with this name.
    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|number| number.name() == name)
    }

    /// What it is, in words.
    #[must_use]
    pub const fn description(self) -> &'static str {
        self.words()[1]
    }

    /// Its unit; empty for a pure number.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        self.words()[2]
    }

    /// Its unit in the notation of UDUNITS; `1` for a number.
    pub(crate) const fn udunits(self) -> &'static str {
        self.words()[3]
    }

    /// Whether two of them determine the same number, so that only one of them can vary.
    pub(crate) fn same_number(self, other: Self) -> bool {
        let group = |number| match number {
            Self::DampingCoefficient | Self::DampingRatio => Self::DampingRatio,
            Self::BaseDisplacement | Self::BaseVelocity | Self::BaseAcceleration => Self::BaseDisplacement,
            other => other,
        };
        // the gap of both stops determines each of them
        let both = |a, b| a == Self::Gaps && matches!(b, Self::Gap | Self::SecondGap);
        group(self) == group(other) || both(self, other) || both(other, self)
    }

    /// Its value, of a complete body; `None` for a second stop, or for symmetric stops, that the body does not have. A number that is
    /// given has all its digits.
    pub(crate) fn get(self, body: &Body) -> Option<f64> {
        let given = *self.place(&mut { *body });
        let omega = body.omega();
        Some(match self {
            Self::SecondGap => given?,
            // stops that differ have no such number
            Self::Gaps => given.filter(|gap| body.second_gap_m == Some(*gap))?,
            Self::Restitutions => given.filter(|e| body.second_restitution.is_none_or(|second| second == *e))?,
            Self::DampingCoefficient => body.damping_coefficient(),
            Self::DampingRatio => body.damping_ratio(),
            Self::Frequency => given.unwrap_or(omega / TAU),
            Self::BaseDisplacement => body.base_displacement(),
            Self::BaseVelocity => given.unwrap_or_else(|| body.base_displacement() * omega),
            Self::BaseAcceleration => given.unwrap_or_else(|| body.base_displacement() * omega * omega),
            Self::StopDisplacement => body.stop_displacement(),
            _ => given.unwrap_or(0.0),
        })
    }
}
