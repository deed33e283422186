//! A point of a curve in two parameters, the events that are possible there, and the options of a curve.

use crate::orbit::Cycle;

/// The condition that holds along a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveKind {
    /// A multiplier is +1 and the parameters turn back.
    Fold,
    /// A multiplier is -1.
    Flip,
    /// An impact has speed zero.
    Grazing,
}

/// A point of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// Values of the two parameters.
    pub values: (f64, f64),
    /// The cycle; on a grazing curve it includes the impact of speed zero.
    pub cycle: Cycle,
    /// Whether the cycle is admissible (on a grazing curve, apart from that impact; at an event, as a limit of
    /// admissible cycles).
    pub physical: bool,
    /// The event at this point; `None` for an ordinary point.
    pub event: Option<CurveEvent>,
}

/// An event at a point of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CurveEvent {
    /// A fold curve turns back: two folds meet.
    Cusp,
    /// At this grazing impact the multiplier is not infinite: the trace of the derivative over one cycle is zero, and
    /// curves of folds and flips end on the grazing curve. Without damping, for 1/n, this is where
    /// $`\sin(2\pi n/\beta) = 0`$.
    ResonantGrazing,
    /// A second impact has speed zero, or another flight grazes a stop.
    DoubleGrazing,
    /// The mass grazes the stop without acceleration: $`\sin\theta = \delta`$. Such a solution is inadmissible, because
    /// its distance from the stop is $`\beta\cos\theta\,t^3/6`$ to leading order, so it is beyond the stop on one side
    /// of the contact, except if $`\cos\theta = 0`$ and $`\delta = 1`$. The event occurs on curves of inadmissible
    /// solutions.
    DegenerateGrazing,
    /// On a curve of folds or flips a flight grazes a stop: beyond, the cycles on the curve are inadmissible.
    Touch,
    /// A fold curve ends on the curve of flips of the cycle of half the period. On one side of this point the doubled
    /// cycle begins at these flips, on the other side it ends there. Extrapolated, accurate to about 1e-7.
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
    /// Both multipliers are -1. This needs a determinant of 1: restitution 1 and no damping.
    OneToTwo,
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
    /// Its name in tables.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Cusp => "cusp",
            Self::ResonantGrazing => "resonant grazing",
            Self::DoubleGrazing => "double grazing",
            Self::DegenerateGrazing => "degenerate grazing",
            Self::Touch => "touch",
            Self::DegenerateFlip => "degenerate flip",
            Self::LossOfContact => "loss of contact",
            Self::WholePeriods => "whole periods",
            Self::Unbounded => "speeds without bound",
            Self::OneToTwo => "1:2",
            Self::Closed => "closed",
            Self::EndOfBox => "end of box",
            Self::StepLimit => "step limit",
            Self::NoConvergence => "no convergence",
        }
    }
}

/// Step length and limit of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveOptions {
    /// The longest step: phases in radians, speeds, and parameters in quarters of their ranges.
    pub longest: f64,
    /// The largest number of points.
    pub points: u32,
}

impl Default for CurveOptions {
    /// Steps up to 0.05, 20 000 points.
    fn default() -> Self {
        Self { longest: 0.05, points: 20_000 }
    }
}
