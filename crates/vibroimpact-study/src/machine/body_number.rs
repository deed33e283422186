//! The numbers of a body, by name and in SI units.

use super::Body;
use core::f64::consts::TAU;

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
    /// Mass.
    Mass,
    /// Stiffness.
    Stiffness,
    /// Damping coefficient.
    DampingCoefficient,
    /// Damping ratio.
    DampingRatio,
    /// Amplitude of the force.
    Force,
    /// Frequency of the force.
    Frequency,
    /// Distance of the (first) stop.
    Gap,
    /// Distance of the second stop.
    SecondGap,
    /// Distance of both stops: the stops are symmetric.
    Gaps,
    /// Restitution of both stops.
    Restitutions,
    /// Amplitude of the displacement of the base.
    BaseDisplacement,
    /// Amplitude of the velocity of the base.
    BaseVelocity,
    /// Amplitude of the acceleration of the base.
    BaseAcceleration,
    /// Amplitude of the displacement of the stop.
    StopDisplacement,
    /// Rotating unbalance.
    Unbalance,
    /// Constant force.
    ConstantForce,
    /// Acceleration of gravity.
    Gravity,
}

impl BodyNumber {
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

    /// Its name, what it is, its unit, and its unit in the notation of UDUNITS.
    const fn words(self) -> [&'static str; 4] {
        match self {
            Self::Mass => ["mass_kg", "mass", "kg", "kg"],
            Self::Stiffness => ["stiffness_n_per_m", "stiffness", "N/m", "N m-1"],
            Self::DampingCoefficient => ["damping_ns_per_m", "damping coefficient", "N s/m", "N s m-1"],
            Self::DampingRatio => ["damping_ratio", "damping ratio", "", "1"],
            Self::Force => ["force_n", "force", "N", "N"],
            Self::Frequency => ["frequency_hz", "frequency", "Hz", "Hz"],
            Self::Gap => ["gap_m", "gap", "m", "m"],
            Self::SecondGap => ["second_gap_m", "second gap", "m", "m"],
            Self::Gaps => ["gaps_m", "gap of both stops", "m", "m"],
            Self::Restitutions => ["restitutions", "restitution of both stops", "", "1"],
            Self::BaseDisplacement => ["base_displacement_m", "base displacement", "m", "m"],
            Self::BaseVelocity => ["base_velocity_m_per_s", "base velocity", "m/s", "m s-1"],
            Self::BaseAcceleration => ["base_acceleration_m_per_s2", "base acceleration", "m/s²", "m s-2"],
            Self::StopDisplacement => ["stop_displacement_m", "stop displacement", "m", "m"],
            Self::Unbalance => ["unbalance_kg_m", "rotating unbalance", "kg m", "kg m"],
            Self::ConstantForce => ["constant_force_n", "constant force", "N", "N"],
            Self::Gravity => ["gravity_m_per_s2", "gravity", "m/s²", "m s-2"],
        }
    }

    /// Its name in plans and tables, which ends in its unit.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.words()[0]
    }

    /// The number with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
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
    #[must_use]
    pub const fn udunits(self) -> &'static str {
        self.words()[3]
    }

    /// Whether two of them determine the same number, so that only one of them can vary.
    #[must_use]
    pub fn same_number(self, other: Self) -> bool {
        let group = |number| match number {
            Self::DampingCoefficient | Self::DampingRatio => Self::DampingRatio,
            Self::BaseDisplacement | Self::BaseVelocity | Self::BaseAcceleration => Self::BaseDisplacement,
            other => other,
        };
        // the gap of both stops determines each of them
        let both = |a, b| a == Self::Gaps && matches!(b, Self::Gap | Self::SecondGap);
        group(self) == group(other) || both(self, other) || both(other, self)
    }

    /// Where a body has it; of both stops, where the first has it.
    pub(super) const fn place(self, body: &mut Body) -> &mut Option<f64> {
        match self {
            Self::Mass => &mut body.mass_kg,
            Self::Stiffness => &mut body.stiffness_n_per_m,
            Self::DampingCoefficient => &mut body.damping_ns_per_m,
            Self::DampingRatio => &mut body.damping_ratio,
            Self::Force => &mut body.force_n,
            Self::Frequency => &mut body.frequency_hz,
            Self::Gap | Self::Gaps => &mut body.gap_m,
            Self::SecondGap => &mut body.second_gap_m,
            Self::Restitutions => &mut body.restitution,
            Self::BaseDisplacement => &mut body.base_displacement_m,
            Self::BaseVelocity => &mut body.base_velocity_m_per_s,
            Self::BaseAcceleration => &mut body.base_acceleration_m_per_s2,
            Self::StopDisplacement => &mut body.stop_displacement_m,
            Self::Unbalance => &mut body.unbalance_kg_m,
            Self::ConstantForce => &mut body.constant_force_n,
            Self::Gravity => &mut body.gravity_m_per_s2,
        }
    }

    /// Its value, of a complete body; `None` for a second stop, or for symmetric stops, that the body does not have. A number that is
    /// given has all its digits.
    #[must_use]
    pub fn get(self, body: &Body) -> Option<f64> {
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
