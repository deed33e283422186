//! A point of a curve in two parameters, what may happen there, and how a curve is followed.

use crate::orbit::Cycle;

/// What holds along a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveKind {
    /// A multiplier is +1 and the parameters turn.
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
    /// The cycle; on a grazing curve with the impact of speed zero in it.
    pub cycle: Cycle,
    /// Whether it is a possible motion (on a grazing curve, apart from that impact; at an event, the limit of motions).
    pub physical: bool,
    /// What happens here; `None` for an ordinary point.
    pub event: Option<CurveEvent>,
}

/// What happens at a point of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CurveEvent {
    /// A fold curve comes back on itself: two folds meet.
    Cusp,
    /// A grazing impact without the infinite multiplier: the trace of the linearised turn is zero, and curves of folds
    /// and flips end on the grazing curve. Without damping, for 1/n, where $`\sin(2\pi n/\beta) = 0`$.
    ResonantGrazing,
    /// A second impact has speed zero, or another flight touches a stop.
    DoubleGrazing,
    /// The mass touches with no acceleration: $`\sin\theta = \delta`$. No motion does, for its path goes on like
    /// $`\beta\cos\theta\,t^3/6`$, beyond the stop on one side of the touch; that needs $`\cos\theta = 0`$ and $`\delta = 1`$. Such
    /// points lie on the curves of inadmissible solutions.
    DegenerateGrazing,
    /// A flight of a cycle at a fold or a flip touches a stop: beyond, the curve is not one of motions.
    Touch,
    /// A fold curve ends on the curve of flips of the cycle of half the period: on one side of this point the doubled
    /// cycle is born there, on the other it ends. Extrapolated, right to about 1e-7.
    DegenerateFlip,
    /// All speeds vanish: a grazing curve of a longer cycle ends on that of the motion without impacts, or the impacts of a
    /// fold curve come together where two natural periods go into one of the force (right to about 1e-6 there).
    LossOfContact,
    /// One impact, no damping, and whole natural periods in the periods of the force: the mass is back on the stop whatever
    /// its speed, and the equations are singular. The curve goes no further; the frequency is exact, the other parameter
    /// right to about 1e-7.
    WholePeriods,
    /// Nothing is lost any more at impacts, restitution having come to 1 without damping, and speeds grow beyond all bounds.
    /// The restitution is exact, the other parameter extrapolated to speeds without end, right to about 1e-4 of its range;
    /// the phases and speeds are those of the last cycle found.
    Unbounded,
    /// Both multipliers are -1, which takes a determinant of 1: restitution 1 and no damping.
    OneToTwo,
    /// The curve closed.
    Closed,
    /// The edge of the box.
    EndOfBox,
    /// The most points were reached.
    StepLimit,
    /// The curve was lost, for no reason known here.
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

/// How a curve is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveOptions {
    /// The longest step: phases in radians, speeds, and parameters in quarters of their ranges.
    pub longest: f64,
    /// The most points.
    pub points: u32,
}

impl Default for CurveOptions {
    /// Steps up to 0.05, 20 000 points.
    fn default() -> Self {
        Self { longest: 0.05, points: 20_000 }
    }
}
