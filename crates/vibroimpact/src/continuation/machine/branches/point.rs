//! A point of a branch of a machine, and the events that are possible there.

use crate::machine::{Machine, StopLaw};
use crate::orbit::{MachineRing, machine::Cycle};
use crate::regime::{GuardKind, Normal};

/// A point of a branch.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SolutionPoint {
    /// Value of the number that varies.
    pub value: f64,
    /// The cycle there.
    pub cycle: Cycle,
    /// The event at this point; `None` for an ordinary point.
    pub event: Option<BranchEvent>,
    /// At an event the solution there, to rounding: a curve begins with it. Following the motion of `cycle` instead can miss a stop
    /// that it only touches.
    pub(crate) ring: Option<MachineRing>,
}

/// An event at a point of a branch. Stops and joints are given by their place: joints are counted after the stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BranchEvent {
    /// The number turns back; a multiplier is +1.
    Fold,
    /// A multiplier is +1 and another branch crosses here.
    BranchPoint,
    /// A multiplier is -1; a branch of twice the period begins or ends here.
    Flip,
    /// The branch ends on the branch of half the period, at a flip of that branch.
    Halving,
    /// A pair of complex multipliers crosses the unit circle (Neimark-Sacker).
    Torus,
    /// A stop is closed with speed zero, or a closed one opens for no time.
    Grazing {
        /// The stop.
        stop: usize,
        /// Another stop of which the same is true here, to rounding, as of a symmetric machine. Which of both is named first is
        /// decided by rounding; closings that appear are known where the branch goes on.
        also: Option<usize>,
        /// Whether a closing appears or disappears beyond.
        appears: bool,
        /// Whether the number turns back here.
        turns: bool,
    },
    /// Two events happen at the same time and change their order or act together beyond. With one stop for both, the force and the
    /// position of a compliant stop are zero at once at its opening, or the surface of a damped stop comes back to its place just
    /// when the stop closes.
    Corner {
        /// The one that came first.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A rest on a stop begins or ends to be a part of the cycle. For a stop with a restitution above 0 the rest follows a chatter
    /// that is complete exactly at the release here, to about 1e-11.
    Sticking {
        /// The stop.
        stop: usize,
        /// Whether it begins.
        begins: bool,
    },
    /// A friction joint begins or ends to hold in the cycle.
    Holding {
        /// The joint.
        joint: usize,
        /// Whether it begins.
        begins: bool,
    },
    /// The motion is not continuous at the event before, as where a joint whose static limit exceeds its sliding force begins or
    /// ceases to hold. The branch goes on here, where a cycle with the events beyond begins to exist.
    Jump,
    /// The motion is not continuous at the event before, and no cycle with the events beyond exists close by.
    Discontinuity,
    /// Another change of the sequence of events.
    Change {
        /// The stop or joint at which the sequence first differs, if it is known.
        place: Option<usize>,
    },
    /// The only closing has speed zero; beyond, there is none.
    LossOfContact {
        /// The stop.
        stop: usize,
    },
    /// The structure rests on a stop in the cycle; beyond, no force pulls it off for ever.
    RestForEver {
        /// The stop.
        stop: usize,
    },
    /// The branch is closed: the next point would be the first.
    Closed,
    /// The number reached the end of its range.
    EndOfRange,
    /// The largest number of points was reached.
    StepLimit,
    /// No cycle was found further on.
    NoConvergence,
}

/// A closing has no speed if it has less than this part of the largest velocity.
const WITHOUT_SPEED: f64 = 1e-6;

impl BranchEvent {
    /// The same on the solution at the event, with the other stop of which a closing has no speed where one disappears; `speed` is
    /// the largest velocity.
    pub(super) fn on(self, machine: &Machine, ring: &MachineRing, speed: f64) -> Self {
        let Self::Grazing { stop, also: None, appears: false, turns } = self else { return self };
        let normal = Normal::new(machine);
        let slow = |k: usize| {
            let GuardKind::Gap(other) = ring.events[k].guard else { return None };
            let share = match machine.stops()[other].law {
                StopLaw::Rigid { restitution } => restitution,
                StopLaw::Compliant { .. } => 1.0,
            };
            let place = ring.place(k);
            let after = place.gap(&normal, &place.turns(&normal), other).1.abs();
            (other != stop && share > 0.0 && after <= share * WITHOUT_SPEED * speed).then_some(other)
        };
        Self::Grazing { stop, also: (0..ring.len()).find_map(slow), appears: false, turns }
    }

    /// Its name in JSON and tables.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::BranchPoint => "branch point",
            Self::Flip => "flip",
            Self::Halving => "halving",
            Self::Torus => "torus",
            Self::LossOfContact { .. } => "loss of contact",
            Self::RestForEver { .. } => "rest for ever",
            Self::Grazing { .. } => "grazing",
            Self::Corner { .. } => "corner",
            Self::Sticking { begins: true, .. } => "sticking begins",
            Self::Sticking { .. } => "sticking ends",
            Self::Holding { begins: true, .. } => "holding begins",
            Self::Holding { .. } => "holding ends",
            Self::Jump => "jump",
            Self::Discontinuity => "discontinuity",
            Self::Change { .. } => "change",
            Self::Closed => "closed",
            Self::EndOfRange => "end of range",
            Self::StepLimit => "step limit",
            Self::NoConvergence => "no convergence",
        }
    }

    /// The stop or joint of the event.
    #[must_use]
    pub const fn place(&self) -> Option<usize> {
        match *self {
            Self::Grazing { stop, .. }
            | Self::Sticking { stop, .. }
            | Self::LossOfContact { stop }
            | Self::RestForEver { stop } => Some(stop),
            Self::Corner { first, .. } => Some(first),
            Self::Holding { joint, .. } => Some(joint),
            Self::Change { place } => place,
            _ => None,
        }
    }

    /// The other stop or joint of two at the same time, if it is another one.
    #[must_use]
    pub const fn also(&self) -> Option<usize> {
        match *self {
            Self::Grazing { also, .. } => also,
            Self::Corner { first, second } if first != second => Some(second),
            _ => None,
        }
    }

    /// Whether the branch ends at this event.
    #[must_use]
    pub const fn ends(&self) -> bool {
        matches!(
            self,
            Self::Halving
                | Self::Discontinuity
                | Self::LossOfContact { .. }
                | Self::RestForEver { .. }
                | Self::Closed
                | Self::EndOfRange
                | Self::StepLimit
                | Self::NoConvergence
        )
    }
}
