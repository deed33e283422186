//! The motions to which starts of one oscillator lead, collected from the verdicts on the starts.

use super::CountedMotion;
use super::attractors::SAME;
use super::oscillator::Reason;
use super::outcome::Verdict;
use crate::lyapunov::Arrivals;
use crate::math::sort_by_key;

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
pub(super) struct Part {
    motions: Vec<Local>,
    /// The index of its motion for each start; [`OPEN`] if not decided.
    cells: Vec<u32>,
    /// How each start was decided; without meaning where it is not.
    endings: Vec<Ending>,
}

const OPEN: u32 = u32::MAX;
impl Part {
    /// The index of a motion in this part; a new motion is added.
    pub(super) fn number(&mut self, verdict: &Verdict, index: u64) -> usize {
        let known = self.motions.iter().position(|motion| motion.verdict.same_as(verdict, SAME));
        known.unwrap_or_else(|| {
            self.motions.push(Local { verdict: verdict.clone(), first: index, followed: None });
            self.motions.len() - 1
        })
    }

    /// No start of a range of this length is decided.
    pub(super) fn open(count: usize) -> Self {
        let nothing = Ending { reason: Reason::Impacts, impacts: 0 };
        Self { motions: Vec::new(), cells: vec![OPEN; count], endings: vec![nothing; count] }
    }

    /// Records the [number](Self::number) of the motion to which a start leads, decided for this reason after so many impacts.
    pub(super) fn caught(&mut self, place: usize, index: u64, number: usize, (reason, impacts): (Reason, u64)) {
        let motion = &mut self.motions[number];
        self.endings[place] = Ending { reason, impacts: u32::try_from(impacts).unwrap_or(u32::MAX) };
        // starts are decided in any order; the first by index gives the motion its verdict and its place
        motion.first = motion.first.min(index);
        self.cells[place] = u32::try_from(number).unwrap_or(OPEN);
    }

    /// Records the motion to which a start leads, with the full verdict on this start.
    pub(super) fn followed(
        &mut self,
        place: usize,
        index: u64,
        (verdict, arrivals): (Verdict, Arrivals),
        impacts: u64,
    ) {
        let number = self.number(&verdict, index);
        self.caught(place, index, number, (verdict.reason(), impacts));
        let motion = &mut self.motions[number];
        // kept, so that the first start need not be followed again
        if motion.followed.as_ref().is_none_or(|(other, _)| index < *other) {
            motion.followed = Some((index, (verdict, arrivals)));
        }
    }

    /// The motions in order of first appearance, each with the full verdict on its first start; `None` if this verdict
    /// is another motion.
    pub(super) fn settlement(mut self, first: u64, full: &dyn Fn(u64) -> Verdict) -> Option<Settlement> {
        // a stopped run keeps the starts before the first that is not decided
        self.cells.truncate(self.cells.iter().position(|&cell| cell == OPEN).unwrap_or(self.cells.len()));
        self.endings.truncate(self.cells.len());
        let end = first + self.cells.len() as u64;
        // motions that only cut starts lead to are gone; the order does not depend on lanes or threads
        let mut order: Vec<usize> = (0..self.motions.len()).filter(|&k| self.motions[k].first < end).collect();
        sort_by_key(&mut order, |&k| self.motions[k].first);
        let mut renamed = vec![OPEN; self.motions.len()];
        let mut motions = Vec::with_capacity(order.len());
        let mut tails = Vec::with_capacity(order.len());
        for (new, &old) in order.iter().enumerate() {
            let motion = &mut self.motions[old];
            // a start that a trapping region caught has no verdict of its own: it is followed alone now
            let (verdict, arrivals) = match motion.followed.take() {
                Some((index, followed)) if index == motion.first => followed,
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
