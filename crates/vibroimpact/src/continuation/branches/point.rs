//! A point of a branch, and what may happen there.

use crate::orbit::Cycle;
use crate::system::Side;
use crate::verdict::Label;

/// A point of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct SolutionPoint {
    /// Value of the parameter.
    pub value: f64,
    /// The cycle there, also where it is no possible motion. At a grazing event that of the branch so far.
    pub cycle: Cycle,
    /// Whether it is a possible motion, as the certified first contact of each flight says. An event where that
    /// changes counts as one that is.
    pub physical: bool,
    /// What happens here; `None` for an ordinary point.
    pub event: Option<BranchEvent>,
}

impl SolutionPoint {
    /// Whether the cycle attracts its neighbourhood.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.physical && self.cycle.stable()
    }
}

/// What an impact does at a grazing event, in the direction the branch is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// A flight comes to touch a stop; beyond the touch it strikes it.
    Appears,
    /// An impact loses its speed; beyond the touch the mass clears the stop.
    Disappears,
}

/// A touch of a stop that comes or goes together with another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The impact of the point's cycle that disappears, or the one after which a new one appears.
    pub impact: usize,
    /// Stop of the touch.
    pub side: Side,
    /// Phase of the touch.
    pub phase: f64,
}

/// What happens at a point of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BranchEvent {
    /// The parameter turns back; a multiplier is +1.
    Fold,
    /// A multiplier is +1 and another branch crosses or ends here: with two stops alike, symmetry is lost or gained.
    BranchPoint,
    /// A multiplier is -1; a branch of twice the period begins or ends here.
    Flip,
    /// The branch ends on the one of half the period, at a flip of that.
    Halving,
    /// An impact has speed zero. Where the cycle goes on as a motion, with one impact more or less, so does the branch.
    Grazing {
        /// Whether the impact appears or disappears.
        change: Change,
        /// The impact of the point's cycle that disappears, or the one after which a new one appears.
        impact: usize,
        /// Stop of the touch.
        side: Side,
        /// Phase of the touch.
        phase: f64,
        /// Label before.
        before: Label,
        /// Label after.
        after: Label,
        /// Whether the parameter turns back here (a nonsmooth fold); if not, it goes on (persistence).
        turns: bool,
        /// What does the same at the same value: with two stops alike the touch of the other one.
        also: Option<Touch>,
    },
    /// The only impact has speed zero: beyond, the mass never touches the stop. Only without damping, where orbits 1/n of
    /// every n end together in one of a continuum of motions without impacts, so that there is nothing to follow. With
    /// damping this is a [`Grazing`](Self::Grazing) event with the label 0 after it, and the branch goes on along the
    /// steady motion without impacts.
    LossOfContact {
        /// Stop of the touch.
        side: Side,
        /// Phase of the touch.
        phase: f64,
    },
    /// Restitution 0: beyond, the mass stays on the stop after this impact.
    Stick {
        /// The impact of the point's cycle.
        impact: usize,
    },
    /// A cycle with a rest: all impacts that lead to it have speed zero. The mass comes to the stop without speed just as the
    /// force begins to press it there. Without damping, where a flight is the same forwards and backwards in time, this
    /// happens at single values of one parameter.
    SoftLanding {
        /// The first of these impacts in the point's cycle.
        impact: usize,
        /// Stop that is landed on.
        side: Side,
        /// Phase of the landing.
        phase: f64,
        /// Label before.
        before: Label,
        /// Label after.
        after: Label,
    },
    /// A cycle with a rest: the rest is over the moment it begins, at the phase of the release. Beyond, the mass leaves the stop
    /// before it has come to rest: after a chatter that is not complete, or, with restitution 0, where the force pulls it away.
    /// The branch ends. For a complete chatter, cycles with ever more impacts end there too, from the other side.
    EndOfRest {
        /// Stop of the rest.
        side: Side,
        /// Phase of the release.
        phase: f64,
    },
    /// A cycle with a rest: beyond, the force never pulls the mass off the stop.
    RestForEver {
        /// Which stop.
        side: Side,
    },
    /// Impact after impact was added, and here their number is infinite: the limit, which is the cycle of this point, comes to
    /// rest at the phase of the release, and beyond the branch is one of cycles with a rest.
    Chatter {
        /// Stop of the chatter.
        side: Side,
        /// Phase of the release.
        phase: f64,
        /// Label of the branch so far.
        before: Label,
    },
    /// A branch that was followed through inadmissible solutions becomes one.
    BecomesPhysical,
    /// A branch that keeps its signature ceases to be one of motions.
    BecomesVirtual,
    /// The branch closed: the next point would be the first.
    Closed,
    /// The parameter reached this end of its range.
    EndOfRange,
    /// The most points were reached.
    StepLimit,
    /// The cycle would have more impacts than allowed.
    ImpactLimit,
    /// The branch was lost: no smaller step converged.
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

    /// Whether the branch ends with it.
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
