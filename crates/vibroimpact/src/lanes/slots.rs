//! Where the flights of a batch are kept: a slot each, in arrays that lanes run along.

use super::stride::{State, Stride, Table, WIDEST};
use super::strike::{Approach, Guess, Launch, Strike};
use crate::contact::chatter;
use crate::math::{Lane, Mask, sin_cos, sin_cos_lanes};
use crate::system::{Start, phase};

/// Columns of a launch: the state, and the arrival before it (speed, time since the launch before, side).
pub(super) const X: usize = 0;
pub(super) const V: usize = 1;
pub(super) const SIN: usize = 2;
pub(super) const COS: usize = 3;
pub(super) const PHASE: usize = 4;
pub(super) const ARRIVAL: usize = 5;
pub(super) const INTERVAL: usize = 6;
pub(super) const SIDE: usize = 7;

/// What became of the flights in a round.
#[derive(Clone, Debug, Default)]
pub(super) struct Lists {
    /// Not proven clear in this step.
    pub(super) doubtful: Vec<u32>,
    /// Flown for longer than lanes fly.
    pub(super) late: Vec<u32>,
    /// Struck and launched again.
    pub(super) struck: Vec<u32>,
    /// Of those struck, the ones so gentle that the rest of a chatter may have to be summed.
    pub(super) gentle: Vec<u32>,
    /// Neither clear nor proven to strike.
    pub(super) open: Vec<u32>,
}

impl Lists {
    pub(super) fn clear(&mut self) {
        for list in [&mut self.doubtful, &mut self.late, &mut self.struck, &mut self.gentle, &mut self.open] {
            list.clear();
        }
    }
}

/// Flights under way.
#[derive(Clone, Debug)]
pub(super) struct Slots {
    pub(super) count: usize,
    s: Vec<f64>,
    x: Vec<f64>,
    v: Vec<f64>,
    sin: Vec<f64>,
    cos: Vec<f64>,
    pub(super) launches: Vec<[f64; 8]>,
}

impl Slots {
    pub(super) fn new(capacity: usize) -> Self {
        let padded = capacity.next_multiple_of(WIDEST);
        let zeros = || vec![0.0; padded];
        Self {
            count: 0,
            s: zeros(),
            x: zeros(),
            v: zeros(),
            sin: zeros(),
            cos: zeros(),
            launches: vec![[0.0; 8]; padded],
        }
    }

    #[inline(always)]
    pub(super) fn put(&mut self, slot: usize, state: State<f64>) {
        self.s[slot] = state.s;
        self.x[slot] = state.x;
        self.v[slot] = state.v;
        self.sin[slot] = state.sin;
        self.cos[slot] = state.cos;
    }

    pub(super) fn state(&self, slot: usize) -> State<f64> {
        State { s: self.s[slot], x: self.x[slot], v: self.v[slot], sin: self.sin[slot], cos: self.cos[slot] }
    }

    /// Launches `slot`; the row holds everything.
    #[inline(always)]
    pub(super) fn launch(&mut self, slot: usize, row: [f64; 8]) {
        self.launches[slot] = row;
        self.put(slot, State { s: 0.0, x: row[X], v: row[V], sin: row[SIN], cos: row[COS] });
    }

    /// Moves the last slot into this one.
    pub(super) fn remove(&mut self, slot: usize) {
        self.count -= 1;
        let last = self.count;
        self.put(slot, self.state(last));
        self.launches[slot] = self.launches[last];
        // what lies beyond the last slot is marched along with it, to no effect
        self.put(last, State { s: 0.0, x: 0.0, v: 0.0, sin: 0.0, cos: 0.0 });
    }

    #[inline(always)]
    fn load<L: Lane>(&self, at: usize) -> State<L> {
        State {
            s: L::load(&self.s[at..]),
            x: L::load(&self.x[at..]),
            v: L::load(&self.v[at..]),
            sin: L::load(&self.sin[at..]),
            cos: L::load(&self.cos[at..]),
        }
    }

    #[inline(always)]
    fn gather<L: Lane>(&self, at: &[u32]) -> State<L> {
        State {
            s: L::gather(&self.s, at),
            x: L::gather(&self.x, at),
            v: L::gather(&self.v, at),
            sin: L::gather(&self.sin, at),
            cos: L::gather(&self.cos, at),
        }
    }

    /// One step of every flight; those whose step is not proven clear stay where they are and are listed.
    #[inline(always)]
    pub(super) fn march<L: Lane>(&mut self, stride: &Stride, lists: &mut Lists) {
        let Lists { doubtful, late, .. } = lists;
        let pace = stride.pace.splat::<L>();
        doubtful.resize(self.count + WIDEST, 0);
        let mut listed = 0;
        let mut at = 0;
        while at < self.count {
            let state = self.load::<L>(at);
            let next = pace.step(state);
            let clear = stride.clear(&pace.scale, &stride.end(&state), &stride.end(&next), false);
            L::choose(clear, next.s, state.s).store(&mut self.s[at..]);
            L::choose(clear, next.x, state.x).store(&mut self.x[at..]);
            L::choose(clear, next.v, state.v).store(&mut self.v[at..]);
            L::choose(clear, next.sin, state.sin).store(&mut self.sin[at..]);
            L::choose(clear, next.cos, state.cos).store(&mut self.cos[at..]);
            let valid = (1_u32 << L::WIDTH.min(self.count - at)) - 1;
            let doubt = !clear.bits() & valid;
            // written whether it counts or not: no branch to guess wrong
            if let Some(places) = doubtful.get_mut(listed..listed + L::WIDTH) {
                let mut filled = 0;
                for lane in 0..L::WIDTH {
                    #[allow(clippy::cast_possible_truncation)] // slot numbers
                    let slot = (at + lane) as u32;
                    places[filled] = slot;
                    filled += (doubt >> lane & 1) as usize;
                }
                listed += filled;
            }
            let mut gone = clear.and(stride.late(next.s)).bits() & valid;
            while gone != 0 {
                #[allow(clippy::cast_possible_truncation)] // slot numbers
                late.push(at as u32 + gone.trailing_zeros());
                gone &= gone - 1;
            }
            at += L::WIDTH;
        }
        doubtful.truncate(listed);
    }

    /// Strikes where a strike can be proven, and launches those slots again from the stop. Each doubtful slot goes on one of
    /// the two lists.
    #[inline(always)]
    pub(super) fn strike<L: Lane>(&mut self, stride: &Stride, table: &Table, lists: &mut Lists) {
        let Lists { doubtful, struck, gentle, open, .. } = lists;
        let pace = stride.pace.splat::<L>();
        let zero = L::splat(0.0);
        let nowhere = State { s: zero, x: zero, v: zero, sin: zero, cos: zero };
        let mut at = [[0; WIDEST]; BLOCK];
        let (mut from, mut guess) = ([nowhere; BLOCK], [Guess::nowhere(); BLOCK]);
        let (mut approach, mut hits) = ([Approach::nowhere(); BLOCK], [Strike::nowhere(); BLOCK]);
        for block in doubtful.chunks(BLOCK * L::WIDTH) {
            // stage by stage, so that a group's work fills the time another one waits for its own results
            let groups = block.len().div_ceil(L::WIDTH);
            for (k, few) in block.chunks(L::WIDTH).enumerate() {
                at[k] = padded(few);
                from[k] = self.gather::<L>(&at[k]);
                guess[k] = stride.guess(pace.h, &from[k], &pace.step(from[k]));
            }
            for k in 0..groups {
                let row = L::rows(&self.launches, &at[k]);
                let launch = Launch { x: row[X], v: row[V], sin: row[SIN], cos: row[COS] };
                approach[k] = stride.approach(&launch, &guess[k], table);
            }
            for k in 0..groups {
                hits[k] = stride.polish(&from[k], &guess[k], &approach[k]);
            }
            for (k, few) in block.chunks(L::WIDTH).enumerate() {
                let phases = L::rows(&self.launches, &at[k])[PHASE];
                let next = rebound(stride, phases, &hits[k]);
                let mut rows = [[0.0; 8]; WIDEST];
                L::store_rows(next, &mut rows);
                let proven = hits[k].proven.bits();
                let pressed = next[SIN] - next[X];
                let pressed = if stride.two_stops { hits[k].side * pressed } else { pressed }.max(zero);
                let soft = next[V].abs().less(L::splat(2.0 * chatter::SLOW) * pressed).bits();
                for (lane, &slot) in few.iter().enumerate() {
                    if proven >> lane & 1 == 1 {
                        self.launch(slot as usize, rows[lane]);
                        struck.push(slot);
                        if soft >> lane & 1 == 1 {
                            gentle.push(slot);
                        }
                    } else {
                        open.push(slot);
                    }
                }
            }
        }
    }
}

/// A few slots, the first of them repeated to fill all lanes.
#[inline(always)]
fn padded(few: &[u32]) -> [u32; WIDEST] {
    let mut at = [few[0]; WIDEST];
    at[..few.len()].copy_from_slice(few);
    at
}

/// Groups of lanes that are struck together.
const BLOCK: usize = 4;

/// The launch that follows a contact, from the phase of the last one.
#[inline(always)]
pub(super) fn rebound<L: Lane>(stride: &Stride, phase: L, hit: &Strike<L>) -> [L; 8] {
    let phase = phase::advance_lanes(phase, L::splat(stride.beta), hit.time);
    let (sin, cos) = sin_cos_lanes(phase);
    let (upper, lower) = (L::splat(stride.restitution[0]), L::splat(stride.restitution[1]));
    let (x, v) = if stride.two_stops {
        let low = hit.side.less(L::splat(0.0));
        let speed = L::choose(low, lower, upper) * hit.velocity;
        (L::choose(low, L::splat(-stride.gap[1]), L::splat(stride.gap[0])), -(hit.side * speed))
    } else {
        (L::splat(stride.gap[0]), -(upper * hit.velocity))
    };
    [x, v, sin, cos, phase, hit.velocity, hit.time, hit.side]
}

/// The row of a launch from a start.
pub(super) fn row(start: Start) -> [f64; 8] {
    let (sin, cos) = sin_cos(start.phase);
    [start.x, start.v, sin, cos, start.phase, 0.0, 0.0, 0.0]
}
