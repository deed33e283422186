//! What holds along a curve in two numbers, and the events that are possible on it, of any system.

/// The condition that holds along a curve. Stops and joints are given by their place: joints are counted after the stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CurveKind {
    /// A multiplier is +1 and the numbers turn.
    Fold,
    /// A multiplier is -1.
    Flip,
    /// A pair of complex multipliers lies on the unit circle.
    Torus,
    /// A stop is grazed: an impact has speed zero, or the gap closes and opens again with speed zero.
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

impl CurveKind {
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

/// An event at a point of a curve. Stops and joints are given by their place: joints are counted after the stops. The stops of an
/// oscillator are the upper one and the lower one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CurveEvent {
    /// A curve of folds turns back: two folds meet.
    Cusp,
    /// A multiplier is +1 and another is -1.
    FoldFlip,
    /// Two multipliers are +1. A curve of torus bifurcations ends here on a curve of folds.
    OneToOne,
    /// Two multipliers are -1. A curve of torus bifurcations ends here on a curve of flips. For an oscillator this needs a
    /// determinant of 1: restitution 1 and no damping.
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
    /// On a curve of grazing of a rigid stop, the multiplier of the cycle with the impact is not infinite: the trace of the
    /// derivative over one cycle is zero, and curves of folds and flips end on the grazing curve. For the orbits 1/n of an
    /// oscillator without damping, this is where $`\sin(2\pi n/\beta) = 0`$. On another curve, the speed of an impact with a
    /// rigid stop has become zero, and the curve ends on a curve of grazing.
    ResonantGrazing {
        /// The stop.
        stop: usize,
    },
    /// A stop is grazed without acceleration: the second derivative of the gap is zero. On a curve of a machine, the curve ends.
    ///
    /// For an oscillator $`\sin\theta = \delta`$ there. Such a solution is inadmissible, because its distance from the stop is
    /// $`\beta\cos\theta\,t^3/6`$ to leading order, so it is beyond the stop on one side of the contact, except if
    /// $`\cos\theta = 0`$ and $`\delta = 1`$. The event occurs on curves of inadmissible solutions.
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
    /// On a curve of grazing, a second impact has speed zero, or another flight grazes a stop. On a curve of a machine, the curve
    /// ends.
    DoubleGrazing {
        /// The stop of the second one.
        stop: usize,
    },
    /// On another curve, a flight grazes a stop: beyond, the cycles of the curve are inadmissible. On a curve of a machine, the
    /// curve ends.
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
    /// Both halves of the cycle become equal: a curve of folds ends on the curve of flips of the cycle of half the period. On one
    /// side of this point the doubled cycle begins at these flips, on the other side it ends there. For an oscillator it is
    /// extrapolated, accurate to about 1e-7; for a machine it is the last point from which a step converges.
    DegenerateFlip,
    /// All speeds vanish. A grazing curve of a longer cycle ends on that of the motion without impacts, or the impacts
    /// of a fold curve coincide where the forcing period is two natural periods (accurate to about 1e-6 there).
    LossOfContact,
    /// One impact, no damping, and a whole number of natural periods in the forcing periods of the cycle. The mass
    /// returns to the stop whatever its speed, and the equations are singular, so the curve ends. The frequency ratio
    /// is exact, the other parameter accurate to about 1e-7.
    WholePeriods,
    /// The restitution is 1 without damping, so no energy is lost, and the speeds increase without bound. The
    /// restitution is exact. The other parameter is extrapolated to infinite speeds and is accurate to about 1e-4 of
    /// its range. The phases and speeds are those of the last cycle on the curve.
    Unbounded,
    /// The curve is closed.
    Closed,
    /// The curve reached an edge of the frame.
    EndOfBox,
    /// The largest number of points was reached.
    StepLimit,
    /// No step down to the smallest length converged, and no reason is known.
    NoConvergence,
}

impl CurveEvent {
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
            Self::LossOfContact => "loss of contact",
            Self::WholePeriods => "whole periods",
            Self::Unbounded => "speeds without bound",
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

    /// The other stop or joint of a corner, if it is another one.
    #[must_use]
    pub const fn also(&self) -> Option<usize> {
        match *self {
            Self::Corner { first, second } if first != second => Some(second),
            _ => None,
        }
    }
}
