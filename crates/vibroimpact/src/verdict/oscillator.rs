//! What is particular to verdicts on an oscillator.

use super::outcome::{System, UndecidedCause, Verdict};
use crate::flight::Horizon;
use crate::lyapunov::Measured;
use crate::math::Multiplier;
use crate::motion::ImpactState;
use crate::orbit::{Cycle, Label, Stability, rounding};
use crate::system::{Oscillator, Side};
use core::f64::consts::TAU;

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
            Self::Undecided(of) => match of.why {
                UndecidedCause::Budget => Reason::Impacts,
                UndecidedCause::Search { .. } | UndecidedCause::Ended(_) => Reason::SearchLimit,
                UndecidedCause::Unconfirmed => Reason::Unconfirmed,
            },
        }
    }

    /// The Floquet multipliers of a cycle, or of the motion without impacts over one forcing period,
    /// $`e^{(-\zeta \pm i\sqrt{1-\zeta^2})2\pi/\beta}`$; `None` for other motions.
    #[must_use]
    pub fn multipliers(&self, osc: &Oscillator) -> Option<[Multiplier; 2]> {
        match self {
            Self::Periodic(cycle) => Some(cycle.multipliers),
            // the rest in each period forgets all differences
            Self::NoImpact(NoImpact::Landing { .. }) => Some([Multiplier::default(); 2]),
            Self::NoImpact(_) => {
                // the free oscillation over one forcing period: the trace of its matrix is 2 e^(-zeta T) cos(omega_d
                // T), and the determinant e^(-2 zeta T)
                let p = osc.response().at(TAU / osc.beta());
                let trace = 2.0 * (p.c - osc.damping() * p.s);
                Some(crate::math::eigenvalues(trace, crate::math::exp(-2.0 * osc.damping() * osc.period())))
            }
            // neighbouring motions that stick are the same motion
            Self::Stuck(_) => Some([Multiplier::default(); 2]),
            Self::Chaotic(_) | Self::Undecided(_) => None,
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
}

impl System for Oscillator {
    type Cycle = Cycle;
    type NoImpact = NoImpact;
    type Place = Side;
    type State = ImpactState;
    type Exponents = [Measured; 2];

    fn label(cycle: &Cycle) -> Label {
        cycle.label
    }

    fn same_cycle(a: &Cycle, b: &Cycle, tolerance: f64) -> bool {
        a.same_as(b, tolerance)
    }

    fn same_without_impact(a: &NoImpact, b: &NoImpact) -> bool {
        // only landings differ by their stop; in all others the mass touches none
        let landing = |of: &NoImpact| match of {
            NoImpact::Landing { side, .. } => Some(*side),
            _ => None,
        };
        landing(a) == landing(b)
    }

    fn same_place(a: &Side, b: &Side) -> bool {
        a == b
    }

    fn stability(&self, verdict: &Verdict) -> Option<Stability> {
        match verdict {
            Verdict::Periodic(cycle) => Some(cycle.stability()),
            // the worst direction decides
            _ => verdict.stabilities(self).and_then(|each| each.into_iter().max()),
        }
    }
}
