//! The record of the latest returns of a motion to its stops, and the decisions that follow from them alone: a
//! recurrence suggests a period, Newton's method confirms a cycle, and a measurement of the Lyapunov exponents decides
//! chaos. It is the same for the oscillator, whose returns are impacts, and for machines, whose returns are events.

use super::options::SettleOptions;
use super::outcome::{Chaos, Settled, Undecided, UndecidedCause, Verdict};
use super::recurrence::{Candidate, candidates};
use super::recurring::{CycleOf, Measurement, Recurring};

/// The record of a motion.
#[derive(Clone, Debug)]
pub(crate) struct Record<R: Recurring> {
    /// The latest returns, and the time between each and the one before.
    pub(super) returns: Vec<(R::Return, f64)>,
    /// The number of the latest returns that always remain; 0 if only those for the search for recurrences.
    pub(super) latest: usize,
    /// The number of returns before those.
    earlier: usize,
    /// The number of returns before the motion last forgot its past.
    forgotten: usize,
    candidate: Option<CycleOf<R>>,
    next_look: usize,
    /// The current measurement for chaos. It is boxed, because most motions settle before it begins and a reset writes
    /// all fields.
    measure: Option<Box<R::Measure>>,
    /// The number of measurements completed since then, and the exponents of the latest one.
    windows: usize,
    spectrum: Option<Measurement<R>>,
    /// Whether the latest one showed chaos.
    chaotic: bool,
    /// Chaos that has ended, or may have.
    over: Option<Chaos<R::System>>,
    /// Whether the motion has returned to a release whose cycle was not confirmed.
    pub(super) unconfirmed: bool,
    /// The number of impacts of an oscillator, or events of a machine, that were followed, and that of search steps.
    pub(super) events: u64,
    pub(super) steps: u64,
}

impl<R: Recurring> Default for Record<R> {
    fn default() -> Self {
        Self {
            returns: Vec::new(),
            latest: 0,
            earlier: 0,
            forgotten: 0,
            candidate: None,
            next_look: 0,
            measure: None,
            windows: 0,
            spectrum: None,
            chaotic: false,
            over: None,
            unconfirmed: false,
            events: 0,
            steps: 0,
        }
    }
}

/// The lengths of successive measurements for chaos, in units of [`SettleOptions::chaos_over`]; weak chaos needs a
/// longer measurement. The last length is repeated.
const WINDOWS: [u32; 3] = [1, 3, 8];
/// The number of returns between searches for a recurrence at the beginning. Later it is an eighth of the number of
/// returns, so that the searches take little time in a long chaotic motion.
pub(super) const LOOK: usize = 16;
/// The least number of returns that are kept.
const KEPT: usize = 1024;
/// The number of candidates for the period that are tried in each search.
const TRIES: usize = 3;

impl<R: Recurring> Record<R> {
    /// Resets the record for another motion.
    pub(super) fn reset(&mut self) {
        // the vector keeps its memory: a batch resets records millions of times
        let returns = core::mem::take(&mut self.returns);
        *self = Self { returns, latest: self.latest, ..Self::default() };
        self.returns.clear();
    }

    /// The number of returns so far.
    pub(crate) fn count(&self) -> usize {
        self.earlier + self.returns.len()
    }

    /// Whether a measurement goes on that began because the one before diverged too little for a decision.
    fn undecided_measurement(&self) -> bool {
        // only the longest measurement may exceed the budget, so that the excess is bounded
        self.windows + 1 == WINDOWS.len()
            && !self.chaotic
            && self.measure.is_some()
            && self.spectrum.as_ref().is_some_and(|(spectrum, _)| spectrum.diverges())
    }

    /// The number of returns after which a decision other than a cycle is possible next: chaos, or the end of the
    /// budget.
    pub(super) fn undisturbed(&self, options: &SettleOptions) -> usize {
        // a trapping region may decide earlier than all that follows here, and must not change the verdict
        let end = options.max_impacts as usize;
        let measured = match &self.measure {
            Some(measure) => self.count() + R::left(measure) as usize,
            None if options.chaos_over == 0 => end,
            None => self.forgotten + (options.chaos_after + window(options, self.windows)) as usize,
        };
        end.min(measured)
    }

    /// Keeps a return `since` after the one before.
    pub(super) fn push(&mut self, options: &SettleOptions, state: R::Return, since: f64) {
        if self.returns.len() >= KEPT.max(4 * options.longest as usize).max(2 * self.latest) {
            // recurrences are searched for among the remaining returns
            let remaining = (2 * options.longest as usize + 2).max(self.latest);
            let gone = self.returns.len() - remaining;
            self.returns.drain(..gone);
            self.earlier += gone;
        }
        self.returns.push((state, since));
    }

    /// Whether the budget permits more. A measurement that began because the one before diverged too little for a decision is
    /// completed beyond the budget.
    pub(super) fn within(&self, options: &SettleOptions) -> bool {
        // the number of steps is bounded too: flights of many steps could make few returns take very long
        let longer = options.extend && self.undecided_measurement();
        longer && self.steps < 3 * options.max_steps
            || self.count() < options.max_impacts as usize && self.steps < options.max_steps
    }

    /// What the last return decides, which is `state`, so long `since` the one before.
    pub(super) fn decide(
        &mut self,
        system: &R,
        options: &SettleOptions,
        state: &R::Return,
        since: f64,
    ) -> Option<Verdict<R::System>> {
        // a cycle found now has precedence: near an unstable cycle the exponent is positive for a while
        let complete = self.measured(system, options, state, since);
        if complete || self.count() >= self.next_look.max(LOOK) {
            let cycle = self.look(system, options, state);
            if cycle.is_some() || !complete {
                return cycle.map(Verdict::Periodic);
            }
        }
        // without a cycle a complete measurement decides
        let found = if complete { self.judged(system, options, state) } else { None };
        let chaos = self.chaos_of(found?)?;
        // chaos of a machine may end within the budget, so the motion is followed to the end of it
        if R::LASTING {
            self.over = Some(chaos);
            return None;
        }
        Some(Verdict::Chaotic(chaos))
    }

    /// The verdict when the budget is used up, after a last search for a recurrence.
    pub(super) fn last_look(&mut self, system: &R, options: &SettleOptions) -> Verdict<R::System> {
        // the last search may have been an eighth of all returns ago
        let last = self.returns.last().map(|(state, _)| state.clone());
        if let Some(cycle) = last.and_then(|state| self.look(system, options, &state)) {
            return Verdict::Periodic(cycle);
        }
        if self.unconfirmed {
            return self.undecided(system, UndecidedCause::Unconfirmed);
        }
        let chaos = if R::LASTING { self.chaos(system).and_then(|found| self.chaos_of(found)) } else { None };
        chaos.map_or_else(|| self.undecided(system, UndecidedCause::Budget), Verdict::Chaotic)
    }

    /// Continues or begins the measurement for chaos at this return; returns whether it is complete.
    fn measured(&mut self, system: &R, options: &SettleOptions, state: &R::Return, since: f64) -> bool {
        match &mut self.measure {
            Some(measure) => system.add(measure, state, since),
            None => {
                // a measurement begins only after the transient, which would bias the mean
                if options.chaos_over > 0 && self.count() - self.forgotten >= options.chaos_after as usize {
                    self.measure = Some(Box::new(system.measure(state, window(options, self.windows))));
                }
                false
            }
        }
    }

    /// Decides chaos from a complete measurement, or begins the next measurement.
    fn judged(&mut self, system: &R, options: &SettleOptions, state: &R::Return) -> Option<Measurement<R>> {
        // the next measurement begins at this return, so that windows do not overlap and their errors are independent
        let (measured, chaotic) = system.chaos(&*self.measure.take()?).unzip();
        self.windows += 1;
        self.spectrum.clone_from(&measured);
        self.chaotic = chaotic == Some(true);
        let chaos = measured.filter(|_| self.chaotic);
        if chaos.is_none() {
            self.measure = Some(Box::new(system.measure(state, window(options, self.windows))));
        }
        chaos
    }

    /// The exponents of the measurement in progress.
    fn so_far(&self, system: &R) -> Option<Measurement<R>> {
        self.measure.as_ref().and_then(|measure| system.chaos(measure)).map(|(measured, _)| measured)
    }

    /// The verdict on a motion that is undecided, with the exponents of the measurement in progress, or else of the last one.
    pub(super) fn undecided(&self, system: &R, why: UndecidedCause) -> Verdict<R::System> {
        let spectrum = self.so_far(system).or_else(|| self.spectrum.clone()).map(|(spectrum, _)| spectrum);
        Verdict::Undecided(Undecided { why, impacts: self.events, spectrum })
    }

    /// Chaos with these exponents up to here.
    fn chaos_of(&self, (spectrum, tail): Measurement<R>) -> Option<Chaos<R::System>> {
        Some(Chaos { spectrum, impacts: self.events, tail: R::tail(tail, &self.returns)? })
    }

    /// Chaos that the measurement in progress or the last one shows, or that has ended before.
    fn transient(&self, system: &R) -> Option<Chaos<R::System>> {
        let mut measured = self.so_far(system).into_iter().chain(self.spectrum.clone());
        let chaos = measured.find(|(spectrum, _)| spectrum.chaotic()).and_then(|found| self.chaos_of(found));
        chaos.or_else(|| self.over.clone())
    }

    /// What is known of a motion with this verdict after this time, with the chaos before it.
    pub(super) fn settled(&self, system: &R, verdict: Verdict<R::System>, time: f64) -> Settled<R::System> {
        // chaos that goes on is the verdict itself, not a transient
        let open = matches!(verdict, Verdict::Chaotic(_) | Verdict::Undecided(_));
        let transient = if open { None } else { self.transient(system) };
        Settled { verdict, impacts: self.events, time, transient }
    }

    /// The exponents of the measurement in progress, or else of the last one, if they show chaos.
    fn chaos(&self, system: &R) -> Option<Measurement<R>> {
        match self.measure.as_ref().and_then(|measure| system.chaos(measure)) {
            Some((measured, chaotic)) => chaotic.then_some(measured),
            None => self.spectrum.clone().filter(|_| self.chaotic),
        }
    }

    /// The motion from here on does not depend on what was before: chaos is measured anew, from here.
    pub(super) fn forget(&mut self) {
        self.forgotten = self.count();
        self.unmeasured();
    }

    /// All neighbouring motions are the same from here on, so chaos has ended.
    pub(super) fn end_chaos(&mut self, system: &R) {
        self.over = self.transient(system);
        self.unmeasured();
    }

    /// Forgets all measurements.
    fn unmeasured(&mut self) {
        (self.measure, self.spectrum, self.windows, self.chaotic) = (None, None, 0, false);
    }

    /// Searches for a recurrence, and confirms the cycle by Newton's method and the test whether it captures the
    /// motion.
    fn look(&mut self, system: &R, options: &SettleOptions, state: &R::Return) -> Option<CycleOf<R>> {
        let count = self.count();
        self.next_look = count + LOOK.max(count / 8);
        // Newton's method found this cycle at an earlier search, before the motion was near enough
        if let Some(cycle) = &self.candidate
            && system.captured(state, cycle)
        {
            return self.candidate.take();
        }
        let mut tried = 0;
        // a long cycle also resembles itself after fewer returns, as after several period doublings; when close it is
        // always tried
        let found: Vec<Candidate> = candidates(system, &self.returns, options.longest as usize, options.recurrence)
            .filter(|candidate| {
                tried += 1;
                tried <= TRIES || candidate.close
            })
            .take(TRIES + 1)
            .collect();
        for Candidate { m, time, .. } in found {
            let Some(cycle) = system.cycle(state, u32::try_from(m).unwrap_or(u32::MAX), time) else {
                continue;
            };
            if system.captured(state, &cycle) {
                return Some(cycle);
            }
            // a stable cycle nearby will probably capture the motion later; an unstable one never does
            if R::stable(&cycle) {
                self.candidate = Some(cycle);
                break;
            }
        }
        None
    }
}

/// The length of the measurement `k` for chaos.
fn window(options: &SettleOptions, k: usize) -> u32 {
    options.chaos_over.saturating_mul(WINDOWS[k.min(WINDOWS.len() - 1)])
}
