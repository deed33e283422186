//! The events of branches, of every system.

use crate::orbit::Label;

/// An event at a point of a branch. Stops and joints are given by their place: joints are counted after the stops. The stops of an
/// oscillator are the upper one and the lower one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BranchEvent {
    /// The number that varies turns back; a multiplier is +1.
    Fold,
    /// A multiplier is +1 and another branch crosses or ends here: of an oscillator with two equal stops, symmetry is lost or
    /// gained.
    BranchPoint,
    /// A multiplier is -1; a branch of twice the period begins or ends here.
    Flip,
    /// The branch ends on the branch of half the period, at a flip of that branch.
    Halving,
    /// A pair of complex multipliers crosses the unit circle (Neimark-Sacker).
    Torus,
    /// A stop is struck or closed with speed zero, or a closed one opens for no time. The branch goes on with the cycle that is
    /// admissible beyond, with one impact more or less.
    Grazing {
        /// The stop.
        stop: usize,
        /// Another stop of which the same is true here, to rounding, as of a symmetric system. Which of both is named first is
        /// decided by rounding. Of a machine, closings that appear are known where the branch goes on.
        also: Option<usize>,
        /// Whether an impact or a closing appears or disappears beyond.
        appears: bool,
        /// Whether the number turns back here (a nonsmooth fold); if not, it goes on in its direction (persistence).
        turns: bool,
        /// Where in the cycle of an oscillator.
        detail: Option<EventDetail>,
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
    /// A rest on a stop begins or ends to be a part of the cycle, and takes no time here. With restitution 0 the mass stays on the
    /// stop after an impact, or the force pulls it away at once. Otherwise the rest follows a chatter that is complete exactly at the
    /// release here, of a machine to about 1e-11: on the other side the cycles have ever more impacts, which come closer to each
    /// other by a fixed factor. A branch of an oscillator cannot follow these, and ends where such a rest ends.
    Sticking {
        /// The stop.
        stop: usize,
        /// Whether it begins.
        begins: bool,
        /// Where in the cycle of an oscillator: the impact after which the mass stays, or the release.
        detail: Option<EventDetail>,
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
    /// The only impact or closing has speed zero; beyond, there is none. Of an oscillator this event occurs only without damping,
    /// where the orbits 1/n of all n end together in one of a continuum of motions without impacts, so the branch ends. With
    /// damping it is a [`Grazing`](Self::Grazing) event with the label 0 after it, and the branch goes on along the steady
    /// motion without impacts. Of a joint, its only hold takes no time; beyond, the machine swings on without events.
    LossOfContact {
        /// The stop or joint.
        stop: usize,
        /// Where in the cycle of an oscillator.
        detail: Option<EventDetail>,
    },
    /// On a branch of cycles of an oscillator that stick: all impacts before the mass sticks have speed zero. The mass reaches the
    /// stop without speed at the phase at which the force begins to press it there. Without damping, where a flight is
    /// symmetric in time, this occurs at single values of one parameter.
    SoftLanding {
        /// The stop on which the mass lands.
        stop: usize,
        /// The first of these impacts.
        detail: Option<EventDetail>,
    },
    /// The cycle rests on a stop, or a joint holds in it; beyond, no force pulls it off or lets the joint slip for ever.
    RestForEver {
        /// The stop or joint.
        stop: usize,
    },
    /// An inadmissible solution becomes admissible.
    BecomesPhysical,
    /// The cycle becomes inadmissible, on a branch that keeps its signature.
    BecomesVirtual,
    /// The branch is closed: the next point would be the first.
    Closed,
    /// The number reached the end of its range.
    EndOfRange,
    /// The largest number of points was reached.
    StepLimit,
    /// The cycle would have more impacts than allowed.
    ImpactLimit,
    /// No cycle was found further on.
    NoConvergence,
}

/// Where in the cycle of an oscillator an event happens, and how it changes its label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventDetail {
    /// The index of the impact of this point's cycle that disappears, or after which a new one appears, or at which the event
    /// happens; `None` if the cycle has no impacts or the event belongs to none.
    pub impact: Option<usize>,
    /// Phase of the contact.
    pub phase: f64,
    /// Impact and phase of the contact with the other stop.
    pub also: Option<(Option<usize>, f64)>,
    /// The label before, and that after where the event leads to another motion.
    pub labels: (Label, Option<Label>),
}

impl EventDetail {
    /// That of an event that belongs to no impact.
    pub(crate) const fn at(phase: f64, labels: (Label, Option<Label>)) -> Self {
        Self { impact: None, phase, also: None, labels }
    }
}

impl BranchEvent {
    /// Its name in JSON and tables.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::BranchPoint => "branch point",
            Self::Flip => "flip",
            Self::Halving => "halving",
            Self::Torus => "torus",
            Self::Grazing { .. } => "grazing",
            Self::Corner { .. } => "corner",
            Self::Sticking { begins: true, .. } => "sticking begins",
            Self::Sticking { .. } => "sticking ends",
            Self::Holding { begins: true, .. } => "holding begins",
            Self::Holding { .. } => "holding ends",
            Self::Jump => "jump",
            Self::Discontinuity => "discontinuity",
            Self::Change { .. } => "change",
            Self::LossOfContact { .. } => "loss of contact",
            Self::SoftLanding { .. } => "soft landing",
            Self::RestForEver { .. } => "rest for ever",
            Self::BecomesPhysical => "becomes physical",
            Self::BecomesVirtual => "becomes virtual",
            Self::Closed => "closed",
            Self::EndOfRange => "end of range",
            Self::StepLimit => "step limit",
            Self::ImpactLimit => "impact limit",
            Self::NoConvergence => "no convergence",
        }
    }

    /// The stop or joint of the event.
    #[must_use]
    pub const fn place(&self) -> Option<usize> {
        match *self {
            Self::Grazing { stop, .. }
            | Self::Sticking { stop, .. }
            | Self::LossOfContact { stop, .. }
            | Self::SoftLanding { stop, .. }
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

    /// Where in the cycle of an oscillator.
    #[must_use]
    pub const fn detail(&self) -> Option<EventDetail> {
        match *self {
            Self::Grazing { detail, .. }
            | Self::LossOfContact { detail, .. }
            | Self::Sticking { detail, .. }
            | Self::SoftLanding { detail, .. } => detail,
            _ => None,
        }
    }

    /// Whether only the search for the branch ends at this event, and nothing happens to the motion.
    #[must_use]
    pub const fn ends_search(&self) -> bool {
        matches!(
            self,
            Self::Closed
                | Self::EndOfRange
                | Self::StepLimit
                | Self::ImpactLimit
                | Self::Discontinuity
                | Self::NoConvergence
        )
    }

    /// Whether the branch ends at this event.
    #[must_use]
    pub const fn ends(&self) -> bool {
        self.ends_search() || matches!(self, Self::Halving | Self::LossOfContact { .. } | Self::RestForEver { .. })
    }
}
