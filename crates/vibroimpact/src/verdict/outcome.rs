//! What a motion can settle into.

use crate::flight::Horizon;
use crate::lyapunov::Spectrum;
use crate::math::Multiplier;
use crate::orbit::Cycle;
use crate::system::{Oscillator, Side};
use core::f64::consts::TAU;
use std::borrow::Cow;

/// What a motion settles into. None of these is an error.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// A periodic motion with impacts, confirmed by Newton's method (or by a release, which fixes all that follows).
    Periodic(Cycle),
    /// No more impacts, and on what grounds.
    NoImpact(NoImpact),
    /// A chaotic motion: the largest Lyapunov exponent exceeds its error bar for as long as it was followed.
    Chaotic(Chaos),
    /// At rest on a stop for ever.
    Stuck(Side),
    /// None of these could be shown within the budget, and what was tried.
    Undecided(Undecided),
}

/// Chaos as it was seen: what was measured, and for how long the motion was followed without an end of it.
///
/// Chaos may be a transient, which no finite observation excludes: this gives how long it lasted at least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chaos {
    /// The Lyapunov exponents.
    pub spectrum: Spectrum,
    /// Impacts from the start of the motion over which no cycle, no second rest on a stop and no fading of the impacts was found; of a
    /// transient, the impact at which it had ended.
    pub impacts: u64,
}

/// On what grounds there are no more impacts, and how far that reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoImpact {
    /// The flight never touches a stop again: for ever, and why.
    Flight(Horizon),
    /// Ever gentler impacts, each at the same phase and slower by the restitution than the one before: in the limit
    /// a motion that just touches the stop. For ever.
    GrazeLimit {
        /// Impact speed when the limit was recognised.
        velocity: f64,
        /// Phase of the touch.
        phase: f64,
    },
    /// It rests on a stop, leaves it when the force changes sign, and lands on it again without speed: for ever, without an impact
    /// ([`landing`](crate::contact::landing)).
    Landing {
        /// The stop.
        side: Side,
        /// Forcing periods from one release to the next.
        periods: u32,
    },
    /// It touches the stop again and again without speed: for ever, to rounding.
    Grazing {
        /// Phase of the last touch.
        phase: f64,
    },
    /// No impact for at least this many forcing periods; nothing is claimed beyond.
    ForPeriods(f64),
}

impl NoImpact {
    /// The forcing periods for which there is no impact, infinite for "for ever".
    #[must_use]
    pub const fn periods(&self) -> f64 {
        match self {
            Self::ForPeriods(n) => *n,
            _ => f64::INFINITY,
        }
    }
}

/// What was tried before giving up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Undecided {
    /// No cycle was found and the Lyapunov exponent does not exclude 0 after that many impacts.
    Impacts {
        /// Impacts followed.
        impacts: u64,
        /// The Lyapunov exponents of the last stretch, if it had any.
        spectrum: Option<Spectrum>,
    },
    /// A flight was followed for this number of forcing periods, too few to conclude that there are no more impacts.
    Search {
        /// Forcing periods without contact.
        periods: f64,
    },
}

impl Verdict {
    /// The label of the motion as text: `4/1`, `inf/1`, `0`, `chaotic`, `stuck`, `undecided`.
    #[must_use]
    pub fn label(&self) -> Cow<'static, str> {
        match self {
            Self::Periodic(cycle) => Cow::Owned(cycle.label.to_string()),
            Self::NoImpact(_) => Cow::Borrowed("0"),
            Self::Chaotic(_) => Cow::Borrowed("chaotic"),
            Self::Stuck(_) => Cow::Borrowed("stuck"),
            Self::Undecided(_) => Cow::Borrowed("undecided"),
        }
    }

    /// Floquet multipliers where the motion has them: of a cycle, or of the motion without impacts over one forcing
    /// period, $`e^{(-\zeta \pm i\sqrt{1-\zeta^2})2\pi/\beta}`$.
    #[must_use]
    pub fn multipliers(&self, osc: &Oscillator) -> Option<[Multiplier; 2]> {
        match self {
            Self::Periodic(cycle) => Some(cycle.multipliers),
            Self::NoImpact(NoImpact::Landing { .. }) => Some([Multiplier::default(); 2]),
            Self::NoImpact(_) => {
                let p = osc.response().at(TAU / osc.beta());
                let trace = 2.0 * (p.c - osc.damping() * p.s);
                Some(crate::math::eigenvalues(trace, crate::math::exp(-2.0 * osc.damping() * osc.period())))
            }
            // a rest forgets how neighbours differed
            Self::Stuck(_) => Some([Multiplier::default(); 2]),
            Self::Chaotic(_) | Self::Undecided(_) => None,
        }
    }

    /// Whether it attracts its neighbourhood; `None` where that is open (undecided) or neither (undamped motions
    /// without impacts are a continuum that keeps its neighbours at their distance).
    #[must_use]
    pub fn stable(&self, osc: &Oscillator) -> Option<bool> {
        match self {
            Self::Periodic(cycle) => Some(cycle.stable()),
            Self::NoImpact(NoImpact::Landing { .. }) => Some(true),
            Self::NoImpact(_) => (osc.damping() > 0.0).then_some(true),
            Self::Chaotic(_) => Some(false),
            Self::Stuck(_) => Some(true),
            Self::Undecided(_) => None,
        }
    }

    /// Whether both are the same motion: cycles to within `tolerance`, everything else by its kind.
    #[must_use]
    pub fn same_as(&self, other: &Self, tolerance: f64) -> bool {
        match (self, other) {
            (Self::Periodic(a), Self::Periodic(b)) => a.same_as(b, tolerance),
            (Self::Stuck(a), Self::Stuck(b)) => a == b,
            (Self::NoImpact(NoImpact::Landing { side: a, .. }), Self::NoImpact(NoImpact::Landing { side: b, .. })) => {
                a == b
            }
            (Self::NoImpact(NoImpact::Landing { .. }), _) | (_, Self::NoImpact(NoImpact::Landing { .. })) => false,
            (Self::NoImpact(_), Self::NoImpact(_))
            | (Self::Chaotic(_), Self::Chaotic(_))
            | (Self::Undecided(_), Self::Undecided(_)) => true,
            _ => false,
        }
    }
}
