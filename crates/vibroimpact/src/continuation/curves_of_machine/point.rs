//! A point of a curve of a machine, and the events that are possible there.

use crate::orbit::MachineCycle;

/// The condition that holds along a curve. Stops and joints are given by their place: joints are counted after the stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MachineCurveKind {
    /// A multiplier is +1 and the numbers turn.
    Fold,
    /// A multiplier is -1.
    Flip,
    /// A pair of complex multipliers lies on the unit circle.
    Torus,
    /// The gap of a stop closes and opens again with speed zero.
    Grazing {
        /// The stop.
        stop: usize,
    },
    /// Two events happen at the same time.
    Corner {
        /// The one that comes first in the signature that is followed.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A rest on a stop begins or ends to be a part of the cycle.
    Sticking {
        /// The stop.
        stop: usize,
    },
    /// A friction joint begins or ends to hold in the cycle.
    Holding {
        /// The joint.
        joint: usize,
    },
}

impl MachineCurveKind {
    /// Its name in plans and tables.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Flip => "flip",
            Self::Torus => "torus",
            Self::Grazing { .. } => "grazing",
            Self::Corner { .. } => "corner",
            Self::Sticking { .. } => "sticking",
            Self::Holding { .. } => "holding",
        }
    }
}

/// A point of a curve.
#[derive(Clone, Debug)]
pub struct MachineCurvePoint {
    /// Values of the two numbers.
    pub values: (f64, f64),
    /// The cycle there. On a curve of grazing it is the one without the contact, which is also the limit of the one with
    /// it. Its multipliers on a curve of corners are those of one order of the two events, and on a curve of sticking or
    /// holding those of the cycle without the rest that takes no time.
    pub cycle: MachineCycle,
    /// By how much the condition fails: the distance of a multiplier from +1 or -1, or of its modulus from 1; the speed at
    /// the touch divided by the largest velocity; the difference of both phases at a corner; of
    /// sticking or holding what is missing to the limit, divided by the size of its terms, or the rate of what is touched, or of a
    /// chatter that is complete at its release by how much the ratio of speed and acceleration of its last impacts fails.
    pub residual: f64,
    /// The phase of the touch on a curve of grazing of a machine with forcing.
    pub touch: Option<f64>,
    /// The event at this point; `None` for an ordinary point.
    pub event: Option<MachineCurveEvent>,
}

/// An event at a point of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MachineCurveEvent {
    /// A curve of folds turns back: two folds meet.
    Cusp,
    /// A multiplier is +1 and another is -1.
    FoldFlip,
    /// Two multipliers are +1. A curve of torus bifurcations ends here on a curve of folds.
    OneToOne,
    /// Two multipliers are -1. A curve of torus bifurcations ends here on a curve of flips.
    OneToTwo,
    /// On a curve of torus bifurcations, the multipliers are third roots of 1.
    OneToThree,
    /// On a curve of torus bifurcations, the multipliers are fourth roots of 1.
    OneToFour,
    /// A multiplier is +1 and a pair of complex ones lies on the unit circle.
    FoldTorus,
    /// A multiplier is -1 and a pair of complex ones lies on the unit circle.
    FlipTorus,
    /// On a curve of grazing, a multiplier of the cycle without the contact is +1.
    FoldGrazing,
    /// On a curve of grazing, a multiplier of the cycle without the contact is -1.
    FlipGrazing,
    /// On a curve of grazing, a pair of complex multipliers of the cycle without the contact lies on the unit circle.
    TorusGrazing,
    /// On a curve of grazing of a rigid stop, the multiplier of the cycle with the impact is not infinite; or on another
    /// curve, the speed of an impact with a rigid stop has become zero, and the curve ends on a curve of grazing.
    ResonantGrazing {
        /// The stop.
        stop: usize,
    },
    /// At the touch, the second derivative of the gap is zero. The curve ends.
    DegenerateGrazing {
        /// The stop.
        stop: usize,
    },
    /// On a curve of sticking or holding, the rate of the limit is zero too: beyond, the contact leaves its rest before or
    /// after the event instead. The curve ends.
    DegenerateRest {
        /// The stop or joint.
        place: usize,
    },
    /// On a curve of grazing, a second closing has speed zero. The curve ends.
    DoubleGrazing {
        /// The stop of the second one.
        stop: usize,
    },
    /// On another curve, a stop is grazed: beyond, the cycle has another closing or one closing less. The curve ends.
    Touch {
        /// The stop.
        stop: usize,
    },
    /// Two other events happen at the same time. The curve ends.
    Corner {
        /// The one that came first.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A rest on a stop, or a joint that holds, begins or ends to be a part of the cycle. The curve ends.
    Rest {
        /// The stop or joint.
        place: usize,
    },
    /// Another change of the sequence of events. The curve ends.
    Change {
        /// The stop or joint at which the sequence first differs, if it is known.
        place: Option<usize>,
    },
    /// Both halves of the cycle become equal: a curve of folds ends on the curve of flips of the cycle of half the period. The
    /// point is the last one from which a step converges.
    DegenerateFlip,
    /// The curve is closed.
    Closed,
    /// The curve reached an edge of the frame.
    EndOfBox,
    /// The largest number of points was reached.
    StepLimit,
    /// No step down to the smallest length converged, and no reason is known.
    NoConvergence,
}

impl MachineCurveEvent {
    /// Its name in JSON and tables.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Cusp => "cusp",
            Self::FoldFlip => "fold-flip",
            Self::OneToOne => "1:1",
            Self::OneToTwo => "1:2",
            Self::OneToThree => "1:3",
            Self::OneToFour => "1:4",
            Self::FoldTorus => "fold-torus",
            Self::FlipTorus => "flip-torus",
            Self::FoldGrazing => "fold-grazing",
            Self::FlipGrazing => "flip-grazing",
            Self::TorusGrazing => "torus-grazing",
            Self::ResonantGrazing { .. } => "resonant grazing",
            Self::DegenerateGrazing { .. } => "degenerate grazing",
            Self::DegenerateRest { .. } => "degenerate rest",
            Self::DoubleGrazing { .. } => "double grazing",
            Self::Touch { .. } => "touch",
            Self::Corner { .. } => "corner",
            Self::Rest { .. } => "rest",
            Self::Change { .. } => "change",
            Self::DegenerateFlip => "degenerate flip",
            Self::Closed => "closed",
            Self::EndOfBox => "end of box",
            Self::StepLimit => "step limit",
            Self::NoConvergence => "no convergence",
        }
    }

    /// The stop or joint of the event.
    #[must_use]
    pub const fn place(&self) -> Option<usize> {
        match *self {
            Self::ResonantGrazing { stop }
            | Self::DegenerateGrazing { stop }
            | Self::DoubleGrazing { stop }
            | Self::Touch { stop } => Some(stop),
            Self::Corner { first, .. } => Some(first),
            Self::Rest { place } | Self::DegenerateRest { place } => Some(place),
            Self::Change { place } => place,
            _ => None,
        }
    }
}
