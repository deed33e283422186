//! The quantities by name.

use crate::flight::Extreme;
use crate::system::QuantityKind;

/// A quantity of a motion. For a periodic motion it refers to its smallest period, for chaos to the impacts that were
/// followed. The first ones are those of an oscillator, and a machine or a part of it has many of them; the last ones only parts of a
/// machine have. There the impulses of a compliant stop are the integrals of its force, one for each contact; the work is that of a
/// force, of a stop that moves or of a belt, on the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Quantity {
    /// The largest speed of arrival at a stop.
    ImpactSpeedMax,
    /// The mean speed of arrival; not defined without impacts, or with infinitely many in a chatter.
    ImpactSpeedMean,
    /// Impacts in one forcing period; infinite with a complete chatter.
    ImpactsPerPeriod,
    /// Impacts per unit of time.
    ImpactRate,
    /// The largest impulse of an impact, $`(1+\varepsilon)U`$ times the mass.
    ImpulseMax,
    /// The impulses of all impacts in one forcing period.
    ImpulsePerPeriod,
    /// The energy lost in impacts in one forcing period, $`\sum\tfrac12(1-\varepsilon^2)U^2`$ times the mass.
    ImpactLossPerPeriod,
    /// The power lost in impacts.
    ImpactPower,
    /// The energy lost in the damper in one forcing period.
    DampingLossPerPeriod,
    /// The power lost in the damper.
    DampingPower,
    /// The work of the force in one forcing period. Over a cycle it equals the two losses.
    WorkPerPeriod,
    /// The power of the force.
    Power,
    /// The smallest position.
    DisplacementMin,
    /// The largest position.
    DisplacementMax,
    /// Half the difference of the largest and smallest position.
    DisplacementAmplitude,
    /// The mean position.
    DisplacementMean,
    /// The root of the mean square of the position.
    DisplacementRms,
    /// The largest speed.
    VelocityMax,
    /// The root of the mean square of the velocity.
    VelocityRms,
    /// The largest absolute value of the acceleration between impacts.
    AccelerationMax,
    /// The part of the time in which the mass sticks on a stop.
    StickingFraction,
    /// What a stop takes in momentum in one forcing period: the impulses of impacts, contact force and reaction at rest
    /// together. For a friction joint, the integral of its force.
    MomentumPerPeriod,
    /// The largest force: of a compliant stop, of a stop on which the machine rests, of a joint in absolute value.
    ForceMax,
    /// The part of the time in contact: closed or at rest on a stop.
    ContactFraction,
    /// The part of the time in which a friction joint holds.
    HoldingFraction,
    /// The energy lost in the dampers of compliant stops in one forcing period.
    ContactLossPerPeriod,
    /// The power lost in the dampers of compliant stops.
    ContactPower,
    /// The energy lost by sliding in one forcing period: force times relative velocity.
    FrictionLossPerPeriod,
    /// The power lost by sliding.
    FrictionPower,
    /// The mean velocity of a coordinate: by how much it moves on in a unit of time, and 0 over a cycle where no free
    /// translation moves it.
    VelocityMean,
}

impl Quantity {
    /// Those of an oscillator, in the order of reports.
    pub const ALL: [Self; 21] = [
        Self::ImpactSpeedMax,
        Self::ImpactSpeedMean,
        Self::ImpactsPerPeriod,
        Self::ImpactRate,
        Self::ImpulseMax,
        Self::ImpulsePerPeriod,
        Self::ImpactLossPerPeriod,
        Self::ImpactPower,
        Self::DampingLossPerPeriod,
        Self::DampingPower,
        Self::WorkPerPeriod,
        Self::Power,
        Self::DisplacementMin,
        Self::DisplacementMax,
        Self::DisplacementAmplitude,
        Self::DisplacementMean,
        Self::DisplacementRms,
        Self::VelocityMax,
        Self::VelocityRms,
        Self::AccelerationMax,
        Self::StickingFraction,
    ];

    /// Its name in JSON, CSV and plans.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ImpactSpeedMax => "impact_speed_max",
            Self::ImpactSpeedMean => "impact_speed_mean",
            Self::ImpactsPerPeriod => "impacts_per_period",
            Self::ImpactRate => "impact_rate",
            Self::ImpulseMax => "impulse_max",
            Self::ImpulsePerPeriod => "impulse_per_period",
            Self::ImpactLossPerPeriod => "impact_loss_per_period",
            Self::ImpactPower => "impact_power",
            Self::DampingLossPerPeriod => "damping_loss_per_period",
            Self::DampingPower => "damping_power",
            Self::WorkPerPeriod => "work_per_period",
            Self::Power => "power",
            Self::DisplacementMin => "displacement_min",
            Self::DisplacementMax => "displacement_max",
            Self::DisplacementAmplitude => "displacement_amplitude",
            Self::DisplacementMean => "displacement_mean",
            Self::DisplacementRms => "displacement_rms",
            Self::VelocityMax => "velocity_max",
            Self::VelocityRms => "velocity_rms",
            Self::AccelerationMax => "acceleration_max",
            Self::StickingFraction => "sticking_fraction",
            Self::MomentumPerPeriod => "momentum_per_period",
            Self::ForceMax => "force_max",
            Self::ContactFraction => "contact_fraction",
            Self::HoldingFraction => "holding_fraction",
            Self::ContactLossPerPeriod => "contact_loss_per_period",
            Self::ContactPower => "contact_power",
            Self::FrictionLossPerPeriod => "friction_loss_per_period",
            Self::FrictionPower => "friction_power",
            Self::VelocityMean => "velocity_mean",
        }
    }

    /// The quantity of an oscillator with this name; hyphens and underscores are equal.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let name = name.trim().replace('-', "_");
        Self::ALL.into_iter().find(|quantity| quantity.name() == name)
    }

    /// What it is, in words.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::ImpactSpeedMax => "largest impact speed",
            Self::ImpactSpeedMean => "mean impact speed",
            Self::ImpactsPerPeriod => "impacts per forcing period",
            Self::ImpactRate => "impacts per unit of time",
            Self::ImpulseMax => "largest impulse of an impact",
            Self::ImpulsePerPeriod => "impulse per forcing period",
            Self::ImpactLossPerPeriod => "energy lost in impacts per forcing period",
            Self::ImpactPower => "power lost in impacts",
            Self::DampingLossPerPeriod => "energy lost in the damper per forcing period",
            Self::DampingPower => "power lost in the damper",
            Self::WorkPerPeriod => "work of the force per forcing period",
            Self::Power => "power of the force",
            Self::DisplacementMin => "smallest displacement",
            Self::DisplacementMax => "largest displacement",
            Self::DisplacementAmplitude => "displacement amplitude",
            Self::DisplacementMean => "mean displacement",
            Self::DisplacementRms => "rms displacement",
            Self::VelocityMax => "largest speed",
            Self::VelocityRms => "rms velocity",
            Self::AccelerationMax => "largest acceleration between impacts",
            Self::StickingFraction => "part of the time on a stop",
            Self::MomentumPerPeriod => "impulse of all impacts, contact forces and reactions per forcing period",
            Self::ForceMax => "largest force",
            Self::ContactFraction => "part of the time in contact",
            Self::HoldingFraction => "part of the time in which a joint holds",
            Self::ContactLossPerPeriod => "energy lost in the dampers of stops per forcing period",
            Self::ContactPower => "power lost in the dampers of stops",
            Self::FrictionLossPerPeriod => "energy lost in friction per forcing period",
            Self::FrictionPower => "power lost in friction",
            Self::VelocityMean => "mean velocity",
        }
    }

    /// Whether it is a sum over impacts, or a time on a stop, and needs no integral over the flights.
    #[must_use]
    pub const fn of_impacts(self) -> bool {
        matches!(
            self,
            Self::ImpactSpeedMax
                | Self::ImpactSpeedMean
                | Self::ImpactsPerPeriod
                | Self::ImpactRate
                | Self::ImpulseMax
                | Self::ImpulsePerPeriod
                | Self::ImpactLossPerPeriod
                | Self::ImpactPower
                | Self::StickingFraction
                | Self::ContactFraction
                | Self::HoldingFraction
        )
    }

    /// Whether it depends on where a coordinate is, and not only on how it moves.
    pub(super) const fn of_place(self) -> bool {
        matches!(
            self,
            Self::DisplacementMin
                | Self::DisplacementMax
                | Self::DisplacementAmplitude
                | Self::DisplacementMean
                | Self::DisplacementRms
        )
    }

    /// The extremes of the flights from which it is computed.
    pub(super) const fn extremes(self) -> &'static [Extreme] {
        match self {
            Self::DisplacementMin => &[Extreme::Lowest],
            Self::DisplacementMax => &[Extreme::Highest],
            Self::DisplacementAmplitude => &[Extreme::Lowest, Extreme::Highest],
            Self::VelocityMax => &[Extreme::Speed],
            Self::AccelerationMax => &[Extreme::Acceleration],
            _ => &[],
        }
    }

    /// Whether it is computed from integrals over the flights.
    pub(super) const fn of_integrals(self) -> bool {
        !self.of_impacts() && self.extremes().is_empty()
    }

    /// Its kind, which determines its unit.
    #[must_use]
    pub const fn kind(self) -> QuantityKind {
        match self {
            Self::ImpactSpeedMax
            | Self::ImpactSpeedMean
            | Self::VelocityMax
            | Self::VelocityMean
            | Self::VelocityRms => QuantityKind::Velocity,
            Self::ImpactsPerPeriod | Self::StickingFraction | Self::ContactFraction | Self::HoldingFraction => {
                QuantityKind::Number
            }
            Self::ImpactRate => QuantityKind::Rate,
            Self::ImpulseMax | Self::ImpulsePerPeriod | Self::MomentumPerPeriod => QuantityKind::Impulse,
            Self::ImpactLossPerPeriod
            | Self::ContactLossPerPeriod
            | Self::FrictionLossPerPeriod
            | Self::DampingLossPerPeriod
            | Self::WorkPerPeriod => QuantityKind::Energy,
            Self::ImpactPower | Self::ContactPower | Self::FrictionPower | Self::DampingPower | Self::Power => {
                QuantityKind::Power
            }
            Self::DisplacementMin
            | Self::DisplacementMax
            | Self::DisplacementAmplitude
            | Self::DisplacementMean
            | Self::DisplacementRms => QuantityKind::Length,
            Self::AccelerationMax => QuantityKind::Acceleration,
            Self::ForceMax => QuantityKind::Force,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_name_gives_its_quantity() {
        for quantity in Quantity::ALL {
            assert_eq!(Quantity::from_name(quantity.name()), Some(quantity));
            assert_eq!(Quantity::from_name(&quantity.name().replace('_', "-")), Some(quantity));
        }
        assert_eq!(Quantity::from_name("speed"), None);
    }
}
