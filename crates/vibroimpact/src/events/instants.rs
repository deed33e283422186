//! What happens after ever shorter flights: the latest changes of contacts, and the round of changes that repeats itself at
//! their end.
//!
//! Impacts that accumulate come after ever shorter flights, whatever else they do: several stops at the same times or in
//! turn, with joints that slip, hold and reverse in between. Where the same contacts change in the same order again and
//! again, all speeds fall by one factor in each round, and the rounds last shorter by a factor $`q < 1`$, the time that is
//! left is the geometric sum of the rounds that follow, $`Rq/(1 - q)`$ after a round of length R.
//!
//! Some accumulate without a round that repeats itself, as those of a column of bodies. Then all that can be said is which
//! stops are struck again and again, ever more slowly.
//!
//! Changes at one time are one instant, and what is long or often enough is counted in instants: a machine that is twice beside
//! itself changes twice as much at as many instants, and accumulates as one.

use super::event::EventKind;
use crate::math::fit;
use std::collections::VecDeque;

/// Flights below this part of the longest one are short.
const SHORT: f64 = 1e-2;
/// A long flight is forgotten by this factor with each event.
const FORGOTTEN: f64 = 0.9995;
/// The longest round, in instants, and the number of instants that are kept: three rounds and the one before them.
const LONGEST: usize = 32;
const KEPT: usize = 3 * LONGEST + 1;
/// Factors that differ by less than this part of them are equal.
const EQUAL: f64 = 1e-2;
/// Those of rounds that take no time, whose lengths tell nothing, differ by no more than this.
const SETTLED: f64 = 1e-4;
/// No time passes in less than this part of the rounding error of the longest flight.
pub(super) const BELOW: f64 = 1e-3;
/// Speeds and rounds fall if their factor is less than 1 by more than this.
const FALLS: f64 = 1e-4;
/// Impacts of a round that are apart by no more than this part of it are at the same time.
const TOGETHER: f64 = 1e-6;
/// A stop is struck again and again if it is at least so often among the changes kept.
const OFTEN: usize = 4;
/// A part of the instants at both ends, whose speeds are compared, and the factor by which they have fallen: while few instants are
/// kept, and when all are.
const ENDS: usize = 4;
const FEW: usize = 24;
const MUCH_SLOWER: f64 = 1e-3;
const SLOWER: f64 = 0.5;
/// What is below so many rounding errors of the largest value of late is one.
const NOISE: f64 = 8.0;
/// In how many instants it is asked once whether a collapse without rounds is near.
const EVERY: usize = 8;

/// The kinds of changes, in the order of their numbers.
const KINDS: [EventKind; 7] = [
    EventKind::Impact,
    EventKind::Close,
    EventKind::Open,
    EventKind::Stick,
    EventKind::Release,
    EventKind::Slip,
    EventKind::Hold,
];

/// A change of the state of a contact, or an impact.
#[derive(Clone, Copy, Debug)]
struct Change {
    kind: EventKind,
    place: usize,
    speed: f64,
    /// The time since the change before it.
    after: f64,
    /// Whether it is the first one of its instant.
    begins: bool,
    /// Whether the flight to it began with exact gaps of the stops that it struck.
    exact: bool,
}

impl Change {
    /// Whether it does the same as another one.
    fn repeats(&self, other: &Self) -> bool {
        // of a slip the speed is its direction
        self.kind == other.kind
            && self.place == other.place
            && (self.kind != EventKind::Slip || self.speed == other.speed)
    }

    fn is_impact(&self) -> bool {
        self.kind == EventKind::Impact
    }
}

/// A round of changes that repeats itself.
#[derive(Clone, Debug)]
pub(super) struct Round {
    /// The stops, and the joints counted after them, that change in it.
    pub(super) places: Vec<usize>,
    /// Whether it has impacts at different times.
    pub(super) in_turn: bool,
    /// The time of all rounds that follow, and its error.
    pub(super) left: f64,
    pub(super) error: f64,
    /// The largest speed of its impacts.
    pub(super) speed: f64,
    /// Whether the times of its impacts have no rounding errors of the coordinates.
    pub(super) exact: bool,
}

/// The latest changes, as long as flights are short.
#[derive(Clone, Debug, Default)]
pub(super) struct Instants {
    /// The longest flight of late.
    longest: f64,
    /// The square of the largest size of the coordinates of late.
    square: f64,
    /// The square of the largest velocity of late, and the largest of each coordinate.
    fastest: f64,
    speeds: Vec<f64>,
    short: bool,
    /// At how many instants there were changes since the last long flight.
    count: usize,
    /// How many of them are kept.
    kept: usize,
    /// The time since the last change, and whether there was a flight since then.
    passed: f64,
    flew: bool,
    /// Whether the last flight began with exact gaps of the stops that it has reached.
    exact: bool,
    /// The last one first.
    latest: VecDeque<Change>,
}

impl Instants {
    /// Notes that time has passed in a flight.
    #[inline]
    pub(super) fn pass(&mut self, s: f64) {
        self.passed += s;
        self.flew = true;
    }

    /// Notes that a flight has ended, at this state; `exact` says whether the gaps of the stops that it has reached were exact at its
    /// beginning.
    #[inline]
    pub(super) fn land(&mut self, x: &[f64], v: &[f64], exact: bool) {
        self.exact = exact;
        fit(&mut self.speeds, v.len());
        let (mut of_x, mut of_v) = (0.0, 0.0);
        let larger = |one: f64, other: f64| if one > other { one } else { other };
        for ((speed, v), x) in self.speeds.iter_mut().zip(v).zip(x) {
            *speed = larger(FORGOTTEN * *speed, v.abs());
            (of_x, of_v) = (of_x + x * x, of_v + v * v);
        }
        // squares are forgotten by the square of the factor
        self.fastest = larger(FORGOTTEN * FORGOTTEN * self.fastest, of_v);
        // how far the flight went if it had this speed all along
        let way = self.passed * self.passed * of_v;
        self.square = larger(FORGOTTEN * FORGOTTEN * self.square, larger(of_x, way));
        self.longest *= FORGOTTEN;
        self.short = self.passed <= SHORT * self.longest;
        // after a long flight nothing accumulates
        if !self.short {
            self.longest = self.longest.max(self.passed);
            (self.count, self.kept) = (0, 0);
            self.passed = 0.0;
            self.latest.clear();
        }
    }

    /// Whether the last flight was short.
    #[inline]
    pub(super) const fn are_close(&self) -> bool {
        self.short
    }

    /// The longest flight of late.
    pub(super) const fn longest(&self) -> f64 {
        self.longest
    }

    /// The square of the largest size of the coordinates of late.
    pub(super) const fn square(&self) -> f64 {
        self.square
    }

    /// Whether a velocity along a direction, of which the square of the length is known, is below this part of the largest ones of late.
    #[inline]
    pub(super) fn is_faint(&self, velocity: f64, (along, square): (&[f64], f64), part: f64) -> bool {
        let square = square * self.fastest;
        #[allow(clippy::cast_precision_loss)] // coordinates
        let count = along.len() as f64;
        // the sum below is no larger than this bound, which nearly always decides
        velocity * velocity <= part * part * count * square && {
            let own = self.speeds.iter().zip(along).map(|(speed, w)| speed * w.abs()).sum::<f64>();
            // what has never moved by more than a rounding error of the motion as a whole does not move
            velocity.abs() <= part * own || own * own <= f64::EPSILON * f64::EPSILON * square
        }
    }

    /// Whether a rebound along a direction of this square of the length is so slow that its height is a rounding error of that
    /// which the largest velocity of late gives.
    pub(super) fn is_low(&self, rebound: f64, square: f64) -> bool {
        rebound * rebound <= f64::EPSILON * square * self.fastest
    }

    /// Whether [`silence`](Self::silence) may take away a velocity along a direction of this square of the length: a first test.
    #[inline]
    pub(super) fn may_be_noise(&self, velocity: f64, square: f64) -> bool {
        velocity * velocity <= (NOISE * f64::EPSILON) * (NOISE * f64::EPSILON) * square * self.fastest
    }

    /// Takes away what rounding errors have left of coordinates and velocities that were larger of late: a structure whose bodies
    /// stop each other exactly is at rest, and no force is left. `steps` is the number of sums that each has gone through. Returns
    /// whether anything was taken away: contacts at rest need not be closed exactly then.
    pub(super) fn silence(&self, x: &mut [f64], v: &mut [f64], steps: usize) -> bool {
        #[allow(clippy::cast_precision_loss)] // at most some thousands
        let noise = NOISE * f64::EPSILON * steps as f64;
        let mut any = false;
        for ((x, v), speed) in x.iter_mut().zip(v).zip(&self.speeds) {
            let least = noise * speed;
            if v.abs() > least {
                // where it moves on, its place says when it arrives
                continue;
            }
            any |= *v != 0.0;
            *v = 0.0;
            if x.abs() <= least * self.longest {
                any |= *x != 0.0;
                *x = 0.0;
            }
        }
        any
    }

    /// Keeps a change after a short flight.
    #[inline]
    pub(super) fn keep(&mut self, kind: EventKind, place: usize, speed: f64) {
        if self.short {
            let (after, begins) = (core::mem::take(&mut self.passed), core::mem::take(&mut self.flew));
            self.latest.push_front(Change { kind, place, speed, after, begins, exact: self.exact });
            if begins {
                (self.count, self.kept) = (self.count + 1, self.kept + 1);
                self.forget_oldest();
            }
        }
    }

    /// Forgets the oldest instants beyond those that are kept.
    fn forget_oldest(&mut self) {
        while self.kept > KEPT {
            self.kept -= 1;
            self.latest.pop_back();
            while self.latest.back().is_some_and(|oldest| !oldest.begins) {
                self.latest.pop_back();
            }
        }
    }

    /// The number of changes at so many latest instants.
    fn changes_at(&self, instants: usize) -> usize {
        let begins = self.latest.iter().enumerate().filter(|(_, change)| change.begins);
        begins.take(instants).last().map_or(0, |(k, _)| k + 1)
    }

    /// All of it as numbers: the squares of the size of coordinates and of velocities, the longest flight, the number of changes, the velocities, and each change.
    /// None if there was no flight.
    #[allow(clippy::cast_precision_loss)] // counts of changes
    pub(super) fn numbers(&self) -> Vec<f64> {
        if self.square == 0.0 {
            return Vec::new();
        }
        let kind = |kind| KINDS.iter().position(|known| *known == kind).unwrap_or(0) as f64;
        let mark = |of: bool| f64::from(u8::from(of));
        let change = |change: &Change| {
            let Change { place, speed, after, begins, exact, .. } = *change;
            [kind(change.kind), place as f64, speed, after, mark(begins), mark(exact)]
        };
        let head = [self.square, self.fastest, self.longest, self.count as f64];
        head.into_iter().chain(self.speeds.iter().copied()).chain(self.latest.iter().flat_map(change)).collect()
    }

    /// What has these numbers; `None` if they are none.
    #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss)] // checked
    pub(super) fn of_numbers(numbers: &[f64], (coordinates, places): (usize, usize)) -> Option<Self> {
        let ([square, fastest, longest, count], rest) = numbers.split_first_chunk()?;
        let (speeds, changes) = rest.split_at_checked(coordinates)?;
        let (changes, rest) = changes.as_chunks::<6>();
        let change = |[kind, place, speed, after, begins, exact]: &[f64; 6]| {
            let kind = (0..KINDS.len()).find(|k| *k as f64 == *kind).map(|k| KINDS[k])?;
            let place = (0..places).find(|at| *at as f64 == *place)?;
            let (begins, exact) = (*begins == 1.0, *exact == 1.0);
            Some(Change { kind, place, speed: *speed, after: *after, begins, exact })
        };
        let latest: VecDeque<Change> = changes.iter().map(change).collect::<Option<_>>()?;
        let kept = latest.iter().filter(|change| change.begins).count();
        let whole = rest.is_empty()
            && kept <= KEPT
            && *square > 0.0
            && *fastest >= 0.0
            && *longest >= 0.0
            && (0.0..1e15).contains(count);
        whole.then_some(Self {
            longest: *longest,
            square: *square,
            fastest: *fastest,
            speeds: speeds.to_vec(),
            short: !latest.is_empty(),
            count: *count as usize,
            kept,
            passed: 0.0,
            flew: false,
            exact: false,
            latest,
        })
    }

    /// Forgets all changes, because stops have come to rest. What is long and fast is not forgotten: other bodies may go on.
    pub(super) fn clear(&mut self) {
        let speeds = core::mem::take(&mut self.speeds);
        *self = Self { longest: self.longest, square: self.square, fastest: self.fastest, speeds, ..Self::default() };
    }

    /// The shortest round that repeats itself at the end.
    pub(super) fn round(&self) -> Option<Round> {
        // two rounds and the change before them are compared
        let most = self.changes_at(LONGEST).min(self.latest.len().saturating_sub(1) / 2);
        (1..=most).find_map(|period| self.round_of(period))
    }

    /// A round of so many changes.
    fn round_of(&self, period: usize) -> Option<Round> {
        let all = &self.latest;
        let repeated = |k: usize| all.get(k + period).is_some_and(|before| all[k].repeats(before));
        if !(0..=period).all(repeated) {
            return None;
        }
        let falls = |factor: f64| (0.0..1.0 - FALLS).contains(&factor);
        let length = |k: usize| (k..k + period).map(|i| all[i].after).sum::<f64>();
        // impacts that fall at one instant take no time
        let at_once = length(0) <= BELOW * f64::EPSILON * self.longest;
        // by how much shorter each round is than the one before
        let factor = if at_once { 0.0 } else { length(0) / length(period) };
        let slower = |k: usize| all[k].speed / all[k + period].speed;
        let impacts = |until: usize| (0..until).filter(|k| all[*k].is_impact());
        let first = slower(impacts(period).next()?);
        let one = |until: usize, equal: f64| impacts(until).all(|k| (slower(k) - first).abs() <= equal * first);
        if !falls(factor) || !falls(first) || !one(period + 1, EQUAL) {
            return None;
        }
        // the sum of all rounds that follow
        let left = length(0) * factor / (1.0 - factor);
        // the factor of three rounds tells how much it still changes
        let third = (period + 1..=2 * period).all(repeated) && one(2 * period, EQUAL);
        let error = if at_once {
            if third && one(2 * period, SETTLED) { 0.0 } else { f64::INFINITY }
        } else if third {
            let before = length(period) / length(2 * period);
            // the derivative of q/(1 - q) is 1/(1 - q)^2
            length(0) * (factor - before).abs() / ((1.0 - factor) * (1.0 - factor))
        } else {
            left
        };
        let times = impacts(period).map(|k| (0..k).map(|i| all[i].after).sum::<f64>());
        let (least, most) = times.fold((f64::INFINITY, 0.0_f64), |(a, b), time| (a.min(time), b.max(time)));
        let mut places: Vec<usize> = all.iter().take(period).map(|change| change.place).collect();
        places.sort_unstable();
        places.dedup();
        Some(Round {
            places,
            in_turn: at_once || most - least > TOGETHER * length(0),
            left,
            error,
            speed: impacts(period).map(|k| all[k].speed).fold(0.0, f64::max),
            exact: impacts(2 * period).all(|k| all[k].exact),
        })
    }

    /// Several stops that are struck again and again, ever more slowly, without a round that repeats itself; asked once in some
    /// instants.
    pub(super) fn crowd(&self) -> Option<Vec<usize>> {
        let count = self.kept;
        if count < FEW || !self.count.is_multiple_of(EVERY) {
            return None;
        }
        // while few instants are kept, they must slow down by much more before they count as a crowd
        let factor = if count < KEPT { MUCH_SLOWER } else { SLOWER };
        let late = fastest(self.latest.iter().take(self.changes_at(count / ENDS)));
        let early = fastest(self.latest.iter().skip(self.changes_at(count - count / ENDS)));
        if late > factor * early { None } else { self.struck_often() }
    }

    /// Several stops that are struck again and again, and no way of any of them in all changes that are kept was longer than this;
    /// asked once in some instants.
    pub(super) fn crowd_in_place(&self) -> Option<(Vec<usize>, f64)> {
        if self.kept < KEPT || !self.count.is_multiple_of(EVERY) {
            return None;
        }
        let time: f64 = self.latest.iter().map(|change| change.after).sum();
        Some((self.struck_often()?, time * fastest(self.latest.iter())))
    }

    /// The stops that are struck again and again, if there are several.
    fn struck_often(&self) -> Option<Vec<usize>> {
        let impacts = self.latest.iter().filter(|change| change.is_impact());
        let mut struck: Vec<usize> = impacts.map(|one| one.place).collect();
        struck.sort_unstable();
        let often = struck.chunk_by(|a, b| a == b).filter(|own| own.len() >= OFTEN);
        let stops: Vec<usize> = often.map(|own| own[0]).collect();
        (stops.len() > 1).then_some(stops)
    }
}

/// The largest speed of the impacts among changes.
fn fastest<'a>(changes: impl Iterator<Item = &'a Change>) -> f64 {
    changes.filter(|change| change.is_impact()).fold(0.0, |most, change| most.max(change.speed))
}
