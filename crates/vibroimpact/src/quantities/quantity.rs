//! The quantities by name.

use crate::flight::Extreme;
use crate::system::QuantityKind as Kind;

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

    /// Its name, what it is in words, and its kind.
    const fn entry(self) -> (&'static str, &'static str, Kind) {
        match self {
            Self::ImpactSpeedMax => ("impact_speed_max", "largest impact speed", Kind::Velocity),
            Self::ImpactSpeedMean => ("impact_speed_mean", "mean impact speed", Kind::Velocity),
            Self::ImpactsPerPeriod => ("impacts_per_period", "impacts per forcing period", Kind::Number),
            Self::ImpactRate => ("impact_rate", "impacts per unit of time", Kind::Rate),
            Self::ImpulseMax => ("impulse_max", "largest impulse of an impact", Kind::Impulse),
            Self::ImpulsePerPeriod => ("impulse_per_period", "impulse per forcing period", Kind::Impulse),
            Self::ImpactLossPerPeriod => {
                ("impact_loss_per_period", "energy lost in impacts per forcing period", Kind::Energy)
            }
            Self::ImpactPower => ("impact_power", "power lost in impacts", Kind::Power),
            Self::DampingLossPerPeriod => {
                ("damping_loss_per_period", "energy lost in the damper per forcing period", Kind::Energy)
            }
            Self::DampingPower => ("damping_power", "power lost in the damper", Kind::Power),
            Self::WorkPerPeriod => ("work_per_period", "work of the force per forcing period", Kind::Energy),
            Self::Power => ("power", "power of the force", Kind::Power),
            Self::DisplacementMin => ("displacement_min", "smallest displacement", Kind::Length),
            Self::DisplacementMax => ("displacement_max", "largest displacement", Kind::Length),
            Self::DisplacementAmplitude => ("displacement_amplitude", "displacement amplitude", Kind::Length),
            Self::DisplacementMean => ("displacement_mean", "mean displacement", Kind::Length),
            Self::DisplacementRms => ("displacement_rms", "rms displacement", Kind::Length),
            Self::VelocityMax => ("velocity_max", "largest speed", Kind::Velocity),
            Self::VelocityRms => ("velocity_rms", "rms velocity", Kind::Velocity),
            Self::AccelerationMax => ("acceleration_max", "largest acceleration between impacts", Kind::Acceleration),
            Self::StickingFraction => ("sticking_fraction", "part of the time on a stop", Kind::Number),
            Self::MomentumPerPeriod => (
                "momentum_per_period",
                "impulse of all impacts, contact forces and reactions per forcing period",
                Kind::Impulse,
            ),
            Self::ForceMax => ("force_max", "largest force", Kind::Force),
            Self::ContactFraction => ("contact_fraction", "part of the time in contact", Kind::Number),
            Self::HoldingFraction => ("holding_fraction", "part of the time in which a joint holds", Kind::Number),
            Self::ContactLossPerPeriod => {
                ("contact_loss_per_period", "energy lost in the dampers of stops per forcing period", Kind::Energy)
            }
            Self::ContactPower => ("contact_power", "power lost in the dampers of stops", Kind::Power),
            Self::FrictionLossPerPeriod => {
                ("friction_loss_per_period", "energy lost in friction per forcing period", Kind::Energy)
            }
            Self::FrictionPower => ("friction_power", "power lost in friction", Kind::Power),
            Self::VelocityMean => ("velocity_mean", "mean velocity", Kind::Velocity),
        }
    }

    /// Its name in JSON, CSV and plans.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.entry().0
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
        self.entry().1
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
    pub const fn kind(self) -> Kind {
        self.entry().2
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
