//! The record of a motion that is followed, and the decisions based on its impacts so far. [`settle`](super::settle())
//! defines these decisions.
//!
//! The events come from a [`Motion`](crate::motion::Motion) or from the slot of a [`Batch`](crate::lanes::Batch). Both
//! give the same bits, so the verdict is the same.

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

/// The record of a motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Follow {
    /// The latest impacts, and the time between each and the one before.
    impacts: Vec<(ImpactState, f64)>,
    /// The number of impacts before those.
    earlier: usize,
    /// Time since the last impact.
    since: f64,
    /// The number of impacts before the first release from each stop.
    released: [Option<usize>; 2],
    /// The number of impacts before the last release; the motion after it does not depend on them.
    forgotten: usize,
    candidate: Option<Cycle>,
    fading: Fading,
    grazes: u32,
    next_look: usize,
    /// The number of search steps.
    pub(crate) steps: u64,
    /// The current measurement for chaos. It is boxed, because most motions settle before it begins and a reset writes
    /// all fields.
    measure: Option<Box<Measure>>,
    /// The number of measurements completed since the last release, and the exponents of the latest one.
    windows: usize,
    spectrum: Option<Spectrum>,
    /// Chaos that has ended because the motion stuck.
    over: Option<Chaos>,
}

/// The verdicts on the motion after a release, which is the same for every motion of an oscillator. Each is computed at
/// most once for each kind of search.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Releases([[Option<Option<Verdict>>; 2]; 2]);

impl Releases {
    /// The verdict on the motion after a release, if it returns to this release. After the first release a short cycle
    /// is searched for. A long one is searched for only after the motion itself has returned, after `again` impacts,
    /// because most motions that stick on their way never do so again, and following such a motion to the end costs far
    /// more.
    fn verdict(&mut self, osc: &Oscillator, side: Side, again: Option<usize>) -> Option<Verdict> {
        let known = &mut self.0[usize::from(side == Side::Lower)][usize::from(again.is_some())];
        // the motion between two releases is the cycle, so it is found again within as many events
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

/// The number of events after a release in which a short cycle is searched for.
const SHORT: u32 = 64;

/// The lengths of successive measurements for chaos, in units of [`SettleOptions::chaos_over`]; weak chaos needs a
/// longer measurement. The last length is repeated.
const WINDOWS: [u32; 3] = [1, 3, 8];
/// The number of impacts between searches for a recurrence at the beginning. Later it is an eighth of the number of
/// impacts, so that the searches take little time in a long chaotic motion.
const LOOK: usize = 16;
/// The least number of impacts that are kept.
const KEPT: usize = 1024;
/// The number of candidates for the period that are tried in each search.
const TRIES: usize = 3;

impl Follow {
    /// Resets the record for another motion.
    pub(crate) fn reset(&mut self) {
        let impacts = core::mem::take(&mut self.impacts);
        *self = Self { impacts, ..Self::default() };
        self.impacts.clear();
    }

    /// The number of impacts so far.
    pub(crate) fn count(&self) -> usize {
        self.earlier + self.impacts.len()
    }

    /// Whether the budget permits more. A measurement that began because the one before diverged too little for a
    /// decision is completed beyond the budget.
    pub(crate) fn within(&self, options: &SettleOptions) -> bool {
        let longer = options.extend
            && self.windows + 1 == WINDOWS.len()
            && self.measure.is_some()
            && self.spectrum.is_some_and(|found| found.diverges());
        longer && self.steps < 3 * options.max_steps
            || self.count() < options.max_impacts as usize && self.steps < options.max_steps
    }

    /// The number of impacts after which a decision other than a cycle is possible next: chaos, or the end of the
    /// budget.
    pub(crate) fn undisturbed(&self, options: &SettleOptions) -> usize {
        let end = options.max_impacts as usize;
        let measured = match &self.measure {
            Some(measure) => self.count() + measure.left() as usize,
            None if options.chaos_over == 0 => end,
            None => self.forgotten + (options.chaos_after + window(options, self.windows)) as usize,
        };
        end.min(measured)
    }

    /// Whether a motion captured by a trapping region of this depth would be decided as that cycle without the region,
    /// before any other decision is possible: when it is close to the cycle, and at the next search for a recurrence.
    pub(super) fn reaches(&self, depth: Depth, options: &SettleOptions) -> bool {
        let close = self.count() + depth.impacts;
        close + LOOK + LOOK.max(close / 8) <= self.undisturbed(options) && self.steps + depth.steps <= options.max_steps
    }

    /// The last impact; before the first impact, a state with velocity 0 on the upper stop.
    pub(crate) fn last(&self) -> ImpactState {
        let none = ImpactState { phase: 0.0, velocity: 0.0, side: Side::Upper };
        self.impacts.last().map_or(none, |(state, _)| *state)
    }

    /// Records an impact `interval` after the last event; returns the verdict if it is decided.
    pub(crate) fn impact(
        &mut self,
        osc: &Oscillator,
        options: &SettleOptions,
        state: ImpactState,
        interval: f64,
    ) -> Option<Verdict> {
        let since = self.since + interval;
        if self.impacts.len() >= KEPT.max(4 * options.longest as usize) {
            // recurrences are searched for among the remaining impacts
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

    /// Continues or begins the measurement for chaos at this impact; returns whether it is complete.
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

    /// Decides chaos from a complete measurement, or begins the next measurement.
    fn judged(&mut self, osc: &Oscillator, options: &SettleOptions) -> Option<Verdict> {
        let (spectrum, chaotic) = self.measure.take()?.chaos(osc).unzip();
        (self.spectrum, self.windows) = (spectrum, self.windows + 1);
        let chaos = spectrum.filter(|_| chaotic == Some(true));
        if chaos.is_none() {
            self.measure = Some(Box::new(Measure::new(self.last(), window(options, self.windows))));
        }
        chaos.map(|spectrum| Verdict::Chaotic(Chaos { spectrum, impacts: self.count() as u64 }))
    }

    /// Chaos that was measured and has ended, if the motion has settled into something else.
    pub(crate) fn transient(&self, osc: &Oscillator) -> Option<Chaos> {
        let measured = self.measure.as_ref().and_then(|measure| measure.chaos(osc)).map(|(spectrum, _)| spectrum);
        let found = measured.into_iter().chain(self.spectrum).find(Spectrum::chaotic);
        found.map(|spectrum| Chaos { spectrum, impacts: self.count() as u64 }).or(self.over)
    }

    /// Searches for a recurrence, and confirms the cycle by Newton's method and the test whether it captures the
    /// motion.
    fn look(&mut self, osc: &Oscillator, options: &SettleOptions, state: ImpactState) -> Option<Verdict> {
        let count = self.count();
        self.next_look = count + LOOK.max(count / 8);
        if let Some(cycle) = &self.candidate
            && recurrence::captured(osc, &state, cycle)
        {
            return self.candidate.take().map(Verdict::Periodic);
        }
        let mut tried = 0;
        // a long cycle also resembles itself after fewer impacts, as after several period doublings; when close it is
        // always tried
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

    /// Records a grazing contact `interval` after the last event; returns the verdict if it is decided.
    pub(crate) fn graze(&mut self, osc: &Oscillator, side: Side, phase: f64, interval: f64) -> Option<Verdict> {
        self.since += interval;
        self.grazes += 1;
        if self.fading.strikes(osc, ImpactState { phase, velocity: 0.0, side }, interval) {
            return Some(Verdict::NoImpact(NoImpact::GrazeLimit { velocity: 0.0, phase }));
        }
        (self.grazes > MAX_TOUCHES).then_some(Verdict::NoImpact(NoImpact::Grazing { phase }))
    }

    /// Records that the mass sticks. All neighbouring motions are the same from then on, so chaos has ended.
    pub(crate) fn stick(&mut self, osc: &Oscillator, interval: f64) {
        self.since += interval;
        self.over = self.transient(osc);
        self.fading.rests();
        (self.measure, self.spectrum, self.windows) = (None, None, 0);
    }

    /// Records a release; returns the verdict if the motion after it returns to the same release. It is computed
    /// at the first and the second release from a stop.
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

    /// The verdict when the budget is used up, after a last search for a recurrence.
    pub(crate) fn last_look(&mut self, osc: &Oscillator, options: &SettleOptions) -> Verdict {
        let shown = self.impacts.last().copied().and_then(|(state, _)| self.look(osc, options, state));
        shown.unwrap_or_else(|| {
            let measured = self.measure.as_ref().and_then(|measure| measure.chaos(osc)).map(|(spectrum, _)| spectrum);
            let impacts = self.count() as u64;
            Verdict::Undecided(Undecided::Impacts { impacts, spectrum: measured.or(self.spectrum) })
        })
    }
}

/// The length of the measurement `k` for chaos.
fn window(options: &SettleOptions, k: usize) -> u32 {
    options.chaos_over.saturating_mul(WINDOWS[k.min(WINDOWS.len() - 1)])
}

/// The verdict on a motion that has ended.
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
