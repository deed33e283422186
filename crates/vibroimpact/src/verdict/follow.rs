//! The record of a motion that is followed, and the decisions based on its impacts so far. [`settle`](super::settle())
//! defines these decisions.
//!
//! The events come from a [`Motion`](crate::motion::Motion) or from the slot of a [`Batch`](crate::lanes::Batch). Both
//! give the same bits, so the verdict is the same.

use super::graze_limit::Fading;
use super::options::SettleOptions;
use super::oscillator::NoImpact;
use super::outcome::{Undecided, UndecidedCause, Verdict};
use super::record::{LOOK, Record};
use super::trapping_region::Depth;
use crate::flight::SearchLimits;
use crate::lyapunov::{Arrivals, MEASURED_IMPACTS};
use crate::motion::{End, ImpactState, MAX_TOUCHES};
use crate::orbit::{AfterRelease, DEFAULT_EVENTS};
use crate::system::{Oscillator, Side};

/// The record of a motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Follow {
    pub(super) record: Record<Oscillator>,
    /// Time since the last impact.
    since: f64,
    /// The number of impacts before the first release from each stop.
    released: [Option<usize>; 2],
    fading: Fading,
    grazes: u32,
    /// The number of impacts before the last grazing contact.
    grazed: Option<usize>,
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
        // one place for each stop, and for the short and the long search
        let known = &mut self.0[usize::from(side == Side::Lower)][usize::from(again.is_some())];
        // the motion between two releases is the cycle, so it is found again within as many events
        let events = again
            .map_or(SHORT, |impacts| u32::try_from(impacts).unwrap_or(u32::MAX).saturating_mul(4).max(DEFAULT_EVENTS));
        known
            .get_or_insert_with(|| {
                let AfterRelease::Cycle(cycle) = AfterRelease::new(osc, side, events)? else {
                    return Some(undecided(UndecidedCause::Unconfirmed, 0));
                };
                let periods = cycle.label.periods;
                // a cycle whose contacts all have speed 0 has no impact
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

impl Follow {
    /// A record that keeps the impacts of the tail of a chaotic motion.
    #[allow(clippy::cast_possible_truncation)] // a thousand
    pub(crate) fn keeping_tail() -> Self {
        let mut follow = Self::default();
        // as many impacts as the quantities of a chaotic motion are measured over
        follow.record.latest = MEASURED_IMPACTS as usize;
        follow
    }

    /// Resets the record for another motion.
    pub(crate) fn reset(&mut self) {
        self.record.reset();
        let record = core::mem::take(&mut self.record);
        *self = Self { record, ..Self::default() };
    }

    /// The number of impacts so far.
    pub(crate) fn count(&self) -> usize {
        self.record.count()
    }

    /// Whether a motion captured by a trapping region of this depth would be decided as that cycle without the region,
    /// before any other decision is possible: when it is close to the cycle, and at the next search for a recurrence.
    pub(super) fn reaches(&self, depth: Depth, options: &SettleOptions) -> bool {
        // the region promises closeness after so many impacts; a recurrence is then found at the next search or at the
        // one after it
        let close = self.count() + depth.impacts;
        close + LOOK + LOOK.max(close / 8) <= self.record.undisturbed(options)
            && self.record.steps + depth.steps <= options.max_steps
    }

    /// The last impact; before the first impact, a state with velocity 0 on the upper stop.
    pub(crate) fn last(&self) -> ImpactState {
        let none = ImpactState { phase: 0.0, velocity: 0.0, side: Side::Upper };
        self.record.returns.last().map_or(none, |(state, _)| *state)
    }

    /// Records an impact `interval` after the last event; returns the verdict if it is decided.
    pub(crate) fn impact(
        &mut self,
        osc: &Oscillator,
        options: &SettleOptions,
        state: ImpactState,
        interval: f64,
    ) -> Option<Verdict> {
        // grazing contacts, rests and releases since the last impact belong to the same return
        let since = self.since + interval;
        self.record.events += 1;
        self.record.push(options, state, since);
        (self.since, self.grazes) = (0.0, 0);
        // before a decision by the record: gentler and gentler impacts also resemble a cycle of speed 0
        if self.fading.strikes(osc, state, interval) {
            return Some(Verdict::NoImpact(NoImpact::GrazeLimit { velocity: state.velocity, phase: state.phase }));
        }
        self.record.decide(osc, options, &state, since)
    }

    /// The impacts of the tail of a chaotic motion, just after its verdict. Empty for any other motion, where the record
    /// does [not keep](Self::keeping_tail) them, and where the
    /// flights from impact to impact are not those of a new motion from the beginning of the tail: after grazing
    /// contacts, and with other limits of the search than the default ones.
    pub(crate) fn arrivals(&self, verdict: &Verdict, options: &SettleOptions) -> Arrivals {
        let Verdict::Chaotic(chaos) = verdict else { return Arrivals::new() };
        let impacts = usize::try_from(chaos.tail.impacts).unwrap_or(usize::MAX);
        let returns = &self.record.returns;
        let kept = returns.len().checked_sub(impacts);
        // a flight from impact to impact passes a grazing contact without an event
        let grazed = self.grazed.is_some_and(|before| before + impacts >= self.count());
        match kept {
            Some(first) if !grazed && options.limits == SearchLimits::default() => returns[first..].to_vec(),
            _ => Arrivals::new(),
        }
    }

    /// Records a grazing contact `interval` after the last event; returns the verdict if it is decided.
    pub(crate) fn graze(&mut self, osc: &Oscillator, side: Side, phase: f64, interval: f64) -> Option<Verdict> {
        self.since += interval;
        self.grazes += 1;
        // a contact without speed changes no velocity; it counts for the limit of ever gentler impacts
        self.grazed = Some(self.count());
        if self.fading.strikes(osc, ImpactState { phase, velocity: 0.0, side }, interval) {
            return Some(Verdict::NoImpact(NoImpact::GrazeLimit { velocity: 0.0, phase }));
        }
        (self.grazes > MAX_TOUCHES).then_some(Verdict::NoImpact(NoImpact::Grazing { phase }))
    }

    /// Records that the mass sticks. All neighbouring motions are the same from then on, so chaos has ended.
    pub(crate) fn stick(&mut self, osc: &Oscillator, interval: f64) {
        self.since += interval;
        self.fading.rests();
        self.record.end_chaos(osc);
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
        // the release is at one phase and position, so nothing before it matters for chaos
        self.record.forget();
        let first = &mut self.released[usize::from(side == Side::Lower)];
        let again = first.map(|then| now - then);
        // the second release shows how many impacts a cycle through it may have
        first.get_or_insert(now);
        let verdict = releases.verdict(osc, side, again);
        verdict.map(|verdict| match verdict {
            Verdict::Undecided(of) => Verdict::Undecided(Undecided { impacts: now as u64, ..of }),
            verdict => verdict,
        })
    }
}

/// The verdict on a motion that is undecided without a measurement.
const fn undecided(why: UndecidedCause, impacts: u64) -> Verdict {
    Verdict::Undecided(Undecided { why, impacts, spectrum: None })
}

/// The verdict on a motion that has ended after so many impacts.
pub(crate) fn ended(osc: &Oscillator, end: Option<End>, limits: SearchLimits, impacts: u64) -> Verdict {
    match end {
        Some(End::Never(why)) => Verdict::NoImpact(NoImpact::Flight(why)),
        Some(End::Stuck(side)) => Verdict::Stuck(side),
        Some(End::NoneFor(time)) => {
            let periods = time / osc.period();
            // where the steady motion reaches a stop, an impact comes in the end, however long the search was: without damping this is known
            // at resonance, where it grows without bound
            let amplitude = osc.free_amplitude();
            let reaches = osc.stops().any(|(_, stop)| stop.gap < amplitude);
            if reaches && (osc.damping() > 0.0 || amplitude.is_infinite()) {
                return undecided(UndecidedCause::Search { periods }, impacts);
            }
            // less than the horizon: the budget of steps ended the search before it, and nothing is claimed
            if time >= 0.999 * limits.horizon(osc) {
                Verdict::NoImpact(NoImpact::ForPeriods(periods.floor()))
            } else {
                undecided(UndecidedCause::Search { periods }, impacts)
            }
        }
        None => undecided(UndecidedCause::Search { periods: 0.0 }, impacts),
    }
}
