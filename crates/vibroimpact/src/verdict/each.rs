//! A few starts of each of many oscillators settled side by side, with the same verdicts as one after another.
//!
//! Most motions are decided after a few dozen impacts. They are followed one after another, because what a batch needs of
//! an oscillator takes longer to compute than so few flights. The others, which are chaotic or become periodic slowly, have
//! most of the impacts: they are followed on in the lanes of a batch, those of oscillators for which the same formulas
//! hold beside each other. Only the lanes of AVX-512 save time; otherwise all motions are followed one after another.

use super::abreast::{Source, settle_abreast};
use super::follow::{Follow, Releases};
use super::many::{FEW, KnownAttractors, settle_many};
use super::options::SettleOptions;
use super::outcome::Verdict;
use super::settle::{Drive, Followed, settle};
use super::settlement::{Part, Settlement};
use crate::contact::chatter;
use crate::lanes::{Batch, Kind, PropagatorCache, Width};
use crate::lyapunov::Arrivals;
use crate::motion::{ImpactState, Launched, Motion};
use crate::system::{Oscillator, Start};

/// The number of motions side by side. More need more memory, and fewer leave more lanes empty at the end.
const ABREAST: usize = 512;

/// The number of impacts after which a motion is followed on in a batch.
const LONG: usize = 64;

/// An oscillator and the number of its starts.
pub type Counted = (Oscillator, u64);

/// Settles the starts of each oscillator; `start(i, k)` is number `k` of oscillator `i`. `tails` tells whether the
/// [tails](Settlement::tails) of chaotic motions are kept. `done` is called for each oscillator when its starts are
/// settled, with its number; if it returns true, the computation stops. Returns whether it came to its end.
///
/// ```
/// use vibroimpact::{Oscillator, Start, lanes::Width, verdict::{SettleOptions, settle_each}};
/// let systems: Vec<_> = (0..40)
///     .map(|k| Ok((Oscillator::from_inverse_beta(1.2 + 0.005 * f64::from(k), 0.75, 0.5)?, 3)))
///     .collect::<Result<_, vibroimpact::SystemError>>()?;
/// let start = |_: usize, k: u64| Start { x: 0.0, v: -1.0 * k as f64, phase: 0.0 };
/// let mut starts = 0;
/// let ended = settle_each(&systems, &start, &SettleOptions::default(), false, Width::best(), &mut |_, settlement| {
///     starts += settlement.cells.len();
///     false
/// });
/// assert!(ended && starts == 120);
/// # Ok::<(), vibroimpact::SystemError>(())
/// ```
pub fn settle_each(
    systems: &[Counted],
    start: &dyn Fn(usize, u64) -> Start,
    options: &SettleOptions,
    tails: bool,
    width: Width,
    done: &mut dyn FnMut(usize, Settlement) -> bool,
) -> bool {
    // the systems of each kind that can share lanes
    let mut kinds: Vec<(Kind, Vec<usize>)> = Vec::new();
    for (system, (osc, count)) in systems.iter().enumerate() {
        let few = width.suits_each() && (1..FEW as u64).contains(count);
        let kind = if few { Kind::of(osc) } else { None };
        if let Some((kind, _)) = kind.filter(|(_, longest)| *longest < options.limits.horizon(osc)) {
            match kinds.iter_mut().find(|(known, _)| *known == kind) {
                Some((_, group)) => group.push(system),
                None => kinds.push((kind, vec![system])),
            }
            continue;
        }
        let none = KnownAttractors::default();
        if done(system, settle_many(osc, 0..*count, &|k| start(system, k), &none, options, width, &|| false)) {
            return false;
        }
    }
    for (kind, group) in kinds {
        let starts: u64 = group.iter().map(|system| systems[*system].1).sum();
        let capacity = usize::try_from(starts).unwrap_or(ABREAST).min(ABREAST);
        let points = group.iter().map(|system| Point::new(*system, systems[*system].1)).collect();
        let source = Points {
            systems,
            points,
            start,
            options,
            next: (0, 0),
            places: Vec::new(),
            tails,
            done: &mut *done,
            stopped: false,
        };
        if settle_abreast(Batch::of_many(kind, capacity, width), options, source).stopped {
            return false;
        }
    }
    true
}

/// The verdict on a start: with the impacts of its tail and the number of impacts to the decision.
type Decided = (Verdict, Arrivals, u64);

/// The starts of one oscillator.
struct Point {
    system: usize,
    releases: Releases,
    /// The verdicts so far.
    decided: Vec<Option<Decided>>,
    left: usize,
}

impl Point {
    fn new(system: usize, count: u64) -> Self {
        let count = usize::try_from(count).unwrap_or(0);
        Self { system, releases: Releases::default(), decided: vec![None; count], left: count }
    }
}

/// The starts of several oscillators of one kind.
struct Points<'a> {
    systems: &'a [Counted],
    points: Vec<Point>,
    start: &'a dyn Fn(usize, u64) -> Start,
    options: &'a SettleOptions,
    /// The point and the start that is followed next.
    next: (usize, usize),
    /// The point and the start of each motion in the batch.
    places: Vec<(usize, usize)>,
    tails: bool,
    done: &'a mut dyn FnMut(usize, Settlement) -> bool,
    stopped: bool,
}

impl Points<'_> {
    /// Takes down the verdict on a start of a point.
    fn decide(&mut self, (number, k): (usize, usize), verdict: Verdict, follow: &Follow) {
        let arrivals = if self.tails { follow.arrivals(&verdict, self.options) } else { Arrivals::new() };
        let point = &mut self.points[number];
        point.decided[k] = Some((verdict, arrivals, follow.count() as u64));
        point.left -= 1;
        if point.left == 0 {
            self.settle(number);
        }
    }

    /// The settlement of a point, once all its starts are decided. They are taken in their order, so it does not depend
    /// on the order of the decisions.
    fn settle(&mut self, number: usize) {
        let point = &mut self.points[number];
        let decided = core::mem::take(&mut point.decided);
        let mut part = Part::open(decided.len());
        for (k, (verdict, arrivals, impacts)) in decided.into_iter().flatten().enumerate() {
            part.followed(k, k as u64, (verdict, arrivals), impacts);
        }
        let osc = &self.systems[point.system].0;
        let full = |k: u64| settle(osc, (self.start)(point.system, k), self.options).verdict;
        // the verdicts are full ones, which contradict nothing
        let settlement = part.settlement(0, &full).unwrap_or_default();
        self.stopped |= (self.done)(point.system, settlement);
    }
}

impl Source for Points<'_> {
    fn next(&mut self, follow: &mut Follow) -> Option<(usize, Launched)> {
        while !self.stopped {
            let (mut number, mut k) = self.next;
            while k >= self.points.get(number)?.decided.len() {
                (number, k) = (number + 1, 0);
            }
            self.next = (number, k + 1);
            let system = self.points[number].system;
            let (osc, options) = (&self.systems[system].0, self.options);
            follow.reset();
            let motion = &mut Motion::with_limits(osc, (self.start)(system, k as u64), options.limits);
            let (releases, cache) = (&mut self.points[number].releases, PropagatorCache::new());
            let mut drive = Drive { osc, follow, releases, motion, cache: Some(&cache), time: 0.0, returned: false };
            let flies_on = |follow: &Follow| !chatter::settles_after(osc, &follow.last());
            match drive.verdict(options, &|drive| drive.follow.count() >= LONG && flies_on(drive.follow)) {
                Some(verdict) => self.decide((number, k), verdict, follow),
                None => {
                    self.places.push((number, k));
                    #[allow(clippy::cast_possible_truncation)] // a tile
                    let launched = Launched { system: system as u32, start: follow.last().rebound(osc) };
                    return Some((self.places.len() - 1, launched));
                }
            }
        }
        None
    }

    fn osc(&self, system: u32) -> &Oscillator {
        &self.systems[system as usize].0
    }

    fn follow(&self) -> Follow {
        if self.tails { Follow::keeping_tail() } else { Follow::default() }
    }

    fn releases(&mut self, place: usize) -> &mut Releases {
        &mut self.points[self.places[place].0].releases
    }

    fn caught(&mut self, _: usize, _: &Follow, _: &ImpactState, _: &SettleOptions) -> bool {
        false
    }

    fn decided(&mut self, place: usize, verdict: Verdict, follow: &Follow, _: &SettleOptions) {
        self.decide(self.places[place], verdict, follow);
    }

    fn stopping(&mut self) -> bool {
        self.stopped
    }
}
