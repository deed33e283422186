//! The parts of a machine, the quantities of each, and their paths.

use crate::machine::{Fault, Machine, MachineError};
use crate::quantities::quantity::Quantity;
use crate::regime::Normal;

/// What a quantity refers to. Stops, joints and coordinates are counted as in the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Part {
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

const WHOLE: [Quantity; 13] = [
    Quantity::ImpactSpeedMax,
    Quantity::ImpactsPerPeriod,
    Quantity::ImpactRate,
    Quantity::WorkPerPeriod,
    Quantity::Power,
    Quantity::ImpactLossPerPeriod,
    Quantity::ImpactPower,
    Quantity::ContactLossPerPeriod,
    Quantity::ContactPower,
    Quantity::FrictionLossPerPeriod,
    Quantity::FrictionPower,
    Quantity::DampingLossPerPeriod,
    Quantity::DampingPower,
];
const STOP: [Quantity; 12] = [
    Quantity::ImpactSpeedMax,
    Quantity::ImpactSpeedMean,
    Quantity::ImpactsPerPeriod,
    Quantity::ImpulseMax,
    Quantity::ImpulsePerPeriod,
    Quantity::MomentumPerPeriod,
    Quantity::ForceMax,
    Quantity::StickingFraction,
    Quantity::ContactFraction,
    Quantity::ImpactLossPerPeriod,
    Quantity::ContactLossPerPeriod,
    Quantity::WorkPerPeriod,
];
const JOINT: [Quantity; 5] = [
    Quantity::MomentumPerPeriod,
    Quantity::ForceMax,
    Quantity::HoldingFraction,
    Quantity::FrictionLossPerPeriod,
    Quantity::WorkPerPeriod,
];
const COORDINATE: [Quantity; 9] = [
    Quantity::DisplacementMin,
    Quantity::DisplacementMax,
    Quantity::DisplacementAmplitude,
    Quantity::DisplacementMean,
    Quantity::DisplacementRms,
    Quantity::VelocityMax,
    Quantity::VelocityMean,
    Quantity::VelocityRms,
    Quantity::AccelerationMax,
];

impl Part {
    /// What a quantity of it is, in words.
    #[must_use]
    pub const fn description(self, quantity: Quantity) -> &'static str {
        match (quantity, self) {
            (Quantity::WorkPerPeriod, Self::Whole) => "work of forces, moving stops and belts per forcing period",
            (Quantity::WorkPerPeriod, Self::Stop(_)) => "work of a moving stop per forcing period",
            (Quantity::WorkPerPeriod, Self::Joint(_)) => "work of a belt per forcing period",
            (Quantity::Power, _) => "power of forces, moving stops and belts",
            (Quantity::ImpactsPerPeriod, _) => "closings of stops per forcing period",
            (Quantity::ImpactRate, _) => "closings of stops per unit of time",
            (Quantity::ImpactSpeedMax, _) => "largest speed of closing",
            (Quantity::ImpactSpeedMean, _) => "mean speed of closing",
            (Quantity::ImpulseMax, _) => "largest impulse of an impact or contact",
            (Quantity::StickingFraction, _) => "part of the time at rest on a stop",
            (Quantity::DampingLossPerPeriod, _) => "energy lost in the damping of the structure per forcing period",
            (Quantity::DampingPower, _) => "power lost in the damping of the structure",
            (quantity, _) => quantity.description(),
        }
    }

    /// The quantities that it has, in the order of reports.
    #[must_use]
    pub const fn quantities(self) -> &'static [Quantity] {
        match self {
            Self::Whole => &WHOLE,
            Self::Force(_) => &[Quantity::WorkPerPeriod],
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
    pub fn path(self, machine: &Machine, quantity: Quantity) -> String {
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
    let of = |part: Part| part.quantities().iter().map(move |quantity| part.path(machine, *quantity));
    Part::all(machine).into_iter().flat_map(of).collect()
}

/// The part and the quantity at a path; hyphens and underscores of the name are equal.
///
/// # Errors
/// [`MachineError`] if the path leads to no quantity of this machine.
pub fn machine_quantity(machine: &Machine, path: &str) -> Result<(Part, Quantity), MachineError> {
    let (head, name) = path.rsplit_once('.').unwrap_or(("", path));
    let name = name.replace('-', "_");
    let parts = Part::all(machine);
    let Some(part) = parts.iter().find(|part| part.head(machine) == head) else {
        let heads: Vec<String> = parts.iter().skip(1).map(|part| part.head(machine)).collect();
        let hint = format!("quantities of parts begin with {}", heads.join(", "));
        return Err(MachineError::new(path, Fault::NoNumber(hint)));
    };
    let found = part.quantities().iter().find(|quantity| quantity.name() == name);
    found.map(|quantity| (*part, *quantity)).ok_or_else(|| {
        let names: Vec<&str> = part.quantities().iter().map(|quantity| quantity.name()).collect();
        let of = if head.is_empty() { "the machine" } else { head };
        MachineError::new(path, Fault::NoNumber(format!("the quantities of {of} are {}", names.join(", "))))
    })
}

/// The path of the quantity that a response shows if none is chosen: the displacement amplitude of the first coordinate that no free
/// translation moves, or, where all are moved, the largest speed of the first one. The displacement of a machine that drifts has no
/// amplitude.
#[must_use]
pub fn machine_response_quantity(machine: &Machine) -> String {
    let normal = Normal::new(machine);
    let held = (0..machine.parts().n()).find(|k| !normal.translations.moves(*k));
    let quantity = if held.is_some() { Quantity::DisplacementAmplitude } else { Quantity::VelocityMax };
    Part::Coordinate(held.unwrap_or(0)).path(machine, quantity)
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

    /// Two masses on a spring drift together; a third one hangs on the ground.
    #[test]
    fn the_response_of_what_drifts_is_a_speed() {
        let parts = |names: &[&str]| {
            let masses = MachineParts::new(names.iter().copied());
            let masses = (0..names.len()).fold(masses, |parts, k| parts.with_mass(k, 1.0));
            let along =
                |k: usize| (0..names.len()).map(move |i| if i == k { -1.0 } else { f64::from(u8::from(i == 0)) });
            masses.with_link(&along(1).collect::<Vec<_>>(), 1.0, 0.1).with_frequency(1.0)
        };
        let shown = |parts: MachineParts| machine_response_quantity(&Machine::new(parts).unwrap());
        assert_eq!(shown(parts(&["mass", "capsule"])), "q.mass.velocity_max");
        let third = parts(&["mass", "capsule", "arm"]);
        assert_eq!(shown(third.with_link(&[0.0, 0.0, 1.0], 1.0, 0.1)), "q.arm.displacement_amplitude");
    }
}
