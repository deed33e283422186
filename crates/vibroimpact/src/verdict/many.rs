//! Many starts of one oscillator settled side by side, with the same verdicts as one after another.
//!
//! The flights are computed by a [`Batch`]. Each motion is [followed](super::follow) as a single one would be, with the
//! same impacts. Time is saved by what is known already: a motion that enters the [trapping
//! region](super::trapping_region) of a cycle need not be followed further. A motion that the lanes cannot continue is
//! continued by a scalar [`Motion`], from the middle of its flight.
//!
//! The result does not depend on how the starts are divided. Motions are compared as in [`Census`](super::Census), and
//! the verdict reported for each is that of [`settle`] on the first start that leads to it.

use super::CountedMotion;
use super::attractors::SAME;
use super::follow::{Follow, Releases, ended};
use super::options::SettleOptions;
use super::outcome::{Reason, Verdict};
use super::settle::{Drive, settle, settle_knowing};
use super::trapping_region::TrappingRegion;
use crate::flight::Contact;
use crate::lanes::{ABREAST, Batch, Width};
use crate::lyapunov::Arrivals;
use crate::motion::{End, Motion};
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
            if let Verdict::Periodic(cycle) = &verdict
                && !survey.known.iter().any(|(other, _)| other.same_as(&verdict, SAME))
                && let Some(trap) = TrappingRegion::around(osc, cycle, options.limits.steps)
            {
                survey.known.push((verdict, trap));
            }
        }
        survey
    }
}

/// The motions to which a range of starts leads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settlement {
    /// The distinct motions, in the order of the first start that leads to each.
    pub motions: Vec<CountedMotion>,
    /// For each motion, the impacts of its [tail](crate::chaos::Tail) if it is chaotic and its first start was followed
    /// alone, as few starts are; otherwise nothing. [`of_arrivals`](crate::quantities::of_arrivals) computes its
    /// quantities from them, or without them.
    pub tails: Vec<Arrivals>,
    /// The index of its motion for each start; shorter than the range if stopped.
    pub cells: Vec<u32>,
    /// How each start was decided, one for each cell.
    pub endings: Vec<Ending>,
}

/// How a start was decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ending {
    /// Why the verdict on this start holds.
    pub reason: Reason,
    /// The number of impacts from the start to the decision: those of [`Settled`](super::Settled), or fewer where the
    /// motion entered the trapping region of a cycle that was known.
    pub impacts: u32,
}

/// Settles the starts with these indices. `tick` is called after each start; if it returns true, the computation stops.
///
/// ```
/// use vibroimpact::{Start, lanes::Width, scenario, verdict::{KnownAttractors, SettleOptions, settle_many}};
/// let osc = scenario::S.oscillator();
/// let start = |k: u64| Start { x: 0.0, v: -4.0 + 0.01 * k as f64, phase: 0.0 };
/// let options = SettleOptions::default();
/// let survey = KnownAttractors::survey(&osc, (0..8).map(|k| start(100 * k)), &options);
/// let settlement = settle_many(&osc, 0..800, start, &survey, &options, Width::best(), &|| false);
/// assert_eq!(settlement.motions.len(), 2);         // 1/1 and 2/1
/// assert_eq!(settlement.cells.len(), 800);
/// ```
#[must_use]
pub fn settle_many(
    osc: &Oscillator,
    range: Range<u64>,
    start: impl Fn(u64) -> Start,
    survey: &KnownAttractors,
    options: &SettleOptions,
    width: Width,
    tick: &dyn Fn() -> bool,
) -> Settlement {
    let full = |k: u64| settle(osc, start(k), options).verdict;
    let question = Question { osc, options, width, tick };
    question.decide(range.clone(), &start, survey).settlement(range.start, full).unwrap_or_else(|| {
        // the full verdict on the first start of a motion contradicts a trapping region: compute this part without
        // trapping regions
        let part = question.decide(range.clone(), &start, &KnownAttractors::default());
        part.settlement(range.start, full).unwrap_or_default()
    })
}

/// A motion of this part, and the first start that leads to it.
#[derive(Clone, Debug)]
struct Local {
    verdict: Verdict,
    first: u64,
    /// The first start that was followed to its end, its verdict, and the impacts of the tail of a chaotic motion.
    followed: Option<(u64, (Verdict, Arrivals))>,
}

/// The verdicts on a range of starts.
#[derive(Debug, Default)]
struct Part {
    motions: Vec<Local>,
    /// The index of its motion for each start; [`OPEN`] if not decided.
    cells: Vec<u32>,
    /// How each start was decided; without meaning where it is not.
    endings: Vec<Ending>,
}

const OPEN: u32 = u32::MAX;
/// Fewer starts than this are followed one by one if no cycle is known. Lanes save no time for them, because most lanes
/// are empty during the last motions of a batch.
const FEW: usize = 32;

impl Part {
    /// The index of a motion in this part; a new motion is added.
    fn number(&mut self, verdict: &Verdict, index: u64) -> usize {
        let known = self.motions.iter().position(|motion| motion.verdict.same_as(verdict, SAME));
        known.unwrap_or_else(|| {
            self.motions.push(Local { verdict: verdict.clone(), first: index, followed: None });
            self.motions.len() - 1
        })
    }

    /// No start of a range of this length is decided.
    fn open(count: usize) -> Self {
        let nothing = Ending { reason: Reason::Impacts, impacts: 0 };
        Self { motions: Vec::new(), cells: vec![OPEN; count], endings: vec![nothing; count] }
    }

    /// Records the motion to which a start leads, decided after this number of impacts.
    fn caught(&mut self, place: usize, index: u64, verdict: &Verdict, impacts: u64) {
        let impacts = u32::try_from(impacts).unwrap_or(u32::MAX);
        self.endings[place] = Ending { reason: verdict.reason(), impacts };
        let number = self.number(verdict, index);
        self.motions[number].first = self.motions[number].first.min(index);
        self.cells[place] = u32::try_from(number).unwrap_or(OPEN);
    }

    /// Records the motion to which a start leads, with the full verdict on this start.
    fn followed(&mut self, place: usize, index: u64, (verdict, arrivals): (Verdict, Arrivals), impacts: u64) {
        self.caught(place, index, &verdict, impacts);
        let motion = &mut self.motions[self.cells[place] as usize];
        if motion.followed.as_ref().is_none_or(|(other, _)| index < *other) {
            motion.followed = Some((index, (verdict, arrivals)));
        }
    }

    /// The motions in order of first appearance, each with the full verdict on its first start; `None` if this verdict
    /// is another motion.
    fn settlement(mut self, first: u64, full: impl Fn(u64) -> Verdict) -> Option<Settlement> {
        self.cells.truncate(self.cells.iter().position(|&cell| cell == OPEN).unwrap_or(self.cells.len()));
        self.endings.truncate(self.cells.len());
        let end = first + self.cells.len() as u64;
        let mut order: Vec<usize> = (0..self.motions.len()).filter(|&k| self.motions[k].first < end).collect();
        order.sort_by_key(|&k| self.motions[k].first);
        let mut renamed = vec![OPEN; self.motions.len()];
        let mut motions = Vec::with_capacity(order.len());
        let mut tails = Vec::with_capacity(order.len());
        for (new, &old) in order.iter().enumerate() {
            let motion = &self.motions[old];
            let (verdict, arrivals) = match &motion.followed {
                Some((index, followed)) if *index == motion.first => followed.clone(),
                _ => (full(motion.first), Arrivals::new()),
            };
            if !verdict.same_as(&motion.verdict, SAME) {
                return None;
            }
            renamed[old] = u32::try_from(new).unwrap_or(OPEN);
            motions.push(CountedMotion { verdict, count: 0 });
            tails.push(arrivals);
        }
        for cell in &mut self.cells {
            *cell = renamed[*cell as usize];
            motions[*cell as usize].count += 1;
        }
        Some(Settlement { motions, tails, cells: self.cells, endings: self.endings })
    }
}

/// The motion in a slot of the batch.
#[derive(Debug)]
struct Track {
    place: usize,
    follow: Follow,
    done: bool,
}

struct Question<'a> {
    osc: &'a Oscillator,
    options: &'a SettleOptions,
    width: Width,
    tick: &'a dyn Fn() -> bool,
}

impl Question<'_> {
    /// Decides a range of starts: side by side in a batch, or one after another if they are few or the lanes cannot
    /// follow them.
    fn decide(&self, range: Range<u64>, start: &impl Fn(u64) -> Start, survey: &KnownAttractors) -> Part {
        let count = usize::try_from(range.end - range.start).unwrap_or(usize::MAX);
        let mut part = Part::open(count);
        let alone = count < FEW && survey.known.is_empty();
        let batch = if alone { None } else { Batch::new(self.osc, ABREAST.min(count), self.width) };
        let batch = batch.filter(|batch| batch.longest() < self.options.limits.horizon(self.osc));
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
        let known = &survey.known;
        Pool { question: self, known, releases, first: range.start, batch, tracks: Vec::new(), part }.run(count, start)
    }
}

/// A batch with the range of starts that it works on.
struct Pool<'a> {
    question: &'a Question<'a>,
    known: &'a [(Verdict, TrappingRegion)],
    releases: Releases,
    first: u64,
    batch: Batch,
    tracks: Vec<Track>,
    part: Part,
}

impl Pool<'_> {
    /// Follows all starts: a slot whose motion is decided is launched again with the next start.
    fn run(mut self, count: usize, start: &impl Fn(u64) -> Start) -> Part {
        let mut next = 0;
        while next < count.min(ABREAST) {
            self.batch.push(start(self.first + next as u64));
            self.tracks.push(Track { place: next, follow: Follow::default(), done: false });
            next += 1;
        }
        let (mut list, mut free) = (Vec::new(), Vec::new());
        while !self.batch.is_empty() {
            self.batch.round();
            list.clear();
            list.extend_from_slice(self.batch.struck());
            for &slot in &list {
                self.struck(slot);
            }
            list.clear();
            list.extend_from_slice(self.batch.settling());
            for &slot in &list {
                self.settling(slot);
            }
            list.clear();
            list.extend_from_slice(self.batch.rare());
            for &slot in &list {
                self.rare(slot);
            }
            free.extend((0_u32..).zip(&self.tracks).filter(|(_, track)| track.done).map(|(slot, _)| slot));
            while let Some(slot) = free.pop() {
                if (self.question.tick)() {
                    return self.part;
                }
                if next < count {
                    self.batch.launch(slot, start(self.first + next as u64));
                    let track = &mut self.tracks[slot as usize];
                    track.follow.reset();
                    (track.place, track.done) = (next, false);
                    next += 1;
                } else {
                    self.batch.remove(slot);
                    self.tracks.swap_remove(slot as usize);
                }
            }
        }
        self.part
    }

    /// Records the full verdict on the motion in a slot.
    fn followed(&mut self, slot: u32, verdict: Verdict) {
        let track = &mut self.tracks[slot as usize];
        track.done = true;
        let impacts = track.follow.count() as u64;
        let index = self.first + track.place as u64;
        self.part.followed(track.place, index, (verdict, Arrivals::new()), impacts);
    }

    /// Records the impact of a slot whose motion continues with a flight.
    fn struck(&mut self, slot: u32) {
        let (osc, options) = (self.question.osc, self.question.options);
        let (state, interval) = self.batch.arrival(slot);
        let track = &mut self.tracks[slot as usize];
        track.follow.steps += 1;
        if let Some((verdict, trap)) = self.known.iter().find(|(_, trap)| trap.catches(&state))
            && track.follow.reaches(trap.depth(), options)
        {
            track.done = true;
            let impacts = track.follow.count() as u64;
            self.part.caught(track.place, self.first + track.place as u64, verdict, impacts);
            return;
        }
        if let Some(verdict) = track.follow.impact(osc, options, state, interval) {
            self.followed(slot, verdict);
        } else if !track.follow.within(options) {
            let verdict = track.follow.last_look(osc, options);
            self.followed(slot, verdict);
        }
    }

    /// Continues a slot whose impact is not followed by a flight.
    fn settling(&mut self, slot: u32) {
        let track = &self.tracks[slot as usize];
        if track.done {
            return;
        }
        let (state, _) = self.batch.arrival(slot);
        if self.batch.settles_after(slot, &state) {
            self.hand_over(slot, Motion::after(self.question.osc, &state, self.question.options.limits));
        }
    }

    /// Continues a slot whose flight needs the careful search.
    fn rare(&mut self, slot: u32) {
        let options = self.question.options;
        let launched = self.batch.launched(slot);
        let (contact, steps) = self.batch.carefully(slot, options.limits);
        match contact {
            Contact::Impact { .. } => {
                self.tracks[slot as usize].follow.steps += u64::from(steps) - 1;
                self.struck(slot);
                self.settling(slot);
            }
            Contact::Never(why) => self.followed(slot, ended(self.question.osc, Some(End::Never(why)), options.limits)),
            Contact::NoneUntil(s) => {
                self.followed(slot, ended(self.question.osc, Some(End::NoneFor(s)), options.limits));
            }
            Contact::Grazing { .. } | Contact::Contact { .. } => {
                self.hand_over(slot, Motion::with_limits(self.question.osc, launched, options.limits));
            }
        }
    }

    /// Follows a single motion until it flies from impact to impact again, or to its end.
    fn hand_over(&mut self, slot: u32, mut motion: Motion<'_>) {
        let track = &mut self.tracks[slot as usize];
        let (osc, options, batch) = (self.question.osc, self.question.options, &self.batch);
        let mut drive = Drive { osc, options, follow: &mut track.follow, releases: &mut self.releases, time: 0.0 };
        match drive.on(&mut motion, |state| !batch.settles_after(slot, state)) {
            Some(verdict) => self.followed(slot, verdict),
            None => {
                let state = track.follow.last();
                self.batch.launch(slot, state.rebound(osc));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario;
    use crate::verdict::{Census, StartBox, scattered_starts};

    fn systems() -> Vec<Oscillator> {
        let mut systems: Vec<Oscillator> = scenario::PAPER.iter().map(scenario::Scenario::oscillator).collect();
        for (inverse, gap, eps, damping, lower) in [
            (1.11, -0.5, 0.5, 0.0, None),
            (0.4, -0.95, 0.9, 0.05, None),
            (1.3, 0.75, 0.0, 0.0, None),
            (2.0, 0.4, 1.0, 0.0, None),
            (1.0, 0.0, 0.7, 0.3, None),
            (0.9, 0.4, 0.6, 0.02, Some(0.5)),
            (0.002, 0.4, 0.6, 0.0, None),
            (1.7, -2.0, 0.5, 0.1, None),
        ] {
            let mut osc = Oscillator::from_inverse_beta(inverse, gap, eps).unwrap().with_damping(damping).unwrap();
            if let Some(gap) = lower {
                osc = osc.with_second_stop(gap, 0.8).unwrap();
            }
            systems.push(osc);
        }
        systems
    }

    /// As one start after another, for all lanes, trapping regions and parts.
    #[test]
    fn the_same_as_one_by_one() {
        let options =
            SettleOptions { max_impacts: 3000, chaos_over: 1000, max_steps: 200_000, ..SettleOptions::default() };
        for osc in systems() {
            let area = StartBox::natural(&osc);
            let start = |k: u64| scattered_starts(&osc, area, 3, k);
            let mut census = Census::default();
            let mut expected = Settlement::default();
            for settled in (0..60).map(|k| settle(&osc, start(k), &options)) {
                expected.cells.push(u32::try_from(census.add(&settled.verdict)).unwrap());
                let impacts = u32::try_from(settled.impacts).unwrap();
                expected.endings.push(Ending { reason: settled.verdict.reason(), impacts });
            }
            expected.motions = census.motions().to_vec();
            let reasons = |of: &Settlement| of.endings.iter().map(|ending| ending.reason).collect::<Vec<_>>();
            let none = KnownAttractors::default();
            let survey = KnownAttractors::survey(&osc, (100..110).map(start), &options);
            for width in Width::ALL.into_iter().filter(|width| width.available()) {
                for survey in [&none, &survey] {
                    let got = settle_many(&osc, 0..60, start, survey, &options, width, &|| false);
                    assert_eq!(reasons(&got), reasons(&expected), "{osc:?} {width:?}");
                    if *survey != none {
                        // a motion that a trapping region has captured is not followed to the end
                        let mut shorter = got.endings.iter().zip(&expected.endings);
                        assert!(shorter.all(|(got, whole)| got.impacts <= whole.impacts), "{osc:?} {width:?}");
                    }
                    let endings = if *survey == none { got.endings.clone() } else { expected.endings.clone() };
                    let tails = Vec::new(); // not kept for motions side by side
                    assert!(got.tails.iter().all(Vec::is_empty) || Batch::new(&osc, 1, width).is_none(), "{osc:?}");
                    assert_eq!(Settlement { endings, tails, ..got }, expected, "{osc:?} {width:?}");
                    // a small number is followed one by one
                    let few = settle_many(&osc, 0..20, start, survey, &options, width, &|| false);
                    assert_eq!(few.cells, expected.cells[..20], "{osc:?} {width:?}");
                }
            }
        }
    }
}
