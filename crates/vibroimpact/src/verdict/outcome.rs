//! The possible verdicts on a motion, of an oscillator or of a machine.

use crate::events::End;
use crate::lyapunov::{Measured, Spectrum, Tail};
use crate::orbit::{Label, Stability};
use crate::system::Oscillator;
use core::fmt::Debug;
use std::borrow::Cow;

/// A system whose motions are settled: an [`Oscillator`], or a [`Machine`](crate::machine::Machine). It says what verdicts on its
/// motions consist of.
pub trait System: Clone + Debug + PartialEq {
    /// A periodic motion.
    type Cycle: Clone + Debug + PartialEq;
    /// What is known of a motion without a further impact.
    type NoImpact: Clone + Debug + PartialEq;
    /// Where it sticks for ever.
    type Place: Clone + Debug + PartialEq;
    /// A state from which a motion can be followed again.
    type State: Clone + Debug + PartialEq;
    /// A measured number for each of its Lyapunov exponents.
    type Exponents: AsRef<[Measured]> + Clone + Debug + PartialEq;

    /// The label of a cycle.
    fn label(cycle: &Self::Cycle) -> Label;
    /// Whether two cycles are the same to within `tolerance`.
    fn same_cycle(a: &Self::Cycle, b: &Self::Cycle, tolerance: f64) -> bool;
    /// Whether two motions without a further impact are the same.
    fn same_without_impact(a: &Self::NoImpact, b: &Self::NoImpact) -> bool;
    /// Whether two motions stick in the same way.
    fn same_place(a: &Self::Place, b: &Self::Place) -> bool;
    /// The stability of a motion that is periodic, has no further impact, or sticks for ever; `None` for others, and where it is not
    /// known.
    fn stability(&self, verdict: &Verdict<Self>) -> Option<Stability>;
}

/// The verdict on a motion. None of these is an error.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict<S: System = Oscillator> {
    /// A periodic motion with impacts, confirmed by Newton's method, or by a release, which determines the motion after
    /// it. It captures the motion: it is stable, or neutral with the motion on it to rounding, or unstable and not left, as an exactly
    /// symmetric motion.
    Periodic(S::Cycle),
    /// No more impacts, and what is known of the motion; of a machine, no further event.
    NoImpact(S::NoImpact),
    /// A chaotic motion: the largest Lyapunov exponent exceeds its error bar over the impacts that were followed.
    Chaotic(Chaos<S>),
    /// It sticks on a stop for ever.
    Stuck(S::Place),
    /// None of these could be shown within the budget.
    Undecided(Undecided<S>),
}

/// Measured chaos, and the number of impacts over which it was seen.
///
/// Chaos can be a transient, which no finite observation excludes. This number is a lower bound of its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chaos<S: System = Oscillator> {
    /// The Lyapunov exponents.
    pub spectrum: Spectrum<S::Exponents>,
    /// The number of impacts from the start of the motion over which no cycle, no second sticking on a stop and no
    /// fading of the impacts was found; for a transient, the number of impacts until it had ended. A machine that is followed itself
    /// counts events.
    pub impacts: u64,
    /// The last of them, over which quantities are measured.
    pub tail: Tail<S::State>,
}

/// Why a motion is undecided, and how far it was followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undecided<S: System = Oscillator> {
    /// Why.
    pub why: UndecidedCause,
    /// Impacts followed; of a machine that is followed itself, events.
    pub impacts: u64,
    /// The Lyapunov exponents of the last measurement; `None` if there was none.
    pub spectrum: Option<Spectrum<S::Exponents>>,
}

/// Why a motion is undecided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UndecidedCause {
    /// The number of impacts or events is used up: no cycle was found, and the Lyapunov exponent does not exclude 0.
    Budget,
    /// The motion returns to a release from a stop, so it is periodic, but the rounding errors between two releases grow so
    /// much that they decide its period.
    Unconfirmed,
    /// A flight of an oscillator was followed for this number of forcing periods, too few to conclude that there are no more impacts.
    Search {
        /// Forcing periods without contact.
        periods: f64,
    },
    /// The motion of a machine ended for this reason.
    Ended(End),
}

/// A verdict and how far the motion was followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled<S: System = Oscillator> {
    /// The verdict.
    pub verdict: Verdict<S>,
    /// The number of impacts that were followed; of a machine that is followed itself, of events.
    pub impacts: u64,
    /// The time that was followed.
    pub time: f64,
    /// Chaos that was measured and has ended. It belongs to this start; other starts that lead to the same motion have
    /// their own.
    pub transient: Option<Chaos<S>>,
}

impl<S: System> Verdict<S> {
    /// The label of the motion as text: `4/1`, `inf/1`, `0`, `chaotic`, `stuck`, `undecided`.
    #[must_use]
    pub fn label(&self) -> Cow<'static, str> {
        match self {
            Self::Periodic(cycle) => Cow::Owned(S::label(cycle).to_string()),
            Self::NoImpact(_) => Cow::Borrowed("0"),
            Self::Chaotic(_) => Cow::Borrowed("chaotic"),
            Self::Stuck(_) => Cow::Borrowed("stuck"),
            Self::Undecided(_) => Cow::Borrowed("undecided"),
        }
    }

    /// Whether neighbours approach the motion; `None` if it is undecided. Motions of an oscillator without impacts and without
    /// damping are neutral. Of a machine that comes to no further event it is that of the structure in its last regime, in which a
    /// joint that holds keeps its place: there are rests on both sides of it.
    #[must_use]
    pub fn stability(&self, system: &S) -> Option<Stability> {
        match self {
            Self::Chaotic(_) => Some(Stability::Unstable),
            Self::Undecided(_) => None,
            Self::Periodic(_) | Self::NoImpact(_) | Self::Stuck(_) => system.stability(self),
        }
    }

    /// Whether both are the same motion: cycles are compared to within `tolerance`, all others by their kind.
    #[must_use]
    pub fn same_as(&self, other: &Self, tolerance: f64) -> bool {
        match (self, other) {
            (Self::Periodic(a), Self::Periodic(b)) => S::same_cycle(a, b, tolerance),
            (Self::Stuck(a), Self::Stuck(b)) => S::same_place(a, b),
            (Self::NoImpact(a), Self::NoImpact(b)) => S::same_without_impact(a, b),
            (Self::Chaotic(_), Self::Chaotic(_)) | (Self::Undecided(_), Self::Undecided(_)) => true,
            _ => false,
        }
    }

    /// The exponents that were measured for the verdict; `None` for a motion that was decided without.
    #[must_use]
    pub const fn spectrum(&self) -> Option<&Spectrum<S::Exponents>> {
        match self {
            Self::Chaotic(chaos) => Some(&chaos.spectrum),
            Self::Undecided(undecided) => undecided.spectrum.as_ref(),
            Self::Periodic(_) | Self::NoImpact(_) | Self::Stuck(_) => None,
        }
    }

    /// The number of impacts, or events, over which chaos was seen; `None` unless the motion is chaotic.
    #[must_use]
    pub const fn seen_events(&self) -> Option<u64> {
        if let Self::Chaotic(chaos) = self { Some(chaos.impacts) } else { None }
    }
}
