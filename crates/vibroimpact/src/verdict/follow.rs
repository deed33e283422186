//! A motion being followed: what its impacts so far show. [`settle`](super::settle()) says what counts as shown.
//!
//! The events may come from a [`Motion`](crate::motion::Motion) or from the slot of a [`Batch`](crate::lanes::Batch): they are the
//! same bits, and so is the verdict.

use super::outcome::{NoImpact, Undecided, Verdict};
use super::settle::SettleOptions;
use super::{graze_limit, recurrence};
use crate::chaos::{Spectrum, lyapunov};
use crate::flight::SearchLimits;
use crate::motion::{End, ImpactState, MAX_TOUCHES};
use crate::orbit::{Cycle, DEFAULT_EVENTS, from_release, shoot};
use crate::system::{Oscillator, Side};

/// What was seen of a motion.
#[derive(Clone, Debug, Default)]
pub(super) struct Follow {
    /// Each impact and the time since the one before.
    impacts: Vec<(ImpactState, f64)>,
    /// Time since the last impact.
    since: f64,
    /// Releases from each stop.
    released: [u32; 2],
    candidate: Option<Cycle>,
    grazes: u32,
    next_look: usize,
    /// Search steps taken.
    pub(super) steps: u64,
    /// The Lyapunov exponents, once measured; `None` inside: they could not be.
    pub(super) spectrum: Option<Option<Spectrum>>,
}

/// The cycles through a release, which is the same for every motion of an oscillator: each is looked for once in each way.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Releases([[Option<Option<Cycle>>; 2]; 2]);

impl Releases {
    /// After the first release a short cycle is looked for; a long one when the motion itself has come back, because
    /// most motions that rest on their way never do again, and to follow such a one to the end costs far more than it.
    fn cycle(&mut self, osc: &Oscillator, side: Side, again: bool) -> Option<Cycle> {
        let known = &mut self.0[usize::from(side == Side::Lower)][usize::from(again)];
        let events = if again { DEFAULT_EVENTS } else { SHORT };
        known.get_or_insert_with(|| from_release(osc, side, events)).clone()
    }
}

/// Events after a release in which a cycle is short.
const SHORT: u32 = 64;

/// How many times longer the exponents are measured before a divergence too small to tell is left undecided.
const LONGER: u32 = 8;
/// Impacts between looks for a recurrence, while there are few; later an eighth of those there are, so that the looks
/// into a long chaotic motion stay cheap.
const LOOK: usize = 16;
/// Candidates for the period tried at each look.
const TRIES: usize = 3;

impl Follow {
    /// Forgets everything, for another motion.
    pub(super) fn reset(&mut self) {
        let impacts = core::mem::take(&mut self.impacts);
        *self = Self { impacts, ..Self::default() };
        self.impacts.clear();
    }

    /// Impacts seen.
    pub(super) fn count(&self) -> usize {
        self.impacts.len()
    }

    /// Whether the budget allows more.
    pub(super) fn within(&self, options: &SettleOptions) -> bool {
        self.impacts.len() < options.max_impacts as usize && self.steps < options.max_steps
    }

    /// Whether it is time to measure for chaos.
    pub(super) fn wants_measure(&self, options: &SettleOptions) -> bool {
        options.chaos_over > 0 && self.impacts.len() >= options.chaos_after as usize && self.spectrum.is_none()
    }

    /// The last impact; before the first, the stop at rest.
    pub(super) fn last(&self) -> ImpactState {
        let none = ImpactState { phase: 0.0, velocity: 0.0, side: Side::Upper };
        self.impacts.last().map_or(none, |(state, _)| *state)
    }

    /// The next impact, `interval` after the last event.
    pub(super) fn impact(
        &mut self,
        osc: &Oscillator,
        options: &SettleOptions,
        state: ImpactState,
        interval: f64,
    ) -> Option<Verdict> {
        self.impacts.push((state, self.since + interval));
        (self.since, self.grazes) = (0.0, 0);
        if graze_limit::recognised(osc, &self.impacts) {
            return Some(Verdict::NoImpact(NoImpact::GrazeLimit { velocity: state.velocity, phase: state.phase }));
        }
        if self.impacts.len() < self.next_look.max(LOOK) { None } else { self.look(osc, options, state) }
    }

    fn look(&mut self, osc: &Oscillator, options: &SettleOptions, state: ImpactState) -> Option<Verdict> {
        let count = self.impacts.len();
        self.next_look = count + LOOK.max(count / 8);
        if let Some(cycle) = &self.candidate
            && recurrence::captured(osc, &state, cycle)
        {
            return self.candidate.take().map(Verdict::Periodic);
        }
        let found: Vec<(usize, u32)> =
            recurrence::candidates(osc, &self.impacts, options.longest as usize, options.recurrence)
                .take(TRIES)
                .collect();
        for (m, n) in found {
            let Ok(cycle) = shoot(osc, state, u32::try_from(m).unwrap_or(u32::MAX), n) else {
                continue;
            };
            if recurrence::captured(osc, &state, &cycle) {
                return Some(Verdict::Periodic(cycle));
            }
            if cycle.stable() {
                self.candidate = Some(cycle);
                break;
            }
        }
        None
    }

    /// A graze, `interval` after the last event.
    pub(super) fn graze(&mut self, phase: f64, interval: f64) -> Option<Verdict> {
        self.since += interval;
        self.grazes += 1;
        (self.grazes > MAX_TOUCHES).then_some(Verdict::NoImpact(NoImpact::Grazing { phase }))
    }

    /// An event that shows nothing.
    pub(super) fn pass(&mut self, interval: f64) -> Option<Verdict> {
        self.since += interval;
        None
    }

    /// A release decides all that follows: if it leads back to itself, that is the cycle. Looked for after the first two.
    pub(super) fn release(
        &mut self,
        osc: &Oscillator,
        releases: &mut Releases,
        side: Side,
        interval: f64,
    ) -> Option<Verdict> {
        self.since += interval;
        let seen = &mut self.released[usize::from(side == Side::Lower)];
        *seen += 1;
        let again = *seen == 2;
        if *seen > 2 { None } else { releases.cycle(osc, side, again).map(Verdict::Periodic) }
    }

    /// The verdict when the budget is spent: a last look, where the transient is as far gone as it will be.
    pub(super) fn last_look(&self, osc: &Oscillator, options: &SettleOptions) -> Verdict {
        let measured = |impacts: u32| {
            let last = self.impacts.last().filter(|_| impacts > 0);
            last.and_then(|(state, _)| lyapunov(osc, *state, impacts))
        };
        let mut last = measured(options.chaos_over);
        // weak chaos shows in a longer run, and so does a slow transient
        if last.is_some_and(|found| found.diverges() && !found.chaotic()) {
            last = measured(options.chaos_over.saturating_mul(LONGER));
        }
        match last.or(self.spectrum.flatten()) {
            Some(found) if found.chaotic() => Verdict::Chaotic(found),
            spectrum => Verdict::Undecided(Undecided::Impacts { impacts: self.impacts.len() as u64, spectrum }),
        }
    }
}

/// The verdict on a motion that came to an end.
pub(crate) fn ended(osc: &Oscillator, end: Option<End>, limits: SearchLimits) -> Verdict {
    match end {
        Some(End::Never(why)) => Verdict::NoImpact(NoImpact::Flight(why)),
        Some(End::Stuck(side)) => Verdict::Stuck(side),
        Some(End::NoneFor(time)) => {
            let periods = time / osc.period();
            if time >= 0.999 * limits.horizon(osc) {
                Verdict::NoImpact(NoImpact::ForPeriods(periods.floor()))
            } else {
                Verdict::Undecided(Undecided::Search { periods })
            }
        }
        None => Verdict::Undecided(Undecided::Search { periods: 0.0 }),
    }
}
