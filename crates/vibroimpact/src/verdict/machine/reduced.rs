//! Verdicts on a machine that is an oscillator: those on the oscillator, in the numbers of the machine.
//!
//! The oscillator decides, by its own record, budget and bits. A cycle is then closed by the machine from a state between two
//! impacts, so that all its numbers are the machine's own; exponents are those of the oscillator per unit of the machine's time.
//! What the machine would not call the same, and what depends on more than the motion, is left to the machine: a motion without
//! impacts or at rest has a last state, and the limits of the search of the oscillator are not those of the machine.

use super::super::options::SettleOptions;
use super::super::oscillator::NoImpact;
use super::super::outcome::{Chaos, Settled, Undecided, UndecidedCause, Verdict};
use super::outcome::State;
use crate::events;
use crate::events::{Limits, Motion, Place};
use crate::flight::Flight;
use crate::lyapunov::{Measured, Spectrum, Tail};
use crate::machine::{Machine, Reduction};
use crate::motion::ImpactState;
use crate::orbit::machine;
use crate::orbit::{Cycle, MachineFrame, flying};
use crate::system::{Oscillator, Side, Start};

/// The time after a grazing contact at which the state of its motion is given, in units of the oscillator.
const AFTER_GRAZE: f64 = 0.5;

/// What a verdict on the oscillator says of the machine.
#[derive(Clone, Debug)]
pub(super) enum Converted {
    /// This.
    Verdict(Box<Verdict<Machine>>),
    /// The kind of the motion. The rest follows from the machine's own motion from any start that leads to it.
    Kind,
    /// Nothing.
    Unknown,
}

/// A machine that is an oscillator, and the budget of its verdicts.
pub(crate) struct Reduced<'a> {
    machine: &'a Machine,
    reduction: Reduction,
    options: &'a SettleOptions,
}

impl<'a> Reduced<'a> {
    pub(crate) fn new(machine: &'a Machine, options: &'a SettleOptions) -> Option<Self> {
        Some(Self { machine, reduction: machine.reduced()?, options })
    }

    /// The same with the start of the oscillator.
    pub(crate) fn of(machine: &'a Machine, start: &events::Start, options: &'a SettleOptions) -> Option<(Self, Start)> {
        let reduced = Self::new(machine, options)?;
        let from = reduced.start(start)?;
        Some((reduced, from))
    }

    /// The oscillator.
    pub(crate) const fn oscillator(&self) -> &Oscillator {
        &self.reduction.oscillator
    }

    /// The start of the oscillator; `None` for one that says what its contacts do, that has digits of its own, or that is not valid.
    pub(crate) fn start(&self, start: &events::Start) -> Option<Start> {
        let number = |values: &[f64]| match values {
            [] => Some(0.0),
            [one] => Some(*one),
            _ => None,
        };
        if !start.contacts.is_empty() || !start.exact.is_empty() {
            return None;
        }
        self.reduction.start(number(&start.q)?, number(&start.qdot)?, start.phase)
    }

    /// The verdict on the motion from a start from which the oscillator settles so; `None` if the machine decides.
    pub(super) fn settled(&self, settled: &Settled) -> Option<Settled<Machine>> {
        let Converted::Verdict(verdict) = self.converted(&settled.verdict) else { return None };
        Some(Settled {
            verdict: *verdict,
            impacts: settled.impacts,
            time: settled.time * self.time(),
            transient: settled.transient.and_then(|chaos| self.chaos(&chaos)),
        })
    }

    /// What a verdict on the oscillator says of the machine.
    pub(super) fn converted(&self, verdict: &Verdict) -> Converted {
        let found = match verdict {
            Verdict::Periodic(cycle) => self.closed(cycle).map(Verdict::Periodic),
            Verdict::Chaotic(chaos) => self.chaos(chaos).map(Verdict::Chaotic),
            // with fewer impacts the search of long flights has used up its steps
            Verdict::Undecided(of) if of.impacts >= u64::from(self.options.max_impacts) => self.undecided(verdict),
            Verdict::NoImpact(NoImpact::GrazeLimit { phase, .. }) => {
                self.grazing(*phase).map(|place| Verdict::NoImpact(State { place, fades: true }))
            }
            Verdict::Stuck(_) | Verdict::NoImpact(NoImpact::Flight(_)) => return Converted::Kind,
            Verdict::NoImpact(_) | Verdict::Undecided(_) => None,
        };
        found.map_or(Converted::Unknown, |verdict| Converted::Verdict(Box::new(verdict)))
    }

    /// The verdict on a motion that was measured, whatever the budget was.
    pub(crate) fn measured(&self, verdict: &Verdict) -> Option<Verdict<Machine>> {
        match self.converted(verdict) {
            Converted::Verdict(verdict) => Some(*verdict),
            Converted::Kind | Converted::Unknown => self.undecided(verdict),
        }
    }

    /// The verdict on a motion that is undecided after some impacts.
    fn undecided(&self, verdict: &Verdict) -> Option<Verdict<Machine>> {
        let Verdict::Undecided(Undecided { why: UndecidedCause::Budget, impacts, spectrum }) = verdict else {
            return None;
        };
        Some(Verdict::Undecided(Undecided {
            why: UndecidedCause::Budget,
            impacts: *impacts,
            spectrum: spectrum.map(|spectrum| self.in_time(&spectrum)),
        }))
    }

    /// Chaos of the oscillator.
    fn chaos(&self, Chaos { spectrum, impacts, tail }: &Chaos) -> Option<Chaos<Machine>> {
        let state = |at: ImpactState| Some(State::of(&self.place(at.rebound(self.oscillator()))?));
        let tail = Tail { from: state(tail.from)?, last: state(tail.last)?, impacts: tail.impacts };
        Some(Chaos { spectrum: self.in_time(spectrum), impacts: *impacts, tail })
    }

    /// The cycle of the oscillator, closed by the machine; `None` if the machine gives it another label.
    fn closed(&self, cycle: &Cycle) -> Option<machine::Cycle> {
        let from = self.place(flying(self.oscillator(), cycle)?)?;
        let found = machine::Cycle::near(&MachineFrame::new(self.machine), &from, cycle.label.periods)?;
        (found.label == cycle.label).then_some(found)
    }

    /// A state of the motion that grazes the stop at a phase, to which ever gentler impacts tend; `None` with two stops, of which
    /// the limit does not say which.
    fn grazing(&self, phase: f64) -> Option<Place> {
        let osc = self.oscillator();
        if osc.stop(Side::Lower).is_some() {
            return None;
        }
        let flight = Flight::new(osc, Start { x: osc.gap(), v: 0.0, phase });
        let (x, v) = flight.state(AFTER_GRAZE);
        self.place(Start { x, v, phase: flight.phase_at(AFTER_GRAZE) })
    }

    /// The state of the machine at one of the oscillator.
    fn place(&self, at: Start) -> Option<Place> {
        let (q, qdot, phase) = self.reduction.state(at);
        let start = events::Start { q: vec![q], qdot: vec![qdot], phase, ..events::Start::default() };
        Some(Motion::new(self.machine, &start, Limits::default()).ok()?.place().clone())
    }

    /// The unit of the oscillator's time in that of the machine.
    pub(crate) fn time(&self) -> f64 {
        self.reduction.time()
    }

    /// Exponents per unit of the machine's time.
    fn in_time(&self, Spectrum { exponents, impact_rate, time }: &Spectrum) -> Spectrum<Vec<Measured>> {
        let rate = |of: &Measured| Measured { value: of.value / self.time(), error: of.error / self.time() };
        Spectrum {
            exponents: exponents.iter().map(rate).collect(),
            impact_rate: rate(impact_rate),
            time: time * self.time(),
        }
    }
}
