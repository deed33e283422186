//! The quantities of machines by name, and what each refers to.

use crate::machine::{Machine, MachineError, MachineFault};
use crate::quantities::quantity::Quantity;

/// A quantity of a machine, or of a part of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum MachineQuantity {
    /// One that the oscillator has too. The impulses of a compliant stop are the integrals of its force, one for each
    /// contact; the work is that of a force, of a stop that moves or of a belt, on the machine.
    Common(Quantity),
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

/// What a quantity refers to. Stops, joints and coordinates are counted as in the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum MachinePart {
    /// The whole machine.
    Whole,
    /// The forces of one order.
    Force(u32),
    /// A stop.
    Stop(usize),
    /// A friction joint.
    Joint(usize),
    /// A coordinate.
    Coordinate(usize),
}

use MachineQuantity::{
    Common, ContactFraction, ContactLossPerPeriod, ContactPower, ForceMax, FrictionLossPerPeriod, FrictionPower,
    HoldingFraction, MomentumPerPeriod, VelocityMean,
};

const WHOLE: [MachineQuantity; 13] = [
    Common(Quantity::ImpactSpeedMax),
    Common(Quantity::ImpactsPerPeriod),
    Common(Quantity::ImpactRate),
    Common(Quantity::WorkPerPeriod),
    Common(Quantity::Power),
    Common(Quantity::ImpactLossPerPeriod),
    Common(Quantity::ImpactPower),
    ContactLossPerPeriod,
    ContactPower,
    FrictionLossPerPeriod,
    FrictionPower,
    Common(Quantity::DampingLossPerPeriod),
    Common(Quantity::DampingPower),
];
const STOP: [MachineQuantity; 12] = [
    Common(Quantity::ImpactSpeedMax),
    Common(Quantity::ImpactSpeedMean),
    Common(Quantity::ImpactsPerPeriod),
    Common(Quantity::ImpulseMax),
    Common(Quantity::ImpulsePerPeriod),
    MomentumPerPeriod,
    ForceMax,
    Common(Quantity::StickingFraction),
    ContactFraction,
    Common(Quantity::ImpactLossPerPeriod),
    ContactLossPerPeriod,
    Common(Quantity::WorkPerPeriod),
];
const JOINT: [MachineQuantity; 5] =
    [MomentumPerPeriod, ForceMax, HoldingFraction, FrictionLossPerPeriod, Common(Quantity::WorkPerPeriod)];
const COORDINATE: [MachineQuantity; 9] = [
    Common(Quantity::DisplacementMin),
    Common(Quantity::DisplacementMax),
    Common(Quantity::DisplacementAmplitude),
    Common(Quantity::DisplacementMean),
    Common(Quantity::DisplacementRms),
    Common(Quantity::VelocityMax),
    VelocityMean,
    Common(Quantity::VelocityRms),
    Common(Quantity::AccelerationMax),
];

impl MachineQuantity {
    /// Its name in JSON and in paths. Those of the oscillator have the same names there.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Common(quantity) => quantity.name(),
            MomentumPerPeriod => "momentum_per_period",
            ForceMax => "force_max",
            ContactFraction => "contact_fraction",
            HoldingFraction => "holding_fraction",
            ContactLossPerPeriod => "contact_loss_per_period",
            ContactPower => "contact_power",
            FrictionLossPerPeriod => "friction_loss_per_period",
            FrictionPower => "friction_power",
            VelocityMean => "velocity_mean",
        }
    }

    /// What it is, in words, for the part to which it refers.
    #[must_use]
    pub const fn description(self, of: MachinePart) -> &'static str {
        match (self, of) {
            (Common(Quantity::WorkPerPeriod), MachinePart::Whole) => {
                "work of forces, moving stops and belts per forcing period"
            }
            (Common(Quantity::Power), _) => "power of forces, moving stops and belts",
            (Common(Quantity::WorkPerPeriod), MachinePart::Stop(_)) => "work of a moving stop per forcing period",
            (Common(Quantity::WorkPerPeriod), MachinePart::Joint(_)) => "work of a belt per forcing period",
            (Common(Quantity::ImpactsPerPeriod), _) => "closings of stops per forcing period",
            (Common(Quantity::ImpactRate), _) => "closings of stops per unit of time",
            (Common(Quantity::ImpactSpeedMax), _) => "largest speed of closing",
            (Common(Quantity::ImpactSpeedMean), _) => "mean speed of closing",
            (Common(Quantity::ImpulseMax), _) => "largest impulse of an impact or contact",
            (Common(Quantity::StickingFraction), _) => "part of the time at rest on a stop",
            (Common(Quantity::DampingLossPerPeriod), _) => {
                "energy lost in the damping of the structure per forcing period"
            }
            (Common(Quantity::DampingPower), _) => "power lost in the damping of the structure",
            (Common(quantity), _) => quantity.description(),
            (MomentumPerPeriod, _) => "impulse of all impacts, contact forces and reactions per forcing period",
            (ForceMax, _) => "largest force",
            (ContactFraction, _) => "part of the time in contact",
            (HoldingFraction, _) => "part of the time in which a joint holds",
            (ContactLossPerPeriod, _) => "energy lost in the dampers of stops per forcing period",
            (ContactPower, _) => "power lost in the dampers of stops",
            (FrictionLossPerPeriod, _) => "energy lost in friction per forcing period",
            (FrictionPower, _) => "power lost in friction",
            (VelocityMean, _) => "mean velocity",
        }
    }

    /// Whether it depends on where a coordinate is, and not only on how it moves.
    pub(super) const fn of_place(self) -> bool {
        matches!(
            self,
            Common(
                Quantity::DisplacementMin
                    | Quantity::DisplacementMax
                    | Quantity::DisplacementAmplitude
                    | Quantity::DisplacementMean
                    | Quantity::DisplacementRms
            )
        )
    }

    /// Whether it is a sum over events or a time, and needs no integral over the flights.
    pub(super) const fn of_events(self) -> bool {
        matches!(
            self,
            Common(
                Quantity::ImpactSpeedMax
                    | Quantity::ImpactSpeedMean
                    | Quantity::ImpactsPerPeriod
                    | Quantity::ImpactRate
                    | Quantity::ImpactLossPerPeriod
                    | Quantity::ImpactPower
                    | Quantity::StickingFraction
            ) | ContactFraction
                | HoldingFraction
        )
    }
}

impl MachinePart {
    /// The quantities that it has, in the order of reports.
    #[must_use]
    pub const fn quantities(self) -> &'static [MachineQuantity] {
        match self {
            Self::Whole => &WHOLE,
            Self::Force(_) => &[Common(Quantity::WorkPerPeriod)],
            Self::Stop(_) => &STOP,
            Self::Joint(_) => &JOINT,
            Self::Coordinate(_) => &COORDINATE,
        }
    }

    /// The parts of a machine, in the order of reports: the whole first, forces by their order.
    #[must_use]
    pub fn all(machine: &Machine) -> Vec<Self> {
        let mut orders: Vec<u32> = machine.parts().forces.iter().map(|force| force.order).collect();
        orders.sort_unstable();
        orders.dedup();
        let forces = orders.into_iter().map(Self::Force);
        let stops = (0..machine.stops().len()).map(Self::Stop);
        let joints = (0..machine.joints().len()).map(Self::Joint);
        let coordinates = (0..machine.n()).map(Self::Coordinate);
        core::iter::once(Self::Whole).chain(forces).chain(stops).chain(joints).chain(coordinates).collect()
    }

    /// What the paths of its quantities begin with, as `stop.wall`; nothing for the whole machine.
    #[must_use]
    pub fn head(self, machine: &Machine) -> String {
        match self {
            Self::Whole => String::new(),
            Self::Force(order) => format!("force.{order}"),
            Self::Stop(j) => format!("stop.{}", machine.stops()[j].name),
            Self::Joint(j) => format!("friction.{}", machine.joints()[j].name),
            Self::Coordinate(i) => format!("q.{}", machine.parts().coordinates[i]),
        }
    }

    /// The path of a quantity of it, as `stop.wall.impulse_per_period`, `friction.guide.force_max`,
    /// `q.body.displacement_rms`, `force.1.work_per_period`; of the whole machine the name alone, as `power`.
    #[must_use]
    pub fn path(self, machine: &Machine, quantity: MachineQuantity) -> String {
        let (head, name) = (self.head(machine), quantity.name());
        if head.is_empty() { name.to_owned() } else { format!("{head}.{name}") }
    }
}

/// The paths of all quantities of a machine, in the order of reports.
///
/// ```
/// use vibroimpact::machine::{Machine, MachineParts};
/// use vibroimpact::quantities::machine_quantity_paths;
/// let parts = MachineParts::new(["body"]).with_mass(0, 1.0).with_rigid_stop("wall", &[1.0], 1.0, 0.8);
/// let paths = machine_quantity_paths(&Machine::new(parts)?);
/// assert!(paths.contains(&"power".to_owned()) && paths.contains(&"stop.wall.impulse_per_period".to_owned()));
/// assert_eq!(paths.last().unwrap(), "q.body.acceleration_max");
/// # Ok::<(), vibroimpact::machine::MachineError>(())
/// ```
#[must_use]
pub fn machine_quantity_paths(machine: &Machine) -> Vec<String> {
    let of = |part: MachinePart| part.quantities().iter().map(move |quantity| part.path(machine, *quantity));
    MachinePart::all(machine).into_iter().flat_map(of).collect()
}

/// The part and the quantity at a path; hyphens and underscores of the name are equal.
///
/// # Errors
/// [`MachineError`] if the path leads to no quantity of this machine.
pub fn machine_quantity(machine: &Machine, path: &str) -> Result<(MachinePart, MachineQuantity), MachineError> {
    let (head, name) = path.rsplit_once('.').unwrap_or(("", path));
    let name = name.replace('-', "_");
    let parts = MachinePart::all(machine);
    let Some(part) = parts.iter().find(|part| part.head(machine) == head) else {
        let heads: Vec<String> = parts.iter().skip(1).map(|part| part.head(machine)).collect();
        let hint = format!("quantities of parts begin with {}", heads.join(", "));
        return Err(MachineError::new(path, MachineFault::NoNumber(hint)));
    };
    let found = part.quantities().iter().find(|quantity| quantity.name() == name);
    found.map(|quantity| (*part, *quantity)).ok_or_else(|| {
        let names: Vec<&str> = part.quantities().iter().map(|quantity| quantity.name()).collect();
        let of = if head.is_empty() { "the machine" } else { head };
        MachineError::new(path, MachineFault::NoNumber(format!("the quantities of {of} are {}", names.join(", "))))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::MachineParts;

    #[test]
    fn each_path_leads_to_its_quantity() {
        let parts = MachineParts::new(["a", "b"]).with_mass(0, 1.0).with_mass(1, 1.0).with_frequency(2.0);
        let parts = parts.with_force(0, 3, 1.0, 0.0).with_rigid_stop("wall", &[1.0, 0.0], 1.0, 0.5);
        let machine = Machine::new(parts.with_joint("guide", &[0.0, 1.0], 0.1, 0.2, 0.0)).unwrap();
        let paths = machine_quantity_paths(&machine);
        assert_eq!(paths.len(), 13 + 1 + 12 + 5 + 2 * 9);
        for path in &paths {
            let (part, quantity) = machine_quantity(&machine, path).unwrap();
            assert_eq!(part.path(&machine, quantity), *path);
            assert_eq!(machine_quantity(&machine, &path.replace("_per_", "-per-")).unwrap(), (part, quantity));
        }
        let said = |path: &str| machine_quantity(&machine, path).unwrap_err().to_string();
        assert!(said("stop.wal.force_max").contains("begin with force.3, stop.wall, friction.guide, q.a, q.b"));
        assert!(said("q.a.speed").contains("the quantities of q.a are displacement_min,"), "{}", said("q.a.speed"));
    }
}
