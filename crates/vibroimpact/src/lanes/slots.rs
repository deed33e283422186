//! Where the flights of a batch are kept: a slot each, in arrays that lanes run along.

use super::stride::{State, Stride, Table, WIDEST};
use super::strike::{Approach, Guess, Launch, Strike};
use crate::contact::chatter;
use crate::math::{Lane, Mask, Single, sin_cos, sin_cos_lanes};
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

/// The states of eight flights on their way, in single precision: s, x, v, sin, cos, side by side.
type Block = [[f32; WIDEST]; 5];

/// Flights under way.
#[derive(Clone, Debug)]
pub(super) struct Slots {
    pub(super) count: usize,
    states: Vec<Block>,
    pub(super) launches: Vec<[f64; 8]>,
}

impl Slots {
    pub(super) fn new(capacity: usize) -> Self {
        let blocks = capacity.div_ceil(WIDEST);
        Self { count: 0, states: vec![[[0.0_f32; WIDEST]; 5]; blocks], launches: vec![[0.0; 8]; blocks * WIDEST] }
    }

    #[inline(always)]
    pub(super) fn put(&mut self, slot: usize, State { s, x, v, sin, cos }: State<f32>) {
        let (block, lane) = (&mut self.states[slot / WIDEST], slot % WIDEST);
        for (numbers, value) in block.iter_mut().zip([s, x, v, sin, cos]) {
            numbers[lane] = value;
        }
    }

    pub(super) fn state(&self, slot: usize) -> State<f32> {
        let (block, lane) = (&self.states[slot / WIDEST], slot % WIDEST);
        let [s, x, v, sin, cos] = [0, 1, 2, 3, 4].map(|k: usize| block[k][lane]);
        State { s, x, v, sin, cos }
    }

    /// Launches `slot`; the row holds everything.
    #[inline(always)]
    pub(super) fn launch(&mut self, slot: usize, row: [f64; 8]) {
        self.launches[slot] = row;
        self.put(slot, State { s: 0.0, x: row[X], v: row[V], sin: row[SIN], cos: row[COS] }.rough());
    }

    /// Moves the last slot into this one.
    pub(super) fn remove(&mut self, slot: usize) {
        self.count -= 1;
        let last = self.count;
        self.put(slot, self.state(last));
        self.launches[slot] = self.launches[last];
        self.put(last, State { s: 0.0, x: 0.0, v: 0.0, sin: 0.0, cos: 0.0 });
    }

    #[inline(always)]
    fn gather<L: Lane>(&self, at: &[u32; WIDEST]) -> State<L> {
        State {
            s: L::pick(&self.states, 0, at),
            x: L::pick(&self.states, 1, at),
            v: L::pick(&self.states, 2, at),
            sin: L::pick(&self.states, 3, at),
            cos: L::pick(&self.states, 4, at),
        }
    }

    /// One step of every flight; those whose step is not proven clear stay where they are and are listed.
    #[inline(always)]
    pub(super) fn march<L: Single>(&mut self, stride: &Stride, lists: &mut Lists) {
        let Lists { doubtful, late, .. } = lists;
        let pace = stride.pace.splat::<L>();
        doubtful.resize(self.count + WIDEST, 0);
        let (mut listed, mut first) = (0, 0);
        for block in self.states.iter_mut().take(self.count.div_ceil(WIDEST)) {
            let (mut doubt, mut gone) = (0, 0);
            let mut lane = 0;
            while lane < WIDEST {
                let [s, x, v, sin, cos] = block;
                let state = State {
                    s: L::load(&s[lane..]),
                    x: L::load(&x[lane..]),
                    v: L::load(&v[lane..]),
                    sin: L::load(&sin[lane..]),
                    cos: L::load(&cos[lane..]),
                };
                let next = pace.step(state);
                let margin = stride.margin(state.s);
                let clear = stride.clear(&pace.scale, &stride.end(&state), &stride.end(&next), margin, false);
                L::choose(clear, next.s, state.s).store(&mut s[lane..]);
                L::choose(clear, next.x, state.x).store(&mut x[lane..]);
                L::choose(clear, next.v, state.v).store(&mut v[lane..]);
                L::choose(clear, next.sin, state.sin).store(&mut sin[lane..]);
                L::choose(clear, next.cos, state.cos).store(&mut cos[lane..]);
                doubt |= (!clear.bits() & ((1 << L::WIDTH) - 1)) << lane;
                gone |= clear.and(stride.late(next.s)).bits() << lane;
                lane += L::WIDTH;
            }
            // what lies beyond the last slot is marched along, to no effect
            let valid = if self.count - first < WIDEST { (1 << (self.count - first)) - 1 } else { 0xff };
            listed += list(doubt & valid, first, &mut doubtful[listed..]);
            if gone & valid != 0 {
                let mut more = [0; WIDEST];
                let count = list(gone & valid, first, &mut more);
                late.extend_from_slice(&more[..count]);
            }
            first += WIDEST;
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
        let (mut from, mut margins, mut guess) = ([nowhere; BLOCK], [zero; BLOCK], [Guess::nowhere(); BLOCK]);
        let mut launches = [Launch { x: zero, v: zero, sin: zero, cos: zero }; BLOCK];
        let (mut approach, mut hits) = ([Approach::nowhere(); BLOCK], [Strike::nowhere(); BLOCK]);
        for block in doubtful.chunks(BLOCK * L::WIDTH) {
            // stage by stage, so that a group's work fills the time another one waits for its own results
            let groups = block.len().div_ceil(L::WIDTH);
            for (k, few) in block.chunks(L::WIDTH).enumerate() {
                at[k] = padded(few);
                let row = L::rows(&self.launches, &at[k]);
                launches[k] = Launch { x: row[X], v: row[V], sin: row[SIN], cos: row[COS] };
                (from[k], margins[k]) = launches[k].or_on_the_way(stride, self.gather::<L>(&at[k]));
                guess[k] = stride.guess(pace.h, &from[k], &pace.step(from[k]));
            }
            for k in 0..groups {
                approach[k] = stride.approach(&launches[k], &guess[k], table);
            }
            for k in 0..groups {
                hits[k] = stride.polish(&from[k], margins[k], &guess[k], &approach[k]);
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

/// Writes the slots whose bits are set to the beginning of `places`, which has room for all, and returns how many: without a
/// branch that could be guessed wrong.
#[inline(always)]
fn list(bits: u32, first: usize, places: &mut [u32]) -> usize {
    let offsets = &OFFSETS[(bits & 0xff) as usize];
    if let Some(places) = places.first_chunk_mut::<WIDEST>() {
        for (place, offset) in places.iter_mut().zip(offsets) {
            #[allow(clippy::cast_possible_truncation)] // slot numbers
            let first = first as u32;
            *place = first + u32::from(*offset);
        }
    }
    (bits & 0xff).count_ones() as usize
}

/// The places of the bits that are set, for every byte.
const OFFSETS: [[u8; WIDEST]; 256] = {
    let mut table = [[0; WIDEST]; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut bit, mut count) = (0_u8, 0);
        while bit < 8 {
            if byte >> bit & 1 == 1 {
                table[byte][count] = bit;
                count += 1;
            }
            bit += 1;
        }
        byte += 1;
    }
    table
};

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
