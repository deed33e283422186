//! The sums over a part of a motion of a machine, for each of its parts, and its extremes.

use super::super::Quantity;
use super::super::sums::{Sum, Sums};
use super::part::Part;
use crate::machine::Machine;

/// The sums over a part of a motion.
#[derive(Clone, Debug, Default)]
pub(super) struct PartSums {
    pub(super) time: f64,
    /// The damping of the structure, and the work of the constant forces along the free translations.
    pub(super) structure: Sums,
    /// Those of the forces of each order.
    pub(super) forces: Vec<(u32, Sums)>,
    pub(super) stops: Vec<Sums>,
    pub(super) joints: Vec<Sums>,
    pub(super) coordinates: Vec<Sums>,
}

/// The extremes of a motion.
#[derive(Clone, Debug)]
pub(super) struct Extremes {
    /// The ranges of position, velocity and acceleration of each coordinate.
    pub(super) coordinates: Vec<[(f64, f64); 3]>,
    /// The ranges of the forces of stops and joints.
    pub(super) forces: Vec<(f64, f64)>,
    /// The largest speed of closing, and the largest impulse of each stop; NaN where a contact has no end.
    pub(super) speeds: Vec<f64>,
    pub(super) impulses: Vec<f64>,
}

/// An interval without a point.
const NOTHING: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

impl PartSums {
    pub(super) fn new(machine: &Machine) -> Self {
        let orders = Part::all(machine).into_iter().filter_map(|part| match part {
            Part::Force(order) => Some((order, Sums::default())),
            _ => None,
        });
        Self {
            forces: orders.collect(),
            stops: vec![Sums::default(); machine.stops().len()],
            joints: vec![Sums::default(); machine.joints().len()],
            coordinates: vec![Sums::default(); machine.n()],
            ..Self::default()
        }
    }

    /// Those of a part of the machine; the whole has the sums of all its parts.
    pub(super) fn of(&self, part: Part) -> Sums {
        let mut sums = match part {
            Part::Whole => {
                let mut whole = Sums::default();
                let forces = self.forces.iter().map(|(_, force)| force);
                forces.chain([&self.structure]).chain(&self.stops).chain(&self.joints).for_each(|of| whole.add(of));
                whole
            }
            Part::Force(order) => {
                let force = self.forces.iter().find(|(own, _)| *own == order);
                force.map_or_else(Sums::default, |(_, force)| *force)
            }
            Part::Stop(j) => self.stops[j],
            Part::Joint(j) => self.joints[j],
            Part::Coordinate(i) => self.coordinates[i],
        };
        // all parts have the time of the motion
        sums[Sum::Time] = self.time;
        sums
    }
}

impl Extremes {
    /// Those of no motion.
    pub(super) fn new(machine: &Machine) -> Self {
        let stops = machine.stops().len();
        // forces are not negative where only the largest is asked for
        let none = (f64::NEG_INFINITY, 0.0);
        Self {
            // of velocity and acceleration only the size is asked for, which is not negative
            coordinates: vec![[NOTHING, (0.0, 0.0), (0.0, 0.0)]; machine.n()],
            forces: (0..stops).map(|_| none).chain(machine.joints().iter().map(|_| (0.0, 0.0))).collect(),
            speeds: vec![0.0; stops],
            impulses: vec![0.0; stops],
        }
    }

    /// An extreme; NaN for a mean.
    pub(super) fn get(&self, part: Part, quantity: Quantity) -> f64 {
        let size = |range: (f64, f64)| range.1.max(-range.0);
        match (part, quantity) {
            (Part::Whole, Quantity::ImpactSpeedMax) => self.speeds.iter().fold(0.0, |most, speed| most.max(*speed)),
            (Part::Stop(j), Quantity::ImpactSpeedMax) => self.speeds[j],
            (Part::Stop(j), Quantity::ImpulseMax) => self.impulses[j],
            (Part::Stop(j), Quantity::ForceMax) => self.forces[j].1,
            (Part::Joint(j), Quantity::ForceMax) => size(self.forces[self.speeds.len() + j]),
            (Part::Coordinate(i), of) => {
                let [x, v, a] = self.coordinates[i];
                match of {
                    Quantity::DisplacementMin => x.0,
                    Quantity::DisplacementMax => x.1,
                    Quantity::DisplacementAmplitude => 0.5 * (x.1 - x.0),
                    Quantity::VelocityMax => size(v),
                    Quantity::AccelerationMax => size(a),
                    _ => f64::NAN,
                }
            }
            _ => f64::NAN,
        }
    }

    /// Makes the ranges of which only the size is asked for symmetric, so that less is searched for.
    pub(super) fn symmetric(&mut self) {
        let stops = self.speeds.len();
        let velocities = self.coordinates.iter_mut().flat_map(|[_, v, a]| [v, a]);
        for range in velocities.chain(&mut self.forces[stops..]) {
            let size = range.1.max(-range.0);
            *range = (-size, size);
        }
    }
}
