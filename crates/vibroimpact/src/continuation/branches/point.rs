//! A point of a branch, and the events that are possible there.

use crate::orbit::{Cycle, Stability};
use crate::system::Side;
use crate::verdict::Label;

/// A point of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct SolutionPoint {
    /// Value of the parameter.
    pub value: f64,
    /// The cycle there, even if it is inadmissible. At a grazing event it is the cycle of the branch before the event.
    pub cycle: Cycle,
    /// Whether the cycle is admissible, according to the certified first contact of each flight. An event at which this
    /// changes counts as admissible.
    pub physical: bool,
    /// The event at this point; `None` for an ordinary point.
    pub event: Option<BranchEvent>,
}

impl SolutionPoint {
    /// Whether neighbours approach the cycle, even if it is inadmissible.
    #[must_use]
    pub fn stability(&self) -> Stability {
        self.cycle.stability()
    }

    /// Whether the cycle is admissible and attracts its neighbourhood.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.physical && self.cycle.stable()
    }
}

/// How an impact changes at a grazing event, in the direction in which the branch is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// A flight reaches a stop; beyond the event there is an impact.
    Appears,
    /// The speed of an impact becomes zero; beyond the event the mass clears the stop.
    Disappears,
}

/// A second grazing contact at the same event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The index of the impact of this point's cycle that disappears, or after which a new one appears.
    pub impact: usize,
    /// Stop of the grazing contact.
    pub side: Side,
    /// Phase of the grazing contact.
    pub phase: f64,
}

/// An event at a point of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BranchEvent {
    /// The parameter turns back; a multiplier is +1.
    Fold,
    /// A multiplier is +1 and another branch crosses or ends here: with two equal stops, symmetry is lost or gained.
    BranchPoint,
    /// A multiplier is -1; a branch of twice the period begins or ends here.
    Flip,
    /// The branch ends on the branch of half the period, at a flip of that branch.
    Halving,
    /// An impact has speed zero. The branch continues with the cycle that is admissible beyond, with one impact more or
    /// less.
    Grazing {
        /// Whether the impact appears or disappears.
        change: Change,
        /// The index of the impact of this point's cycle that disappears, or after which a new one appears.
        impact: usize,
        /// Stop of the grazing contact.
        side: Side,
        /// Phase of the grazing contact.
        phase: f64,
        /// Label before.
        before: Label,
        /// Label after.
        after: Label,
        /// Whether the parameter turns back here (a nonsmooth fold); if not, it continues in its direction
        /// (persistence).
        turns: bool,
        /// A second grazing contact at the same value: with two equal stops, that on the other stop.
        also: Option<Touch>,
    },
    /// The only impact has speed zero; beyond, the mass never reaches the stop. This event occurs only without damping,
    /// where the orbits 1/n of all n end together in one of a continuum of motions without impacts, so the branch ends.
    /// With damping it is a [`Grazing`](Self::Grazing) event with the label 0 after it, and the branch continues along
    /// the steady motion without impacts.
    LossOfContact {
        /// Stop of the grazing contact.
        side: Side,
        /// Phase of the grazing contact.
        phase: f64,
    },
    /// With restitution 0: beyond, the mass sticks after this impact.
    Stick {
        /// The index of the impact of this point's cycle.
        impact: usize,
    },
    /// On a branch of cycles that stick: all impacts before the mass sticks have speed zero. The mass reaches the stop
    /// without speed at the phase at which the force begins to press it there. Without damping, where a flight is
    /// symmetric in time, this occurs at single values of one parameter.
    SoftLanding {
        /// The index of the first of these impacts in this point's cycle.
        impact: usize,
        /// Stop on which the mass lands.
        side: Side,
        /// Phase of the landing.
        phase: f64,
        /// Label before.
        before: Label,
        /// Label after.
        after: Label,
    },
    /// On a branch of cycles that stick: the time of sticking is zero, at the phase of the release. Beyond, the mass
    /// leaves the stop before it sticks: after an incomplete chatter or, with restitution 0, because the force pulls it
    /// away. The branch ends. For a complete chatter, cycles with ever more impacts end at the same value from the
    /// other side.
    EndOfRest {
        /// Stop on which the mass sticks.
        side: Side,
        /// Phase of the release.
        phase: f64,
    },
    /// On a branch of cycles that stick: beyond, the force never pulls the mass off the stop.
    RestForEver {
        /// Stop on which the mass sticks.
        side: Side,
    },
    /// Impacts appeared one after another, and their number is infinite here. The cycle of this point is the limit: it
    /// sticks at the phase of the release. Beyond, the branch is one of cycles that stick.
    Chatter {
        /// Stop of the chatter.
        side: Side,
        /// Phase of the release.
        phase: f64,
        /// Label of the branch before this event.
        before: Label,
    },
    /// An inadmissible solution becomes admissible.
    BecomesPhysical,
    /// The cycle becomes inadmissible, on a branch that keeps its signature.
    BecomesVirtual,
    /// The branch is closed: the next point would be the first.
    Closed,
    /// The parameter reached the end of its range.
    EndOfRange,
    /// The largest number of points was reached.
    StepLimit,
    /// The cycle would have more impacts than allowed.
    ImpactLimit,
    /// No step down to the smallest length converged.
    NoConvergence,
}

impl BranchEvent {
    /// Its name in tables.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::BranchPoint => "branch point",
            Self::Flip => "flip",
            Self::Halving => "halving",
            Self::Grazing { .. } => "grazing",
            Self::LossOfContact { .. } => "loss of contact",
            Self::Stick { .. } => "stick",
            Self::SoftLanding { .. } => "soft landing",
            Self::EndOfRest { .. } => "end of rest",
            Self::RestForEver { .. } => "rest for ever",
            Self::Chatter { .. } => "chatter",
            Self::BecomesPhysical => "becomes physical",
            Self::BecomesVirtual => "becomes virtual",
            Self::Closed => "closed",
            Self::EndOfRange => "end of range",
            Self::StepLimit => "step limit",
            Self::ImpactLimit => "impact limit",
            Self::NoConvergence => "no convergence",
        }
    }

    /// Whether the branch ends at this event.
    #[must_use]
    pub const fn ends(&self) -> bool {
        !matches!(
            self,
            Self::Fold
                | Self::BranchPoint
                | Self::Flip
                | Self::Grazing { .. }
                | Self::SoftLanding { .. }
                | Self::BecomesPhysical
                | Self::BecomesVirtual
        )
    }
}
