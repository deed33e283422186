//! The possible verdicts on a motion.

use crate::flight::Horizon;
use crate::lyapunov::Spectrum;
use crate::math::Multiplier;
use crate::orbit::{Cycle, Stability, rounding};
use crate::system::{Oscillator, Side};
use core::f64::consts::TAU;
use std::borrow::Cow;

/// The verdict on a motion. None of these is an error.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// A periodic motion with impacts, confirmed by Newton's method, or by a release, which determines the motion after
    /// it.
    Periodic(Cycle),
    /// No more impacts, and the reason.
    NoImpact(NoImpact),
    /// A chaotic motion: the largest Lyapunov exponent exceeds its error bar over the impacts that were followed.
    Chaotic(Chaos),
    /// The mass sticks on a stop for ever.
    Stuck(Side),
    /// None of these could be shown within the budget.
    Undecided(Undecided),
}

/// Measured chaos, and the number of impacts over which it was seen.
///
/// Chaos can be a transient, which no finite observation excludes. This number is a lower bound of its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chaos {
    /// The Lyapunov exponents.
    pub spectrum: Spectrum,
    /// The number of impacts from the start of the motion over which no cycle, no second sticking on a stop and no
    /// fading of the impacts was found; for a transient, the number of impacts until it had ended.
    pub impacts: u64,
}

/// The reason why there are no more impacts, and for how long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoImpact {
    /// The flight never reaches a stop again, for the reason given. For ever.
    Flight(Horizon),
    /// Ever gentler impacts, each at the same phase and slower than the one before by the restitution. In the limit the
    /// motion grazes the stop without an impact. For ever.
    GrazeLimit {
        /// Impact speed at which the limit was recognised.
        velocity: f64,
        /// Phase of the contact.
        phase: f64,
    },
    /// The mass sticks, is released when the force changes sign, and lands on the stop again without speed. For ever,
    /// without an impact ([`landing`](crate::contact::landing)).
    Landing {
        /// The stop.
        side: Side,
        /// Forcing periods from one release to the next.
        periods: u32,
    },
    /// The mass grazes the stop again and again. For ever, to rounding.
    Grazing {
        /// Phase of the last contact.
        phase: f64,
    },
    /// No impact for at least this number of forcing periods; nothing is known beyond.
    ForPeriods(f64),
}

impl NoImpact {
    /// The number of forcing periods without an impact; infinite for "for ever".
    #[must_use]
    pub const fn periods(&self) -> f64 {
        match self {
            Self::ForPeriods(n) => *n,
            _ => f64::INFINITY,
        }
    }
}

/// Why a motion is undecided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Undecided {
    /// No cycle was found after this number of impacts, and the Lyapunov exponent does not exclude 0.
    Impacts {
        /// Impacts followed.
        impacts: u64,
        /// The Lyapunov exponents of the last measurement; `None` if there was none.
        spectrum: Option<Spectrum>,
    },
    /// The motion returns to a release from a stop, so it is periodic, but the rounding errors between two releases grow so
    /// much that they decide its period.
    Unconfirmed {
        /// Impacts followed.
        impacts: u64,
    },
    /// A flight was followed for this number of forcing periods, too few to conclude that there are no more impacts.
    Search {
        /// Forcing periods without contact.
        periods: f64,
    },
}

/// Why a verdict holds, without its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reason {
    /// Newton's method, or a release, has confirmed a cycle.
    Cycle,
    /// The largest Lyapunov exponent exceeds its error bar.
    Exponent,
    /// The force never pulls the mass off the stop.
    Stuck,
    /// The amplitude of the flight does not reach a stop.
    Amplitude,
    /// The flight does not reach a stop in the common period of the force and the free oscillation.
    CommonPeriod,
    /// The impacts become gentler without end.
    GrazeLimit,
    /// Each release leads to a landing without speed.
    Landing,
    /// The mass grazes the stop again and again.
    Grazing,
    /// There is no impact in the longest flight that is searched.
    Search,
    /// Undecided within the budget of impacts.
    Impacts,
    /// Undecided within the budget of a search.
    SearchLimit,
    /// It is periodic, and rounding errors decide its period.
    Unconfirmed,
}

impl Reason {
    /// All reasons.
    pub const ALL: [Self; 12] = [
        Self::Cycle,
        Self::Exponent,
        Self::Stuck,
        Self::Amplitude,
        Self::CommonPeriod,
        Self::GrazeLimit,
        Self::Landing,
        Self::Grazing,
        Self::Search,
        Self::Impacts,
        Self::SearchLimit,
        Self::Unconfirmed,
    ];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cycle => "cycle",
            Self::Exponent => "exponent",
            Self::Stuck => "stuck",
            Self::Amplitude => "amplitude",
            Self::CommonPeriod => "common_period",
            Self::GrazeLimit => "graze_limit",
            Self::Landing => "landing",
            Self::Grazing => "grazing",
            Self::Search => "search",
            Self::Impacts => "impact_budget",
            Self::SearchLimit => "search_budget",
            Self::Unconfirmed => "unconfirmed",
        }
    }
}

impl Verdict {
    /// Why it holds.
    #[must_use]
    pub const fn reason(&self) -> Reason {
        match self {
            Self::Periodic(_) => Reason::Cycle,
            Self::Chaotic(_) => Reason::Exponent,
            Self::Stuck(_) => Reason::Stuck,
            Self::NoImpact(NoImpact::Flight(Horizon::Amplitude)) => Reason::Amplitude,
            Self::NoImpact(NoImpact::Flight(Horizon::CommonPeriod { .. })) => Reason::CommonPeriod,
            Self::NoImpact(NoImpact::GrazeLimit { .. }) => Reason::GrazeLimit,
            Self::NoImpact(NoImpact::Landing { .. }) => Reason::Landing,
            Self::NoImpact(NoImpact::Grazing { .. }) => Reason::Grazing,
            Self::NoImpact(NoImpact::ForPeriods(_)) => Reason::Search,
            Self::Undecided(Undecided::Impacts { .. }) => Reason::Impacts,
            Self::Undecided(Undecided::Search { .. }) => Reason::SearchLimit,
            Self::Undecided(Undecided::Unconfirmed { .. }) => Reason::Unconfirmed,
        }
    }

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

    /// The Floquet multipliers of a cycle, or of the motion without impacts over one forcing period,
    /// $`e^{(-\zeta \pm i\sqrt{1-\zeta^2})2\pi/\beta}`$; `None` for other motions.
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
            // neighbouring motions that stick are the same motion
            Self::Stuck(_) => Some([Multiplier::default(); 2]),
            Self::Chaotic(_) | Self::Undecided(_) => None,
        }
    }

    /// Whether neighbours approach the motion; `None` if it is undecided. Motions without impacts and without damping are
    /// neutral.
    #[must_use]
    pub fn stability(&self, osc: &Oscillator) -> Option<Stability> {
        match self {
            Self::Periodic(cycle) => Some(cycle.stability()),
            Self::NoImpact(_) | Self::Stuck(_) => self.stabilities(osc).and_then(|each| each.into_iter().max()),
            Self::Chaotic(_) => Some(Stability::Unstable),
            Self::Undecided(_) => None,
        }
    }

    /// The same for the direction of each of its [multipliers](Self::multipliers).
    #[must_use]
    pub fn stabilities(&self, osc: &Oscillator) -> Option<Vec<Stability>> {
        match self {
            Self::Periodic(cycle) => Some(cycle.stabilities()),
            _ => self.multipliers(osc).map(|all| Stability::each(&all, rounding(1, 1.0)).collect()),
        }
    }

    /// Whether both are the same motion: cycles are compared to within `tolerance`, all others by their kind.
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
