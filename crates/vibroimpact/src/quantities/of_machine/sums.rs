//! The sums over a part of a motion of a machine of which means are quotients, and its extremes.

use super::quantity::{MachinePart, MachineQuantity};
use crate::lyapunov::Measured;
use crate::lyapunov::blocks::quotient;
use crate::machine::Machine;
use crate::quantities::quantity::Quantity;

/// The sums over a part of a motion.
#[derive(Clone, Debug, Default)]
pub(super) struct MachineSums {
    pub(super) time: f64,
    /// Energy lost in the damping of the structure.
    pub(super) damping: f64,
    /// The work of the forces of each order.
    pub(super) forces: Vec<(u32, f64)>,
    /// The work of the constant forces along the free translations.
    pub(super) constant: f64,
    pub(super) stops: Vec<StopSums>,
    pub(super) joints: Vec<JointSums>,
    pub(super) coordinates: Vec<CoordinateSums>,
}

/// The sums of a stop.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StopSums {
    pub(super) closings: f64,
    pub(super) speeds: f64,
    /// Impulses of impacts and of the contact force, and those of the reaction at rest.
    pub(super) impulse: f64,
    pub(super) rest_impulse: f64,
    /// Energy lost in impacts, and in its damper.
    pub(super) impact_loss: f64,
    pub(super) contact_loss: f64,
    /// Its work on the machine.
    pub(super) work: f64,
    /// The times in which it is closed, and in which the machine rests on it.
    pub(super) closed: f64,
    pub(super) resting: f64,
}

/// The sums of a friction joint.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct JointSums {
    pub(super) impulse: f64,
    pub(super) loss: f64,
    /// The work of its belt on the machine.
    pub(super) work: f64,
    pub(super) holding: f64,
}

/// The integrals of a coordinate.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CoordinateSums {
    pub(super) x: f64,
    pub(super) x_squared: f64,
    pub(super) v: f64,
    pub(super) v_squared: f64,
}

/// The extremes of a motion.
#[derive(Clone, Debug)]
pub(super) struct MachineExtremes {
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

impl MachineSums {
    pub(super) fn new(machine: &Machine) -> Self {
        let orders = MachinePart::all(machine).into_iter().filter_map(|part| match part {
            MachinePart::Force(order) => Some((order, 0.0)),
            _ => None,
        });
        Self {
            forces: orders.collect(),
            stops: vec![StopSums::default(); machine.stops().len()],
            joints: vec![JointSums::default(); machine.joints().len()],
            coordinates: vec![CoordinateSums::default(); machine.n()],
            ..Self::default()
        }
    }

    fn over_stops(&self, of: impl Fn(&StopSums) -> f64) -> f64 {
        self.stops.iter().fold(0.0, |sum, stop| sum + of(stop))
    }

    fn over_joints(&self, of: impl Fn(&JointSums) -> f64) -> f64 {
        self.joints.iter().fold(0.0, |sum, joint| sum + of(joint))
    }

    /// The upper sum of a mean; `None` for an extreme.
    fn above(&self, part: MachinePart, quantity: MachineQuantity) -> Option<f64> {
        use MachineQuantity as M;
        match part {
            MachinePart::Whole => Some(match quantity {
                M::Common(Quantity::ImpactsPerPeriod | Quantity::ImpactRate) => self.over_stops(|stop| stop.closings),
                M::Common(Quantity::WorkPerPeriod | Quantity::Power) => {
                    let forces = self.forces.iter().fold(0.0, |sum, (_, work)| sum + work);
                    forces + self.constant + self.over_stops(|stop| stop.work) + self.over_joints(|joint| joint.work)
                }
                M::Common(Quantity::ImpactLossPerPeriod | Quantity::ImpactPower) => {
                    self.over_stops(|stop| stop.impact_loss)
                }
                M::ContactLossPerPeriod | M::ContactPower => self.over_stops(|stop| stop.contact_loss),
                M::FrictionLossPerPeriod | M::FrictionPower => self.over_joints(|joint| joint.loss),
                M::Common(Quantity::DampingLossPerPeriod | Quantity::DampingPower) => self.damping,
                _ => return None,
            }),
            MachinePart::Force(order) => self.forces.iter().find(|(own, _)| *own == order).map(|(_, work)| *work),
            MachinePart::Stop(j) => {
                let stop = &self.stops[j];
                Some(match quantity {
                    M::Common(Quantity::ImpactSpeedMean) => stop.speeds,
                    M::Common(Quantity::ImpactsPerPeriod) => stop.closings,
                    M::Common(Quantity::ImpulsePerPeriod) => stop.impulse,
                    M::MomentumPerPeriod => stop.impulse + stop.rest_impulse,
                    M::Common(Quantity::StickingFraction) => stop.resting,
                    M::ContactFraction => stop.closed + stop.resting,
                    M::Common(Quantity::ImpactLossPerPeriod) => stop.impact_loss,
                    M::ContactLossPerPeriod => stop.contact_loss,
                    M::Common(Quantity::WorkPerPeriod) => stop.work,
                    _ => return None,
                })
            }
            MachinePart::Joint(j) => {
                let joint = &self.joints[j];
                Some(match quantity {
                    M::MomentumPerPeriod => joint.impulse,
                    M::HoldingFraction => joint.holding,
                    M::FrictionLossPerPeriod => joint.loss,
                    M::Common(Quantity::WorkPerPeriod) => joint.work,
                    _ => return None,
                })
            }
            MachinePart::Coordinate(i) => {
                let coordinate = &self.coordinates[i];
                Some(match quantity {
                    M::Common(Quantity::DisplacementMean) => coordinate.x,
                    M::Common(Quantity::DisplacementRms) => coordinate.x_squared,
                    M::VelocityMean => coordinate.v,
                    M::Common(Quantity::VelocityRms) => coordinate.v_squared,
                    _ => return None,
                })
            }
        }
    }
}

/// A mean over blocks of a motion, with three standard errors; `None` for an extreme. `period` is that of the forcing.
pub(super) fn mean(
    blocks: &[MachineSums],
    (part, quantity): (MachinePart, MachineQuantity),
    period: f64,
) -> Option<Measured> {
    blocks.first()?.above(part, quantity)?;
    let above = |sums: &MachineSums| sums.above(part, quantity).unwrap_or(f64::NAN);
    let of_speeds = quantity == MachineQuantity::Common(Quantity::ImpactSpeedMean);
    let below = |sums: &MachineSums| match part {
        MachinePart::Stop(j) if of_speeds => sums.stops[j].closings,
        _ => sums.time,
    };
    let Measured { value, error } = quotient(blocks, 0.0, above, below);
    Some(match quantity {
        MachineQuantity::Common(Quantity::DisplacementRms | Quantity::VelocityRms) => {
            let root = value.max(0.0).sqrt();
            Measured { value: root, error: error / (2.0 * root) }
        }
        // no mean of infinitely many impacts
        _ if of_speeds && !blocks.iter().all(|sums| below(sums).is_finite()) => {
            Measured { value: f64::NAN, error: f64::NAN }
        }
        _ if quantity.name().ends_with("_per_period") => Measured { value: value * period, error: error * period },
        _ => Measured { value, error },
    })
}

impl MachineExtremes {
    /// Those of no motion.
    pub(super) fn new(machine: &Machine) -> Self {
        let stops = machine.stops().len();
        // forces are not negative where only the largest is asked for
        let none = (f64::NEG_INFINITY, 0.0);
        Self {
            coordinates: vec![[NOTHING, (0.0, 0.0), (0.0, 0.0)]; machine.n()],
            forces: (0..stops).map(|_| none).chain(machine.joints().iter().map(|_| (0.0, 0.0))).collect(),
            speeds: vec![0.0; stops],
            impulses: vec![0.0; stops],
        }
    }

    /// An extreme; NaN for a mean.
    pub(super) fn get(&self, part: MachinePart, quantity: MachineQuantity) -> f64 {
        use MachineQuantity as M;
        let size = |range: (f64, f64)| range.1.max(-range.0);
        match (part, quantity) {
            (MachinePart::Whole, M::Common(Quantity::ImpactSpeedMax)) => {
                self.speeds.iter().fold(0.0, |most, speed| most.max(*speed))
            }
            (MachinePart::Stop(j), M::Common(Quantity::ImpactSpeedMax)) => self.speeds[j],
            (MachinePart::Stop(j), M::Common(Quantity::ImpulseMax)) => self.impulses[j],
            (MachinePart::Stop(j), M::ForceMax) => self.forces[j].1,
            (MachinePart::Joint(j), M::ForceMax) => size(self.forces[self.speeds.len() + j]),
            (MachinePart::Coordinate(i), M::Common(of)) => {
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
