//! A motion being followed: what its impacts so far show. [`settle`](super::settle()) says what counts as shown.
//!
//! The events may come from a [`Motion`](crate::motion::Motion) or from the slot of a [`Batch`](crate::lanes::Batch): they are the
//! same bits, and so is the verdict.

use super::graze_limit::Fading;
use super::options::SettleOptions;
use super::outcome::{Chaos, NoImpact, Undecided, Verdict};
use super::recurrence::{self, Candidate};
use super::trapping_region::Depth;
use crate::flight::SearchLimits;
use crate::lyapunov::{Measure, Spectrum};
use crate::motion::{End, ImpactState, MAX_TOUCHES};
use crate::orbit::{Cycle, DEFAULT_EVENTS, from_release, shoot};
use crate::system::{Oscillator, Side};

/// What was seen of a motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Follow {
    /// The last impacts and the time since the one before each.
    impacts: Vec<(ImpactState, f64)>,
    /// Impacts before those.
    earlier: usize,
    /// Time since the last impact.
    since: f64,
    /// Impacts before the first release from each stop.
    released: [Option<usize>; 2],
    /// Impacts before the last release: none of them matters for what follows.
    forgotten: usize,
    candidate: Option<Cycle>,
    fading: Fading,
    grazes: u32,
    next_look: usize,
    /// Search steps taken.
    pub(crate) steps: u64,
    /// The measurement for chaos under way. Apart, because most motions settle before it begins, and a reset writes all that is here.
    measure: Option<Box<Measure>>,
    /// Measurements completed since the last release, and the exponents of the last one.
    windows: usize,
    spectrum: Option<Spectrum>,
    /// Chaos that is over: the motion came to rest in it.
    over: Option<Chaos>,
}

/// What a release leads to, which is the same for every motion of an oscillator: each is looked for once in each way.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Releases([[Option<Option<Verdict>>; 2]; 2]);

impl Releases {
    /// After the first release a short cycle is looked for; a long one when the motion itself has come back after so many impacts, because
    /// most motions that rest on their way never do again, and to follow such a one to the end costs far more than it.
    fn verdict(&mut self, osc: &Oscillator, side: Side, again: Option<usize>) -> Option<Verdict> {
        let known = &mut self.0[usize::from(side == Side::Lower)][usize::from(again.is_some())];
        // what lies between two releases is the cycle, so it is found again within as many events
        let events = again
            .map_or(SHORT, |impacts| u32::try_from(impacts).unwrap_or(u32::MAX).saturating_mul(4).max(DEFAULT_EVENTS));
        known
            .get_or_insert_with(|| {
                let cycle = from_release(osc, side, events)?;
                let periods = cycle.label.periods;
                let landing = cycle.points.is_empty();
                Some(if landing {
                    Verdict::NoImpact(NoImpact::Landing { side, periods })
                } else {
                    Verdict::Periodic(cycle)
                })
            })
            .clone()
    }
}

/// Events after a release in which a cycle is short.
const SHORT: u32 = 64;

/// Lengths of the measurements for chaos one after another, in units of [`SettleOptions::chaos_over`]: weak chaos shows in a longer run.
/// The last is repeated.
const WINDOWS: [u32; 3] = [1, 3, 8];
/// Impacts between looks for a recurrence, while there are few; later an eighth of those there are, so that the looks
/// into a long chaotic motion stay cheap.
const LOOK: usize = 16;
/// Impacts kept at least.
const KEPT: usize = 1024;
/// Candidates for the period tried at each look.
const TRIES: usize = 3;

impl Follow {
    /// Forgets everything, for another motion.
    pub(crate) fn reset(&mut self) {
        let impacts = core::mem::take(&mut self.impacts);
        *self = Self { impacts, ..Self::default() };
        self.impacts.clear();
    }

    /// Impacts seen.
    pub(crate) fn count(&self) -> usize {
        self.earlier + self.impacts.len()
    }

    /// Whether the budget allows more: to the end of a measurement that was begun because the one before it diverged too little to tell.
    pub(crate) fn within(&self, options: &SettleOptions) -> bool {
        let longer = options.extend
            && self.windows + 1 == WINDOWS.len()
            && self.measure.is_some()
            && self.spectrum.is_some_and(|found| found.diverges());
        longer && self.steps < 3 * options.max_steps
            || self.count() < options.max_impacts as usize && self.steps < options.max_steps
    }

    /// The number of impacts after which something else than a cycle may be decided next: chaos, or nothing within the budget.
    pub(crate) fn undisturbed(&self, options: &SettleOptions) -> usize {
        let end = options.max_impacts as usize;
        let measured = match &self.measure {
            Some(measure) => self.count() + measure.left() as usize,
            None if options.chaos_over == 0 => end,
            None => self.forgotten + (options.chaos_after + window(options, self.windows)) as usize,
        };
        end.min(measured)
    }

    /// Whether a motion that is caught in a trapping region of that depth is decided by the cycle before anything else can be decided, followed as any
    /// other: until it is close, and up to the next look for a recurrence.
    pub(super) fn reaches(&self, depth: Depth, options: &SettleOptions) -> bool {
        let close = self.count() + depth.impacts;
        close + LOOK + LOOK.max(close / 8) <= self.undisturbed(options) && self.steps + depth.steps <= options.max_steps
    }

    /// The last impact; before the first, the stop at rest.
    pub(crate) fn last(&self) -> ImpactState {
        let none = ImpactState { phase: 0.0, velocity: 0.0, side: Side::Upper };
        self.impacts.last().map_or(none, |(state, _)| *state)
    }

    /// The next impact, `interval` after the last event.
    pub(crate) fn impact(
        &mut self,
        osc: &Oscillator,
        options: &SettleOptions,
        state: ImpactState,
        interval: f64,
    ) -> Option<Verdict> {
        let since = self.since + interval;
        if self.impacts.len() >= KEPT.max(4 * options.longest as usize) {
            // recurrences are searched for among these
            let gone = self.impacts.len() - 2 * options.longest as usize - 2;
            self.impacts.drain(..gone);
            self.earlier += gone;
        }
        self.impacts.push((state, since));
        (self.since, self.grazes) = (0.0, 0);
        if self.fading.strikes(osc, state, interval) {
            return Some(Verdict::NoImpact(NoImpact::GrazeLimit { velocity: state.velocity, phase: state.phase }));
        }
        let complete = self.measured(osc, options, state, since);
        if complete || self.count() >= self.next_look.max(LOOK) {
            let shown = self.look(osc, options, state);
            if shown.is_some() || !complete {
                return shown;
            }
        }
        if complete { self.judged(osc, options) } else { None }
    }

    /// The measurement for chaos goes on to this impact; whether it is complete.
    fn measured(&mut self, osc: &Oscillator, options: &SettleOptions, state: ImpactState, since: f64) -> bool {
        match &mut self.measure {
            Some(measure) => {
                measure.impact(osc, state, since);
                measure.complete()
            }
            None => {
                if options.chaos_over > 0 && self.count() - self.forgotten >= options.chaos_after as usize {
                    self.measure = Some(Box::new(Measure::new(state, window(options, self.windows))));
                }
                false
            }
        }
    }

    /// A complete measurement: chaos, or the next one is begun.
    fn judged(&mut self, osc: &Oscillator, options: &SettleOptions) -> Option<Verdict> {
        let (spectrum, chaotic) = self.measure.take()?.chaos(osc).unzip();
        (self.spectrum, self.windows) = (spectrum, self.windows + 1);
        let chaos = spectrum.filter(|_| chaotic == Some(true));
        if chaos.is_none() {
            self.measure = Some(Box::new(Measure::new(self.last(), window(options, self.windows))));
        }
        chaos.map(|spectrum| Verdict::Chaotic(Chaos { spectrum, impacts: self.count() as u64 }))
    }

    /// Chaos that was seen and is over, where the motion was shown to settle into something else.
    pub(crate) fn transient(&self, osc: &Oscillator) -> Option<Chaos> {
        let measured = self.measure.as_ref().and_then(|measure| measure.chaos(osc)).map(|(spectrum, _)| spectrum);
        let found = measured.into_iter().chain(self.spectrum).find(Spectrum::chaotic);
        found.map(|spectrum| Chaos { spectrum, impacts: self.count() as u64 }).or(self.over)
    }

    fn look(&mut self, osc: &Oscillator, options: &SettleOptions, state: ImpactState) -> Option<Verdict> {
        let count = self.count();
        self.next_look = count + LOOK.max(count / 8);
        if let Some(cycle) = &self.candidate
            && recurrence::captured(osc, &state, cycle)
        {
            return self.candidate.take().map(Verdict::Periodic);
        }
        let mut tried = 0;
        // a long cycle resembles itself after fewer impacts too, as one after several doublings does; once it is close it is tried in any case
        let found: Vec<Candidate> =
            recurrence::candidates(osc, &self.impacts, options.longest as usize, options.recurrence)
                .filter(|candidate| {
                    tried += 1;
                    tried <= TRIES || candidate.close
                })
                .take(TRIES + 1)
                .collect();
        for Candidate { m, n, .. } in found {
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
    pub(crate) fn graze(&mut self, osc: &Oscillator, side: Side, phase: f64, interval: f64) -> Option<Verdict> {
        self.since += interval;
        self.grazes += 1;
        if self.fading.strikes(osc, ImpactState { phase, velocity: 0.0, side }, interval) {
            return Some(Verdict::NoImpact(NoImpact::GrazeLimit { velocity: 0.0, phase }));
        }
        (self.grazes > MAX_TOUCHES).then_some(Verdict::NoImpact(NoImpact::Grazing { phase }))
    }

    /// It comes to rest on a stop: neighbours are the same motion from here on, so whatever chaos there was is over.
    pub(crate) fn stick(&mut self, osc: &Oscillator, interval: f64) {
        self.since += interval;
        self.over = self.transient(osc);
        self.fading.rests();
        (self.measure, self.spectrum, self.windows) = (None, None, 0);
    }

    /// A release decides all that follows: if it leads back to itself, that is the cycle. Looked for after the first two.
    pub(crate) fn release(
        &mut self,
        osc: &Oscillator,
        releases: &mut Releases,
        side: Side,
        interval: f64,
    ) -> Option<Verdict> {
        self.since += interval;
        let now = self.count();
        self.forgotten = now;
        let first = &mut self.released[usize::from(side == Side::Lower)];
        let again = first.map(|then| now - then);
        first.get_or_insert(now);
        releases.verdict(osc, side, again)
    }

    /// The verdict when the budget is spent: a last look, where the transient is as far gone as it will be.
    pub(crate) fn last_look(&mut self, osc: &Oscillator, options: &SettleOptions) -> Verdict {
        let shown = self.impacts.last().copied().and_then(|(state, _)| self.look(osc, options, state));
        shown.unwrap_or_else(|| {
            let measured = self.measure.as_ref().and_then(|measure| measure.chaos(osc)).map(|(spectrum, _)| spectrum);
            let impacts = self.count() as u64;
            Verdict::Undecided(Undecided::Impacts { impacts, spectrum: measured.or(self.spectrum) })
        })
    }
}

/// The length of measurement `k` for chaos.
fn window(options: &SettleOptions, k: usize) -> u32 {
    options.chaos_over.saturating_mul(WINDOWS[k.min(WINDOWS.len() - 1)])
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
