//! Many starts of one oscillator settled side by side, with the same verdicts as one after another.
//!
//! Time is saved by what is known already: a motion that enters the [trapping region](super::trapping_region) of a
//! cycle need not be followed further. The others are followed [side by side](super::abreast).
//!
//! The result does not depend on how the starts are divided. Motions are compared as in [`Census`](super::Census), and
//! the verdict reported for each is that of [`settle`] on the first start that leads to it.

use super::abreast::{Source, settle_abreast};
use super::attractors::SAME;
use super::follow::{Follow, Releases};
use super::options::SettleOptions;
use super::outcome::Verdict;
use super::settle::{settle, settle_knowing};
use super::settlement::{Part, Settlement};
use super::trapping_region::TrappingRegion;
use crate::lanes::{ABREAST, Batch, Width};
use crate::lyapunov::Arrivals;
use crate::motion::{ImpactState, Launched};
use crate::system::{Oscillator, Start};
use core::ops::Range;

/// Cycles known in advance, with their trapping regions. They are computed once and used for all parts of a large task.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KnownAttractors {
    known: Vec<(Verdict, TrappingRegion)>,
    releases: Releases,
}

impl KnownAttractors {
    /// Settles these starts one by one and keeps the cycles that have a trapping region.
    #[must_use]
    pub fn survey(osc: &Oscillator, starts: impl Iterator<Item = Start>, options: &SettleOptions) -> Self {
        let mut survey = Self::default();
        for start in starts {
            let verdict = settle_knowing(osc, start, options, &mut survey.releases).0.verdict;
            // other motions have no trapping region
            if let Verdict::Periodic(cycle) = &verdict
                && !survey.known.iter().any(|(other, _)| other.same_as(&verdict, SAME))
                && let Some(trap) = TrappingRegion::around(osc, cycle, options.limits.steps)
            {
                survey.known.push((verdict, trap));
            }
        }
        survey
    }

    /// The verdicts on the motions.
    pub(super) fn verdicts(&self) -> impl Iterator<Item = &Verdict> {
        self.known.iter().map(|(verdict, _)| verdict)
    }
}

/// Settles the starts with these indices. `tick` is called after each start; if it returns true, the computation stops.
///
/// ```
/// use vibroimpact::{Start, lanes::Width, scenario, verdict::{KnownAttractors, SettleOptions, settle_many}};
/// let osc = scenario::S.oscillator();
/// let start = |k: u64| Start { x: 0.0, v: -4.0 + 0.01 * k as f64, phase: 0.0 };
/// let options = SettleOptions::default();
/// let survey = KnownAttractors::survey(&osc, (0..8).map(|k| start(100 * k)), &options);
/// let settlement = settle_many(&osc, 0..800, &start, &survey, &options, Width::best(), &|| false);
/// assert_eq!(settlement.motions.len(), 2);         // 1/1 and 2/1
/// assert_eq!(settlement.cells.len(), 800);
/// ```
#[must_use]
pub fn settle_many(
    osc: &Oscillator,
    range: Range<u64>,
    start: &dyn Fn(u64) -> Start,
    survey: &KnownAttractors,
    options: &SettleOptions,
    width: Width,
    tick: &dyn Fn() -> bool,
) -> Settlement {
    // the verdict on the first start of a motion, followed alone, as any single question gives it
    let full = |k: u64| settle(osc, start(k), options).verdict;
    let question = Question { osc, options, width, tick };
    question.decide(range.clone(), start, survey).settlement(range.start, &full).unwrap_or_else(|| {
        // the full verdict on the first start of a motion contradicts a trapping region: compute this part without
        // trapping regions
        let part = question.decide(range.clone(), start, &KnownAttractors::default());
        part.settlement(range.start, &full).unwrap_or_default()
    })
}

/// Fewer starts than this are followed one by one if no cycle is known. Lanes save no time for them, because most lanes
/// are empty during the last motions of a batch.
pub(super) const FEW: usize = 32;

struct Question<'a> {
    osc: &'a Oscillator,
    options: &'a SettleOptions,
    width: Width,
    tick: &'a dyn Fn() -> bool,
}

impl Question<'_> {
    /// Decides a range of starts: side by side in a batch, or one after another if they are few or the lanes cannot
    /// follow them.
    fn decide(&self, range: Range<u64>, start: &dyn Fn(u64) -> Start, survey: &KnownAttractors) -> Part {
        let count = usize::try_from(range.end - range.start).unwrap_or(usize::MAX);
        let mut part = Part::open(count);
        let alone = count < FEW && survey.known.is_empty();
        let batch = if alone { None } else { Batch::new(self.osc, ABREAST.min(count), self.width) };
        // a flight in lanes must end before the search does, or its verdict would differ
        let batch = batch.filter(|batch| batch.longest() < self.options.limits.horizon(self.osc));
        // one start after another may use what releases of earlier ones have shown: it is the same for all
        let mut releases = survey.releases.clone();
        let Some(batch) = batch else {
            for (place, index) in range.enumerate() {
                let (settled, arrivals) = settle_knowing(self.osc, start(index), self.options, &mut releases);
                part.followed(place, index, (settled.verdict, arrivals), settled.impacts);
                if (self.tick)() {
                    break;
                }
            }
            return part;
        };
        let numbers = vec![None; survey.known.len()];
        let (osc, known, tick) = (self.osc, &survey.known[..], self.tick);
        let source = Starts { osc, known, numbers, releases, range, start, next: 0, part, tick };
        settle_abreast(batch, self.options, source).part
    }
}

/// Starts of one oscillator.
struct Starts<'a> {
    osc: &'a Oscillator,
    known: &'a [(Verdict, TrappingRegion)],
    /// The number of each of these cycles in `part`, once a start leads to it.
    numbers: Vec<Option<usize>>,
    releases: Releases,
    range: Range<u64>,
    start: &'a dyn Fn(u64) -> Start,
    next: usize,
    part: Part,
    tick: &'a dyn Fn() -> bool,
}

impl Source for Starts<'_> {
    #[inline]
    fn next(&mut self, follow: &mut Follow) -> Option<(usize, Launched)> {
        let (next, index) = (self.next, self.range.start + self.next as u64);
        (index < self.range.end).then(|| {
            self.next += 1;
            follow.reset();
            (next, Launched { system: 0, start: (self.start)(index) })
        })
    }

    fn osc(&self, _: u32) -> &Oscillator {
        self.osc
    }

    fn follow(&self) -> Follow {
        Follow::default()
    }

    fn releases(&mut self, _: usize) -> &mut Releases {
        &mut self.releases
    }

    #[inline]
    fn caught(&mut self, place: usize, follow: &Follow, state: &ImpactState, options: &SettleOptions) -> bool {
        let Some(known) = self.known.iter().position(|(_, trap)| trap.catches(state)) else { return false };
        let (verdict, trap) = &self.known[known];
        // near the end of the budget the region would decide what the start alone does not
        if !follow.reaches(trap.depth(), options) {
            return false;
        }
        let index = self.range.start + place as u64;
        let number = *self.numbers[known].get_or_insert_with(|| self.part.number(verdict, index));
        self.part.caught(place, index, number, (verdict.reason(), follow.count() as u64));
        true
    }

    fn decided(&mut self, place: usize, verdict: Verdict, follow: &Follow, _: &SettleOptions) {
        let index = self.range.start + place as u64;
        self.part.followed(place, index, (verdict, Arrivals::new()), follow.count() as u64);
    }

    fn stopping(&mut self) -> bool {
        (self.tick)()
    }
}
